#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/geotiff/geotiff_reader.hpp"
#include "tests/support/geotiff_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline {
namespace {

using test::GeotiffRecipe;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class GeotiffRefusal : public testing::Test {
 protected:
  void write(const GeotiffRecipe& recipe) { test::write_geotiff(path_, recipe); }

  void expect_message(const FileProblem& problem, Fault fault, const std::string& detail) {
    EXPECT_EQ(fault_id(problem.fault), fault_id(fault)) << detail;
    EXPECT_EQ(problem.file, path_);
    EXPECT_THAT(problem.message, AllOf(StartsWith(path_ + ": " + std::string(fault_text(fault))),
                                       HasSubstr(detail)));
    EXPECT_EQ(problem.message.find('\n'), std::string::npos);
  }

  // Neither its place nor its posts are to be had; nothing is printed.
  void expect_refused(Fault fault, const std::string& detail) {
    testing::internal::CaptureStderr();
    const FileResult<PostGrid> grid = reader_.describe(path_);
    const FileResult<DecodedTile> tile = reader_.load(path_);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_FALSE(grid.ok()) << detail;
    ASSERT_FALSE(tile.ok()) << detail;
    expect_message(grid.problem(), fault, detail);
    expect_message(tile.problem(), fault, detail);
  }

  TemporaryFolder folder_;
  GeotiffReader reader_;
  std::string path_ = folder_.file("tile.tif");
};

TEST_F(GeotiffRefusal, projected_raster_is_refused_with_the_name_of_its_system) {
  GeotiffRecipe recipe;
  recipe.system = "EPSG:32611";
  recipe.corner_and_steps = {376313, 30, 0, 3807917, 0, -30};
  write(recipe);
  expect_refused(Fault::tile_projected, "WGS 84 / UTM zone 11N");
}

TEST_F(GeotiffRefusal, system_that_is_not_wgs84_degrees) {
  GeotiffRecipe recipe;
  recipe.system = "EPSG:4267";
  write(recipe);
  expect_refused(Fault::tile_unsupported, "NAD27 is not on the ellipsoid of WGS 84");
  recipe.system = "";
  write(recipe);
  expect_refused(Fault::tile_unsupported, "no coordinate system");
  recipe.system = "+proj=longlat +datum=WGS84 +pm=paris +no_defs";
  write(recipe);
  expect_refused(Fault::tile_unsupported, "does not count degrees from Greenwich");
}

TEST_F(GeotiffRefusal, georeference_that_is_no_grid_of_posts) {
  GeotiffRecipe recipe;
  recipe.corner_and_steps = {8, 0.03, 0.001, 47, 0.001, -0.03};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "rotated");
  recipe.corner_and_steps = {9, -0.03, 0, 47, 0, -0.03};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "mirrored");
  recipe.corner_and_steps = {8, 0.03, 0, 47, 0, -1e-7};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "apart");
  recipe.corner_and_steps = {8, 0.03, 0, 91, 0, -0.03};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "poles");
  recipe.corner_and_steps = {-180, 15, 0, 80, 0, -0.03};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "round the Earth");
  recipe.corner_and_steps = {};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "no georeference");
  recipe = {};
  recipe.rows = 1;
  write(recipe);
  expect_refused(Fault::tile_unsupported, "31 x 1 posts");
}

TEST_F(GeotiffRefusal, raster_too_large_for_memory) {
  GeotiffRecipe recipe;
  recipe.columns = 36001;
  recipe.rows = 36001;
  recipe.corner_and_steps = {8, 1.0 / 3600, 0, 47, 0, -1.0 / 3600};
  recipe.options = {"SPARSE_OK=TRUE", "TILED=YES"};
  write(recipe);
  expect_refused(Fault::tile_unsupported, "36001 x 36001 posts");
}

TEST_F(GeotiffRefusal, samples_that_are_no_heights_in_metres) {
  GeotiffRecipe recipe;
  recipe.type = "Byte";
  write(recipe);
  expect_refused(Fault::tile_unsupported, "samples of type Byte");
  recipe.type = "CFloat32";
  write(recipe);
  expect_refused(Fault::tile_unsupported, "samples of type CFloat32");
  recipe.type = "Int16";
  recipe.bands = 3;
  write(recipe);
  expect_refused(Fault::tile_unsupported, "3 bands");
  recipe.bands = 1;
  recipe.unit = "ft";
  write(recipe);
  expect_refused(Fault::tile_unsupported, "heights in ft");
}

TEST_F(GeotiffRefusal, file_that_is_no_geotiff) {
  expect_refused(Fault::tile_unreadable, "No such file");
  test::write_bytes(path_, {});
  expect_refused(Fault::tile_truncated, "0 bytes");
  test::write_bytes(path_, std::vector<std::byte>(5000, std::byte{'x'}));
  expect_refused(Fault::tile_header_corrupt, "not recognized");
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  expect_refused(Fault::tile_unreadable, "directory");
}

TEST_F(GeotiffRefusal, damaged_directory) {
  write({});
  std::vector<std::byte> bytes = test::read_bytes(path_);
  bytes[4] = std::byte{0xF0};  // the directory is now said to lie beyond the end
  bytes[5] = std::byte{0xFF};
  bytes[6] = std::byte{0xFF};
  test::write_bytes(path_, bytes);
  expect_refused(Fault::tile_header_corrupt, "directory");
}

TEST_F(GeotiffRefusal, damaged_pixels) {
  GeotiffRecipe recipe;
  recipe.columns = 301;
  recipe.rows = 301;
  recipe.options = {"COMPRESS=DEFLATE"};
  recipe.samples.assign(301 * 301, 0);
  for (std::size_t i = 0; i < recipe.samples.size(); ++i) {
    recipe.samples[i] = static_cast<double>((i * i) % 8999);
  }
  recipe.corner_and_steps = {8, 1.0 / 300, 0, 47, 0, -1.0 / 300};
  write(recipe);
  std::vector<std::byte> bytes = test::read_bytes(path_);
  const auto middle = bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2);
  std::fill(middle, middle + 20000, std::byte{0xFF});  // at least one strip from its start on
  test::write_bytes(path_, bytes);
  testing::internal::CaptureStderr();
  const FileResult<DecodedTile> tile = reader_.load(path_);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(tile.ok());
  expect_message(tile.problem(), Fault::tile_record_corrupt, "ecod");
}

TEST_F(GeotiffRefusal, every_cut_is_refused_without_a_crash) {
  GeotiffRecipe recipe;
  recipe.samples.assign(31 * 31, 500);
  write(recipe);
  const std::vector<std::byte> bytes = test::read_bytes(path_);
  for (std::size_t size = 0; size < bytes.size(); size += 31) {
    test::write_bytes(path_, std::span(bytes).first(size));
    const FileResult<DecodedTile> tile = reader_.load(path_);
    ASSERT_FALSE(tile.ok()) << size << " of " << bytes.size();
    EXPECT_THAT(tile.problem().message, StartsWith(path_ + ": "));
  }
}

}  // namespace
}  // namespace ridgeline
