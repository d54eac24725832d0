#include "core/terrain/dted_tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/tile_writer.hpp"

namespace ridgeline {
namespace {

using test::dted_bytes;
using test::dted_shape;
using test::seal_dted_record;

using Bytes = std::vector<std::byte>;

int ramp_m(int row, int column) {
  return 2 * row - 3 * column;
}

Bytes small_tile() {
  return dted_bytes(0, 43, -80, ramp_m);
}

void put(Bytes& bytes, std::size_t at, std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) bytes[at + i] = static_cast<std::byte>(text[i]);
}

Fault fault_with(std::size_t at, std::string_view text) {
  Bytes bytes = small_tile();
  put(bytes, at, text);
  return parse_dted(bytes).fault();
}

std::size_t post_at(int rows, int row, int column) {
  return dted_header_bytes + dted_record_bytes(rows) * static_cast<std::size_t>(column) +
         dted_record_head_bytes + 2 * static_cast<std::size_t>(row);
}

struct Cell {
  int level;
  int south_deg;
  int west_deg;
};

void PrintTo(const Cell& cell, std::ostream* out) {
  *out << "level " << cell.level << " at " << cell.south_deg << " " << cell.west_deg;
}

class DtedCell : public testing::TestWithParam<Cell> {};

TEST_P(DtedCell, comes_back_as_it_was_written) {
  const Cell& cell = GetParam();
  const Bytes bytes = dted_bytes(cell.level, cell.south_deg, cell.west_deg, ramp_m);
  const Result<HeightTile> tile = parse_dted(bytes);
  ASSERT_TRUE(tile.ok()) << fault_id(tile.fault());
  const PostGrid& grid = tile.value().grid;
  const test::DtedShape shape = dted_shape(cell.level, cell.south_deg);
  EXPECT_EQ(grid.rows, shape.rows);
  EXPECT_EQ(grid.columns, shape.columns);
  EXPECT_EQ(grid.south_deg, cell.south_deg);
  EXPECT_EQ(grid.west_deg, cell.west_deg);
  EXPECT_DOUBLE_EQ(grid.north_deg(), cell.south_deg + 1.0);
  EXPECT_DOUBLE_EQ(grid.east_deg(), cell.west_deg + 1.0);
  std::vector<float> row(static_cast<std::size_t>(grid.columns));
  for (int y = 0; y < grid.rows; ++y) {
    read_posts(tile.value(), y, 0, row);
    for (int x = 0; x < grid.columns; ++x) {
      const int height_m = ramp_m(y, x);
      const float read_m = row[static_cast<std::size_t>(x)];
      ASSERT_EQ(read_m, static_cast<float>(height_m)) << y << " " << x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LevelsAndZones, DtedCell,
                         testing::Values(Cell{0, 43, -80}, Cell{0, 5, 0}, Cell{0, -1, -180},
                                         Cell{0, -90, 179}, Cell{0, 72, 10}, Cell{0, -76, 10},
                                         Cell{0, 89, 10}, Cell{1, 0, 6}, Cell{1, 64, -22},
                                         Cell{2, 46, 8}, Cell{2, 75, -60}));

TEST(DtedTile, columns_thin_out_towards_the_poles) {
  const Bytes bytes = dted_bytes(1, 64, -22, ramp_m);
  const Result<HeightTile> tile = parse_dted(bytes);
  ASSERT_TRUE(tile.ok());
  EXPECT_EQ(tile.value().grid.rows, 1201);
  EXPECT_EQ(tile.value().grid.columns, 601);
  EXPECT_EQ(tile.value().grid.longitude_step_deg, 1.0 / 600);
}

TEST(DtedTile, minus_zero_west_is_greenwich) {
  Bytes bytes = dted_bytes(0, 5, 0, ramp_m);
  put(bytes, 4, "0000000W");
  put(bytes, 80 + 211, "0000000W");
  const Result<HeightTile> tile = parse_dted(bytes);
  ASSERT_TRUE(tile.ok());
  EXPECT_EQ(tile.value().grid.west_deg, 0.0);
}

TEST(DtedTile, heights_are_sign_and_magnitude) {
  const auto raw_post_m = [](unsigned raw) {
    Bytes bytes = small_tile();
    const std::size_t at = post_at(121, 5, 9);
    bytes[at] = static_cast<std::byte>(raw >> 8U);
    bytes[at + 1] = static_cast<std::byte>(raw & 0xFFU);
    seal_dted_record(bytes, 121, 9);
    const Result<HeightTile> tile = parse_dted(bytes);
    float height_m = 12345;
    if (tile.ok()) read_posts(tile.value(), 5, 9, {&height_m, 1});
    return height_m;
  };
  EXPECT_EQ(raw_post_m(0x0000), 0.0F);
  EXPECT_EQ(raw_post_m(0x8000), 0.0F);
  EXPECT_EQ(raw_post_m(0x01A8), 424.0F);
  EXPECT_EQ(raw_post_m(0x81A8), -424.0F);
  EXPECT_EQ(raw_post_m(9000), 9000.0F);
  EXPECT_EQ(raw_post_m(0x8000U | 12000U), -12000.0F);
  EXPECT_TRUE(std::isnan(raw_post_m(0xFFFF)));  // the void, -32767
  EXPECT_TRUE(std::isnan(raw_post_m(0xFFFB)));  // -5 m of a writer that used two's complement
  EXPECT_TRUE(std::isnan(raw_post_m(9001)));
  EXPECT_TRUE(std::isnan(raw_post_m(0x8000U | 12001U)));
  EXPECT_TRUE(std::isnan(raw_post_m(0x7FFF)));
}

TEST(DtedTile, any_flipped_bit_in_the_records_is_found) {
  Bytes bytes = small_tile();
  for (std::size_t at = dted_header_bytes; at < bytes.size(); at += 11) {
    const std::byte flip{static_cast<unsigned char>(1U << (at % 8))};
    bytes[at] ^= flip;
    const Fault fault = parse_dted(bytes).fault();
    bytes[at] ^= flip;
    const bool sentinel = (at - dted_header_bytes) % dted_record_bytes(121) == 0;
    ASSERT_EQ(fault, sentinel ? Fault::tile_record_corrupt : Fault::tile_checksum_mismatch) << at;
  }
  EXPECT_TRUE(parse_dted(bytes).ok());
}

TEST(DtedTile, records_out_of_order_are_found) {
  Bytes bytes = small_tile();
  const auto record = [&](std::ptrdiff_t column) {
    return bytes.begin() + dted_header_bytes + column * static_cast<std::ptrdiff_t>(254);
  };
  ASSERT_EQ(dted_record_bytes(121), 254U);
  std::swap_ranges(record(3), record(4), record(4));
  EXPECT_EQ(parse_dted(bytes).fault(), Fault::tile_record_corrupt);
}

TEST(DtedTile, every_cut_is_found) {
  const Bytes bytes = small_tile();
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}, std::size_t{80},
                                 dted_header_bytes - 1, dted_header_bytes, bytes.size() - 1}) {
    const std::span<const std::byte> cut = std::span(bytes).first(size);
    EXPECT_EQ(parse_dted(cut).fault(), Fault::tile_truncated) << size;
  }
}

TEST(DtedTile, bytes_after_the_last_record_are_refused) {
  Bytes bytes = small_tile();
  bytes.push_back(std::byte{0});
  EXPECT_EQ(parse_dted(bytes).fault(), Fault::tile_size_mismatch);
}

TEST(DtedTile, damaged_header_is_refused) {
  EXPECT_EQ(fault_with(0, "UHL2"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(80, "DSX"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(728, "XCC"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(80 + 59, "DEM "), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(4, "08X0000W"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(4, "0800000Q"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(4, "0810000W"), Fault::tile_header_corrupt);  // not what the DSI says
  EXPECT_EQ(fault_with(12, "0420000N"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(12, "0430000S"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(20, "0030"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(24, "    "), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(47, "0061"), Fault::tile_header_corrupt);
  EXPECT_EQ(fault_with(80 + 281, "1201"), Fault::tile_header_corrupt);
}

TEST(DtedTile, place_outside_the_world_is_refused) {
  for (const auto& [user, data] : {std::pair{"1810000W", "1810000W"}, {"1800000E", "1800000E"}}) {
    Bytes bytes = small_tile();
    put(bytes, 4, user);
    put(bytes, 80 + 211, data);
    EXPECT_EQ(parse_dted(bytes).fault(), Fault::tile_header_corrupt) << user;
  }
}

TEST(DtedTile, partial_cells_and_tape_labels_are_not_supported) {
  Bytes half = small_tile();  // 61 columns of 30": half a degree
  put(half, 47, "0061");
  put(half, 80 + 285, "0061");
  EXPECT_EQ(parse_dted(half).fault(), Fault::tile_unsupported);
  Bytes one_column = small_tile();
  put(one_column, 47, "0001");
  put(one_column, 80 + 285, "0001");
  EXPECT_EQ(parse_dted(one_column).fault(), Fault::tile_unsupported);
  Bytes off_degree = small_tile();
  put(off_degree, 4, "0803000W");
  put(off_degree, 80 + 211, "0803000W");
  EXPECT_EQ(parse_dted(off_degree).fault(), Fault::tile_unsupported);
  Bytes tape(80, std::byte{' '});
  put(tape, 0, "VOL1");
  const Bytes tile = small_tile();
  tape.insert(tape.end(), tile.begin(), tile.end());
  EXPECT_EQ(parse_dted(tape).fault(), Fault::tile_unsupported);
}

}  // namespace
}  // namespace ridgeline
