#include "sim/synthetic/tile_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace ridgeline::sim {
namespace {

using test::bytes_of;
using test::ScratchFolder;

int post(const std::vector<unsigned char>& bytes, int posts, int row_from_north, int column) {
  const std::size_t at = 2 * static_cast<std::size_t>(row_from_north * posts + column);
  const int value = bytes[at] << 8 | bytes[at + 1];
  return value < 0x8000 ? value : value - 0x10000;
}

TEST(TileName, says_the_south_west_corner) {
  EXPECT_EQ(tile_name(46, 8), "N46E008.hgt");
  EXPECT_EQ(tile_name(-49, -124), "S49W124.hgt");
  EXPECT_EQ(tile_name(0, 0), "N00E000.hgt");
  EXPECT_EQ(tile_name(-1, -1), "S01W001.hgt");
}

TEST(StoredHeight, rounds_half_away_from_zero_and_keeps_unknown_unknown) {
  EXPECT_EQ(stored_height_m(0.49), 0);
  EXPECT_EQ(stored_height_m(0.5), 1);
  EXPECT_EQ(stored_height_m(-0.5), -1);
  EXPECT_EQ(stored_height_m(-12.4), -12);
  EXPECT_EQ(stored_height_m(8848.2), 8848);
  EXPECT_EQ(stored_height_m(std::numeric_limits<double>::quiet_NaN()), -32768);
  EXPECT_EQ(stored_height_m(40'000), -32768);
  EXPECT_EQ(stored_height_m(-std::numeric_limits<double>::infinity()), -32768);
}

TEST(WriteTile, rows_run_from_north_to_south_in_big_endian) {
  const ScratchFolder folder("tile");
  const auto height_m = [](double latitude_deg, double longitude_deg) {
    return std::round((latitude_deg - 10) * 1000) + std::round((longitude_deg - 20) * 10) - 300;
  };
  ASSERT_TRUE(write_tile_with(folder.path(), 10, 20, 11, height_m).ok());
  const std::vector<unsigned char> bytes = bytes_of(folder.file("N10E020.hgt"));
  ASSERT_EQ(bytes.size(), 2U * 11 * 11);
  EXPECT_EQ(post(bytes, 11, 10, 0), -300);        // south-west
  EXPECT_EQ(post(bytes, 11, 10, 10), -300 + 10);  // south-east
  EXPECT_EQ(post(bytes, 11, 0, 0), -300 + 1000);  // north-west
  EXPECT_EQ(post(bytes, 11, 4, 3), -300 + 600 + 3);
}

TEST(WriteTile, neighbours_ask_for_their_common_edge_at_the_same_place) {
  const ScratchFolder folder("edge");
  std::vector<double> west_edge;
  std::vector<double> east_edge;
  const auto collect = [](std::vector<double>& edge) {
    return [&edge](double latitude_deg, double longitude_deg) {
      if (longitude_deg == -7) edge.push_back(latitude_deg);
      return 0.0;
    };
  };
  ASSERT_TRUE(write_tile_with(folder.path(), -4, -8, 1201, collect(west_edge)).ok());
  ASSERT_TRUE(write_tile_with(folder.path(), -4, -7, 1201, collect(east_edge)).ok());
  ASSERT_EQ(west_edge.size(), 1201U);
  EXPECT_EQ(west_edge, east_edge);
}

TEST(WriteTile, fault_names_the_tile) {
  const ScratchFolder folder("tile_fault");
  const Outcome outcome =
      write_tile_with(folder.file("missing"), 1, 2, 3, [](double, double) { return 0.0; });
  EXPECT_EQ(outcome.fault, Fault::file_unwritable);
  EXPECT_NE(outcome.message.find("missing/N01E002.hgt"), std::string::npos);
}

TEST(ConePeak, falls_evenly_to_its_foot) {
  const HeightFunction cone = cone_peak(46.5, 8.5, 3000, 0.5, 400);
  EXPECT_DOUBLE_EQ(cone(46.5, 8.5), 3000);
  EXPECT_NEAR(cone(46.5 + 0.01, 8.5), 3000 - 0.5 * 1111.95, 0.01);
  EXPECT_NEAR(cone(46.5, 8.5 + 0.01), 3000 - 0.5 * 1111.95 * 0.6884, 0.1);
  EXPECT_EQ(cone(47.5, 8.5), 400);
}

}  // namespace
}  // namespace ridgeline::sim
