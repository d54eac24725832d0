// The land of a case: what its layers say, and files that the product's own readers read back.
#include "sim/attack/land.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "platform/terrain_folder.hpp"
#include "sim/attack/tile_files.hpp"
#include "sim/geotiff/geotiff_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::sim {
namespace {

AttackCase with_land(const std::string& layers, const std::string& tile) {
  AttackCase c;
  const std::string wrong =
      parse_case("at=46,8 " + layers + " tile=" + tile + " pose=46,8,1000,0,0,0,0", c);
  EXPECT_EQ(wrong, "");
  return c;
}

const std::string patch = "tif32:45.99,7.99,1200,1200,25,25";  // the place is post (12, 12)

float post(const std::string& layers, int row, int column, const std::string& tile = patch) {
  return CaseLand(with_land(layers, tile)).post_m(0, 12 + row, 12 + column);
}

TEST(AttackLand, layers_do_what_they_are_named_after) {
  EXPECT_EQ(post("", 0, 0), 0);
  EXPECT_EQ(post("land=flat:7.5", 3, 4), 7.5F);
  EXPECT_EQ(post("land=flat:7.5", 3, 4, "tif16:45.99,7.99,1200,1200,25,25"), 8);
  EXPECT_EQ(post("land=slope:2,-1", 3, 4), 5);
  EXPECT_EQ(post("land=slope:1e-40,0", 0, 4), 4e-40F);  // smaller than any normal number
  EXPECT_EQ(post("land=walls:100,5,1,0,2", 2, 9), 100);
  EXPECT_EQ(post("land=walls:100,5,1,0,2", 3, 9), 0);
  EXPECT_EQ(post("land=walls:100,5,1,1,2", -3, -3), 100);
  EXPECT_EQ(post("land=walls:100,5,1,2,0", 2, 3), 100);
  EXPECT_EQ(post("land=walls:100,5,1,3,0", 7, 2), 100);
  EXPECT_EQ(post("land=cliffs:9000,4,1,0", 0, 3), 0);
  EXPECT_EQ(post("land=cliffs:9000,4,1,0", 0, 4), 9000);
  EXPECT_EQ(post("land=checker:10,1", 0, 1), 10);
  EXPECT_EQ(post("land=checker:10,1", 1, 1), 0);
  EXPECT_EQ(post("land=checker:10,1", -1, -2), 10);
  EXPECT_EQ(post("land=flat:37 land=stairs:25", 0, 0), 25);
  EXPECT_EQ(post("land=flat:37 land=clamp:-10,30", 0, 0), 30);
  EXPECT_EQ(post("land=flat:20000", 0, 0), 9000);
  EXPECT_EQ(post("land=flat:-20000", 0, 0), -12000);
}

TEST(AttackLand, unknown_ground_stays_unknown) {
  EXPECT_TRUE(std::isnan(post("land=half:0,3 land=flat:5", 3, 0)));
  EXPECT_EQ(post("land=half:0,3 land=flat:5", 2, 0), 5);
  EXPECT_TRUE(std::isnan(post("land=stripes:4,1,1,0", 0, 8)));
  EXPECT_FALSE(std::isnan(post("land=stripes:4,1,1,0", 0, 7)));
  EXPECT_TRUE(std::isnan(post("land=box:-1,-2,3,4", 1, 1)));
  EXPECT_FALSE(std::isnan(post("land=box:-1,-2,3,4", 1, 2)));
  EXPECT_TRUE(std::isnan(post("land=box:0,0,1,1 land=checker:10,1", 0, 0)));
}

TEST(AttackLand, lotteries_draw_about_as_many_posts_as_they_say) {
  const auto drawn = [](const std::string& layer, auto counts) {
    const std::vector<float> posts =
        posts_of(with_land(layer, "tif32:45.9,7.9,1200,1200,200,200"), 0);
    return static_cast<double>(std::count_if(posts.begin(), posts.end(), counts));
  };
  const auto is_high = [](float h) { return h > 0; };
  const auto is_void = [](float h) { return std::isnan(h); };
  EXPECT_NEAR(drawn("land=spires:500,10,1", is_high), 4'000, 300);
  EXPECT_NEAR(drawn("land=holes:100,1", is_void), 400, 80);
  EXPECT_GT(drawn("land=islands:0.2,2000,1", is_void), 400);
  EXPECT_LT(drawn("land=islands:0.2,2000,1", is_void), 20'000);
}

TEST(AttackLand, ground_is_bilinear_and_the_taller_of_two_tiles) {
  AttackCase c = with_land("land=slope:10,0 land=seam:100", "dt0:45,8");
  c.tiles.push_back({TileFormat::dt0, 46, 8, 0, 0, 0, 0});
  const CaseLand land(c);
  EXPECT_NEAR(land.ground_m(45.5, 8 + 2.5 / 120), 25, 1e-6);
  EXPECT_NEAR(land.ground_m(46, 8.5), 700, 1e-6);  // the tile in the north is 100 m higher
  EXPECT_TRUE(std::isnan(land.ground_m(47.5, 8.5)));
}

class Written : public testing::TestWithParam<const char*> {};

TEST_P(Written, tile_is_read_back_post_for_post) {
  const test::TemporaryFolder folder;
  const AttackCase c = with_land("land=rough:4000,3 land=flat:-900 land=holes:20,4", GetParam());
  CaseFiles files;
  ASSERT_TRUE(write_case(folder.path(), c, files).ok());
  GeotiffReader geotiff;
  auto opened = TerrainFolder::open(files.terrain_folder, &geotiff);
  ASSERT_TRUE(opened.ok());
  TerrainFolder terrain = std::move(opened).value();
  const PostGrid grid = grid_of(c.tiles[0]);
  terrain.select({grid.south_deg, grid.west_deg, grid.north_deg(), grid.east_deg()});
  ASSERT_EQ(terrain.tiles().size(), 1U);
  ASSERT_TRUE(terrain.refused().empty());
  const PostGrid& read = terrain.tiles()[0].grid;
  EXPECT_NEAR(read.south_deg, grid.south_deg, 1e-9);
  EXPECT_NEAR(read.west_deg, grid.west_deg, 1e-9);
  EXPECT_NEAR(read.latitude_step_deg / grid.latitude_step_deg, 1, 1e-12);
  EXPECT_NEAR(read.longitude_step_deg / grid.longitude_step_deg, 1, 1e-12);
  ASSERT_EQ(read.rows, grid.rows);
  ASSERT_EQ(read.columns, grid.columns);
  const std::vector<float> posts = posts_of(c, 0);
  std::vector<float> row(static_cast<std::size_t>(grid.columns));
  for (int r = 0; r < grid.rows; ++r) {
    read_posts(terrain.tiles()[0], r, 0, row);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const float written = posts[static_cast<std::size_t>(r) * row.size() + k];
      ASSERT_TRUE(row[k] == written || (std::isnan(row[k]) && std::isnan(written)))
          << r << ' ' << k << ' ' << row[k] << ' ' << written;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Written,
                         testing::Values("dt0:46,8", "dt0:-71,-66", "dt1:60,-180", "hgt:-1,-1",
                                         "tif16:45.5,8.25,1200,600,40,70",
                                         "tif32:-33.2,179.9,120,40,20,30",
                                         "tif32:89,-180,120,1,121,361"));

}  // namespace
}  // namespace ridgeline::sim
