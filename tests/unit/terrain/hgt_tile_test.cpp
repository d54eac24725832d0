#include "core/terrain/hgt_tile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/tile_writer.hpp"

namespace ridgeline {
namespace {

using test::hgt_bytes;

constexpr std::size_t bytes_3_arc_seconds = 2 * 1201 * 1201;
constexpr std::size_t bytes_1_arc_second = 2 * 3601 * 3601;
constexpr std::size_t bytes_third_arc_second = std::size_t{2} * 10801 * 10801;

int ramp_m(int row, int column) {
  return 3 * row - 2 * column - 500;
}

float post_m(const HeightTile& tile, int row, int column) {
  float height_m = 0;
  read_posts(tile, row, column, {&height_m, 1});
  return height_m;
}

Fault fault_of_size(std::size_t size_bytes) {
  return hgt_grid(size_bytes, {46, 8}).fault();
}

TEST(HgtTile, rows_run_from_the_south_and_columns_from_the_west) {
  const std::vector<std::byte> bytes = hgt_bytes(1201, ramp_m);
  const Result<HeightTile> tile = parse_hgt(bytes, -20, -180);
  ASSERT_TRUE(tile.ok());
  const PostGrid& grid = tile.value().grid;
  EXPECT_EQ(grid.south_deg, -20.0);
  EXPECT_EQ(grid.west_deg, -180.0);
  EXPECT_DOUBLE_EQ(grid.north_deg(), -19.0);
  EXPECT_DOUBLE_EQ(grid.east_deg(), -179.0);
  std::vector<float> row(1201);
  for (int y = 0; y < grid.rows; ++y) {
    read_posts(tile.value(), y, 0, row);
    for (int x = 0; x < grid.columns; ++x) {
      ASSERT_EQ(row[static_cast<std::size_t>(x)], static_cast<float>(ramp_m(y, x)));
    }
  }
}

TEST(HgtTile, part_of_a_row_is_read_from_its_column_on) {
  const std::vector<std::byte> bytes = hgt_bytes(1201, ramp_m);
  const Result<HeightTile> tile = parse_hgt(bytes, 46, 8);
  ASSERT_TRUE(tile.ok());
  std::vector<float> part(4, -1.0F);
  read_posts(tile.value(), 7, 1197, part);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(part[static_cast<std::size_t>(i)], static_cast<float>(ramp_m(7, 1197 + i)));
  }
  read_posts(tile.value(), 7, 1201, {});  // nothing, at the end of the row
}

TEST(HgtTile, one_arc_second_tile_opens) {
  const std::vector<std::byte> bytes =
      hgt_bytes(3601, [](int row, int column) { return row == 3600 && column == 3600 ? 8848 : 0; });
  const Result<HeightTile> tile = parse_hgt(bytes, 27, 86);
  ASSERT_TRUE(tile.ok());
  EXPECT_EQ(tile.value().grid.rows, 3601);
  EXPECT_EQ(tile.value().grid.longitude_step_deg, 1.0 / 3600);
  EXPECT_EQ(post_m(tile.value(), 3600, 3600), 8848.0F);
}

TEST(HgtTile, third_of_an_arc_second_tile_opens) {
  std::vector<std::byte> bytes(bytes_third_arc_second);
  bytes[2 * 10800] = std::byte{0x22};  // north-east corner: 8848 = 0x2290
  bytes[2 * 10800 + 1] = std::byte{0x90};
  const Result<HeightTile> tile = parse_hgt(bytes, 27, 86);
  ASSERT_TRUE(tile.ok());
  EXPECT_EQ(tile.value().grid.rows, 10801);
  EXPECT_EQ(tile.value().grid.columns, 10801);
  EXPECT_EQ(tile.value().grid.latitude_step_deg, 1.0 / 10800);
  EXPECT_DOUBLE_EQ(tile.value().grid.north_deg(), 28.0);
  EXPECT_EQ(post_m(tile.value(), 10800, 10800), 8848.0F);
  EXPECT_EQ(post_m(tile.value(), 10800, 10799), 0.0F);
  EXPECT_EQ(post_m(tile.value(), 0, 0), 0.0F);
}

TEST(HgtTile, void_and_impossible_heights_are_unknown) {
  const int heights_m[] = {-32767, -12001, -12000, -9999, -9998, -1, 0, 9000, 9001, 32767};
  const std::vector<std::byte> bytes =
      hgt_bytes(1201, [&](int row, int column) -> std::optional<int> {
        if (row != 0 || column >= 10) return std::nullopt;
        return heights_m[column];
      });
  const Result<HeightTile> tile = parse_hgt(bytes, 46, 8);
  ASSERT_TRUE(tile.ok());
  const bool known[] = {false, false, true, false, true, true, true, true, false, false};
  for (int i = 0; i < 10; ++i) {
    const float height_m = post_m(tile.value(), 0, i);
    if (known[i]) {
      EXPECT_EQ(height_m, static_cast<float>(heights_m[i]));
    } else {
      EXPECT_TRUE(std::isnan(height_m)) << heights_m[i];
    }
  }
  EXPECT_TRUE(std::isnan(post_m(tile.value(), 0, 10)));
  EXPECT_TRUE(std::isnan(post_m(tile.value(), 1200, 1200)));
}

TEST(HgtTile, every_other_size_is_refused) {
  EXPECT_EQ(fault_of_size(0), Fault::tile_truncated);
  EXPECT_EQ(fault_of_size(bytes_3_arc_seconds - 1), Fault::tile_truncated);
  EXPECT_EQ(fault_of_size(bytes_3_arc_seconds), Fault::none);
  EXPECT_EQ(fault_of_size(bytes_3_arc_seconds + 1), Fault::tile_size_mismatch);
  EXPECT_EQ(fault_of_size(bytes_1_arc_second - 1), Fault::tile_size_mismatch);
  EXPECT_EQ(fault_of_size(bytes_1_arc_second), Fault::none);
  EXPECT_EQ(fault_of_size(bytes_1_arc_second + 2), Fault::tile_size_mismatch);
  EXPECT_EQ(fault_of_size(bytes_third_arc_second - 1), Fault::tile_size_mismatch);
  EXPECT_EQ(fault_of_size(bytes_third_arc_second), Fault::none);
  EXPECT_EQ(fault_of_size(bytes_third_arc_second + 1), Fault::tile_size_mismatch);
}

TEST(HgtTile, place_outside_the_world_is_refused) {
  const std::vector<std::byte> bytes(bytes_3_arc_seconds);
  EXPECT_EQ(parse_hgt(bytes, 90, 0).fault(), Fault::tile_location_mismatch);
  EXPECT_EQ(parse_hgt(bytes, -91, 0).fault(), Fault::tile_location_mismatch);
  EXPECT_EQ(parse_hgt(bytes, 0, 180).fault(), Fault::tile_location_mismatch);
  EXPECT_EQ(parse_hgt(bytes, 0, -181).fault(), Fault::tile_location_mismatch);
}

TEST(HgtTileDeath, posts_outside_the_grid_are_a_programmer_error) {
  const std::vector<std::byte> bytes(bytes_3_arc_seconds);
  const Result<HeightTile> tile = parse_hgt(bytes, 46, 8);
  ASSERT_TRUE(tile.ok());
  std::vector<float> two(2);
  EXPECT_DEATH(read_posts(tile.value(), 1201, 0, two), "");
  EXPECT_DEATH(read_posts(tile.value(), -1, 0, two), "");
  EXPECT_DEATH(read_posts(tile.value(), 0, 1200, two), "");
  EXPECT_DEATH(read_posts(tile.value(), 0, -1, two), "");
}

TEST(HeightTile, float_rows_are_given_as_they_are) {
  const std::vector<float> posts_m = {1, 2, 3, std::nanf(""), 5, 6};
  const PostGrid grid{46, 8, 0.5, 0.5, 2, 3};
  const HeightTile tile{grid, TileLayout::float32_rows, std::as_bytes(std::span(posts_m))};
  std::vector<float> row(2);
  read_posts(tile, 1, 1, row);
  EXPECT_EQ(row, (std::vector<float>{5, 6}));
  EXPECT_TRUE(std::isnan(post_m(tile, 1, 0)));
}

}  // namespace
}  // namespace ridgeline
