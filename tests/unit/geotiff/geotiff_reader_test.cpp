#include "sim/geotiff/geotiff_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "platform/terrain_folder.hpp"
#include "tests/support/geotiff_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline {
namespace {

using test::GeotiffRecipe;
using test::TemporaryFolder;

// Sample of the first-row-first raster: tells its row and column.
double ramp(int row, int column) {
  return 20.0 * row + column;
}

std::vector<double> ramp_samples(int rows, int columns) {
  std::vector<double> samples;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) samples.push_back(ramp(row, column));
  }
  return samples;
}

class Geotiff : public testing::Test {
 protected:
  DecodedTile loaded(const GeotiffRecipe& recipe) {
    const std::string path = folder_.file("tile.tif");
    test::write_geotiff(path, recipe);
    const FileResult<PostGrid> grid = reader_.describe(path);
    EXPECT_TRUE(grid.ok()) << grid.problem().message;
    FileResult<DecodedTile> tile = reader_.load(path);
    EXPECT_TRUE(tile.ok()) << tile.problem().message;
    EXPECT_EQ(tile.value().grid, grid.value());
    return std::move(tile).value();
  }

  TemporaryFolder folder_;
  GeotiffReader reader_;
};

GeotiffRecipe ramp_recipe() {
  GeotiffRecipe recipe;
  recipe.samples = ramp_samples(recipe.rows, recipe.columns);
  return recipe;
}

float post_m(const DecodedTile& tile, int row, int column) {
  return tile.posts_m[static_cast<std::size_t>(row * tile.grid.columns + column)];
}

void expect_ramp_from_the_south(const DecodedTile& tile) {
  for (int row = 0; row < tile.grid.rows; ++row) {
    for (int column = 0; column < tile.grid.columns; ++column) {
      const double expected = ramp(tile.grid.rows - 1 - row, column);
      ASSERT_EQ(post_m(tile, row, column), static_cast<float>(expected)) << row << " " << column;
    }
  }
}

TEST_F(Geotiff, names_are_accepted_by_extension) {
  EXPECT_TRUE(reader_.accepts("a/N46E008.tif"));
  EXPECT_TRUE(reader_.accepts("x.TIFF"));
  EXPECT_FALSE(reader_.accepts("x.tif.gz"));
  EXPECT_FALSE(reader_.accepts("tif"));
}

TEST_F(Geotiff, posts_stand_exactly_on_the_degree) {
  const DecodedTile tile = loaded(ramp_recipe());
  EXPECT_EQ(tile.grid.south_deg, 46.0);
  EXPECT_EQ(tile.grid.west_deg, 8.0);
  EXPECT_EQ(tile.grid.latitude_step_deg, 1.0 / 30);
  EXPECT_EQ(tile.grid.longitude_step_deg, 1.0 / 30);
  EXPECT_DOUBLE_EQ(tile.grid.north_deg(), 47.0);
  EXPECT_DOUBLE_EQ(tile.grid.east_deg(), 9.0);
  expect_ramp_from_the_south(tile);
}

TEST_F(Geotiff, pixel_is_point_stands_where_pixel_is_area_does) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.pixel_is_point = true;
  const DecodedTile tile = loaded(recipe);
  EXPECT_EQ(tile.grid.south_deg, 46.0);
  EXPECT_EQ(tile.grid.west_deg, 8.0);
}

TEST_F(Geotiff, south_row_first_is_not_turned) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.corner_and_steps = {8 - 1.0 / 60, 1.0 / 30, 0, 46 - 1.0 / 60, 0, 1.0 / 30};
  const DecodedTile tile = loaded(recipe);
  EXPECT_EQ(tile.grid.south_deg, 46.0);
  EXPECT_EQ(post_m(tile, 0, 3), 3.0F);
  EXPECT_EQ(post_m(tile, 30, 3), static_cast<float>(ramp(30, 3)));
}

TEST_F(Geotiff, longitudes_beyond_180_are_brought_back) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.corner_and_steps[0] = 352 - 1.0 / 60;
  EXPECT_EQ(loaded(recipe).grid.west_deg, -8.0);
  recipe.corner_and_steps[0] = 180 - 1.0 / 60;
  EXPECT_EQ(loaded(recipe).grid.west_deg, -180.0);
}

class GeotiffType : public Geotiff, public testing::WithParamInterface<const char*> {};

TEST_P(GeotiffType, comes_back_as_it_was_written) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.type = GetParam();
  recipe.options = {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=DEFLATE"};
  expect_ramp_from_the_south(loaded(recipe));
}

INSTANTIATE_TEST_SUITE_P(Types, GeotiffType,
                         testing::Values("Int16", "UInt16", "Int32", "Float32", "Float64"),
                         [](const auto& type) { return std::string(type.param); });

TEST_F(Geotiff, no_data_is_unknown_in_every_type) {
  const std::pair<const char*, double> cases[] = {
      {"Int16", -32767},         {"Int16", 0},
      {"UInt16", 65535},         {"Float32", -3.4028234663852886e38},
      {"Float32", std::nan("")}, {"Float64", -9999}};
  for (const auto& [type, no_data] : cases) {
    GeotiffRecipe recipe = ramp_recipe();
    recipe.type = type;
    recipe.no_data = no_data;
    recipe.samples[5] = no_data;
    const DecodedTile tile = loaded(recipe);
    EXPECT_TRUE(std::isnan(post_m(tile, 30, 5))) << type << no_data;
    EXPECT_EQ(post_m(tile, 30, 6), 6.0F);
  }
}

TEST_F(Geotiff, without_no_data_only_impossible_heights_are_unknown) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.type = "Float32";
  recipe.samples[0] = std::nan("");
  recipe.samples[1] = std::numeric_limits<double>::infinity();
  recipe.samples[2] = -32768;
  recipe.samples[3] = 9000.5;
  recipe.samples[4] = 8848.5;
  recipe.samples[5] = 0;
  const DecodedTile tile = loaded(recipe);
  for (int column = 0; column < 4; ++column) {
    EXPECT_TRUE(std::isnan(post_m(tile, 30, column))) << column;
  }
  EXPECT_EQ(post_m(tile, 30, 4), 8848.5F);
  EXPECT_EQ(post_m(tile, 30, 5), 0.0F);
}

TEST_F(Geotiff, scale_and_offset_apply_to_heights_but_not_to_no_data) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.type = "UInt16";
  recipe.no_data = 65535;
  recipe.scale = 0.125;
  recipe.offset_m = -500;
  recipe.samples[0] = 65535;
  recipe.samples[1] = 65534;
  recipe.samples[2] = 4001;
  const DecodedTile tile = loaded(recipe);
  EXPECT_TRUE(std::isnan(post_m(tile, 30, 0)));
  EXPECT_EQ(post_m(tile, 30, 1), 65534 * 0.125F - 500);
  EXPECT_EQ(post_m(tile, 30, 2), 0.125F);
}

TEST_F(Geotiff, masked_posts_are_unknown) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.mask.assign(recipe.samples.size(), 255);
  recipe.mask[7] = 0;
  const DecodedTile tile = loaded(recipe);
  EXPECT_TRUE(std::isnan(post_m(tile, 30, 7)));
  EXPECT_EQ(post_m(tile, 30, 8), 8.0F);
}

TEST_F(Geotiff, holes_of_a_sparse_file_are_unknown) {
  GeotiffRecipe recipe;
  recipe.options = {"SPARSE_OK=TRUE"};
  const DecodedTile tile = loaded(recipe);
  for (const float height_m : tile.posts_m) ASSERT_TRUE(std::isnan(height_m));
}

TEST_F(Geotiff, metres_and_nad83_are_taken) {
  GeotiffRecipe recipe = ramp_recipe();
  recipe.unit = "metre";
  recipe.system = "EPSG:4269";
  expect_ramp_from_the_south(loaded(recipe));
}

TEST(SnappedAxis, rounded_georeference_is_put_on_whole_steps) {
  const PostAxis snapped = snapped_axis({-113.23916654611739, 0.00083333333327777963}, 465);
  EXPECT_EQ(snapped.first_deg, -135887.0 / 1200);
  EXPECT_EQ(snapped.step_deg, 1.0 / 1200);
}

TEST(SnappedAxis, posts_elsewhere_stay) {
  const double step_deg = 1.0 / 1200;
  for (const PostAxis& axis : {PostAxis{8 + 0.25 * step_deg, step_deg},  // between the seconds
                               PostAxis{8 + 2e-6, step_deg},             // 0.2 m off
                               PostAxis{8, step_deg + 2e-9},             // 2e-6 degree at the end
                               PostAxis{8, 0.0007},  // no whole part of a degree
                               PostAxis{0, 2.0}}) {  // wider than a degree
    const PostAxis same = snapped_axis(axis, 1001);
    EXPECT_EQ(same.first_deg, axis.first_deg);
    EXPECT_EQ(same.step_deg, axis.step_deg);
  }
}

TEST_F(Geotiff, terrain_folder_shows_it_beside_others) {
  test::write_geotiff(folder_.file("alps.tif"), ramp_recipe());
  FileResult<TerrainFolder> terrain = TerrainFolder::open(folder_.path(), &reader_);
  ASSERT_TRUE(terrain.ok());
  terrain.value().select({46.5, 8.5, 46.6, 8.6});
  ASSERT_EQ(terrain.value().tiles().size(), 1U);
  const HeightTile& tile = terrain.value().tiles()[0];
  float height_m = 0;
  read_posts(tile, 0, 4, {&height_m, 1});
  EXPECT_EQ(height_m, static_cast<float>(ramp(30, 4)));
  EXPECT_EQ(terrain.value().decoded_bytes(), 31U * 31U * 4U);
}

}  // namespace
}  // namespace ridgeline
