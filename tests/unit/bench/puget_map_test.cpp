// The map of Puget Sound: read, placed and written as it says.
#include "sim/bench/puget_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/bench/bench.hpp"
#include "tests/oracle/tile_files.hpp"
#include "tests/support/grey_png_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::sim {
namespace {

std::string write_png(const test::TemporaryFolder& folder, const char* name, int columns, int rows,
                      int bits, const std::function<double(int, int)>& value) {
  const std::string file = folder.file(name);
  test::write_grey_png(file, columns, rows, bits, value);
  return file;
}

int some_value(int column, int row) {
  return 20 * column + 7 * row;
}

PugetMap map_of(const test::TemporaryFolder& folder, int posts) {
  const std::string file = write_png(folder, "map.png", posts, posts, 16, some_value);
  PugetMap map;
  const Outcome read = read_puget(file, map);
  EXPECT_TRUE(read.ok()) << read.message;
  return map;
}

double metres_between(const GeodeticPosition& a, double latitude_deg, double longitude_deg) {
  const double north = (a.latitude_deg - latitude_deg) * 111'170;
  const double east = (a.longitude_deg - longitude_deg) * 76'200;
  return std::hypot(north, east);
}

TEST(PugetMap, known_summits_stand_near_their_surveyed_places) {
  const test::TemporaryFolder folder;
  const PugetMap map = map_of(folder, 1025);
  EXPECT_LT(metres_between(map.at(803, 529), 46.8523, -121.7603), 1000);  // Rainier
  EXPECT_LT(metres_between(map.at(940, 977), 46.2024, -121.4909), 2500);  // Adams
  EXPECT_LT(metres_between(map.at(600, 990), 46.1912, -122.1956), 2500);  // St. Helens
  const GeodeticPosition middle = map.at(512, 512);
  EXPECT_LT(metres_between(middle, 46.8818, -122.3707), 100);
  EXPECT_NEAR(metres_between(map.at(512, 511), middle.latitude_deg, middle.longitude_deg), 160, 1);
  EXPECT_NEAR(metres_between(map.at(513, 512), middle.latitude_deg, middle.longitude_deg), 160, 1);
}

TEST(PugetMap, a_finer_map_covers_the_same_ground) {
  const test::TemporaryFolder folder;
  const PugetMap coarse = map_of(folder, 129), fine = map_of(folder, 257);
  for (const double share : {0.0, 0.5, 1.0}) {
    const GeodeticPosition a = coarse.at(128 * share, 128 * share);
    const GeodeticPosition b = fine.at(256 * share, 256 * share);
    EXPECT_NEAR(a.latitude_deg, b.latitude_deg, 1e-9);
    EXPECT_NEAR(a.longitude_deg, b.longitude_deg, 1e-9);
  }
}

TEST(PugetMap, every_post_of_the_tile_is_one_of_the_picture) {
  const test::TemporaryFolder folder;
  const PugetMap map = map_of(folder, 65);
  ASSERT_TRUE(write_puget_tile(map, folder.path()).ok());
  const oracle::Tile tile = oracle::read_geotiff(folder.file("puget.tif"));
  ASSERT_EQ(tile.rows, 65);
  ASSERT_EQ(tile.columns, 65);
  EXPECT_NEAR(tile.west_deg, map.west_deg, 1e-9);
  EXPECT_NEAR(tile.south_deg + 64 * tile.lat_step_deg, map.north_deg, 1e-9);
  for (int row = 0; row < 65; ++row) {
    for (int column = 0; column < 65; ++column) {
      const double height_m = tile.posts[static_cast<std::size_t>(64 - row) * 65 + column];
      EXPECT_NEAR(height_m, 0.1 * some_value(column, row), 1e-3) << row << ' ' << column;
    }
  }
}

TEST(PugetMap, what_is_no_such_picture_is_refused_by_name) {
  const test::TemporaryFolder folder;
  const std::pair<std::string, const char*> wrong[] = {
      {folder.file("none.png"), "no such file"},
      {write_png(folder, "oblong.png", 80, 70, 16, some_value), "square"},
      {write_png(folder, "small.png", 32, 32, 16, some_value), "square"},
      {write_png(folder, "bytes.png", 65, 65, 8, [](int, int) { return 7; }), "16-bit"}};
  for (const auto& [file, word] : wrong) {
    PugetMap map;
    const Outcome read = read_puget(file, map);
    EXPECT_FALSE(read.ok()) << file;
    EXPECT_NE(read.message.find(file), std::string::npos) << read.message;
    EXPECT_NE(read.message.find(word), std::string::npos) << read.message;
  }
}

TEST(PugetViews, see_nothing_beyond_the_map) {
  const test::TemporaryFolder folder;
  const PugetMap map = map_of(folder, 1025);
  const std::vector<BenchView> views = puget_views(map, 16);
  ASSERT_EQ(views.size(), 16U);
  constexpr double range_m = puget_range_m;
  for (const BenchView& view : views) {
    const GeodeticPosition& eye = view.input.eye;
    const double north_m = (map.north_deg - eye.latitude_deg) * 111'100;
    const double south_m = 1024 * 160 - north_m;
    const double west_m = (eye.longitude_deg - map.west_deg) * 75'500;
    const double east_m = (map.at(1024, 0).longitude_deg - eye.longitude_deg) * 75'500;
    for (const double edge_m : {north_m, south_m, west_m, east_m}) EXPECT_GT(edge_m, range_m);
  }
}

}  // namespace
}  // namespace ridgeline::sim
