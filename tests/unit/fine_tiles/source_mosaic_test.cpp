#include "tests/fine_tiles/source_mosaic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/synthetic/synthetic_terrain.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::fine {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::StartsWith;

FileProblem problem_of(const std::string& folder) {
  const FileResult<SourceMosaic> mosaic = mosaic_of_folder(folder);
  EXPECT_FALSE(mosaic.ok());
  return mosaic.ok() ? FileProblem{} : mosaic.problem();
}

void write_level(const TemporaryFolder& folder, const std::string& name, int height_m) {
  test::write_hgt(folder.file(name), 1201, [=](int, int) { return height_m; });
}

TEST(SourceMosaic, tiles_of_a_folder_join_with_the_taller_post_on_their_edge) {
  const TemporaryFolder folder;
  test::write_hgt(folder.file("S01W001.hgt"), 1201, [](int row, int column) -> std::optional<int> {
    if (column == 1200 && row == 5) return std::nullopt;
    return column == 1200 ? 40 : row;
  });
  test::write_hgt(folder.file("s01e000.hgt"), 1201, [](int row, int column) -> std::optional<int> {
    if (column == 0 && row == 6) return std::nullopt;
    if (column == 9 && row == 9) return std::nullopt;
    return column == 0 ? row : -300;
  });
  const FileResult<SourceMosaic> joined = mosaic_of_folder(folder.path());
  ASSERT_TRUE(joined.ok()) << joined.problem().message;
  const SourceMosaic& mosaic = joined.value();
  EXPECT_EQ(mosaic.cell_rows, 1);
  EXPECT_EQ(mosaic.cell_columns, 2);
  EXPECT_EQ(mosaic.post_m(17, 1199), 17);
  EXPECT_EQ(mosaic.post_m(17, 1200), 40);
  EXPECT_EQ(mosaic.post_m(77, 1200), 77);
  EXPECT_EQ(mosaic.post_m(5, 1200), 5);   // known on one side only
  EXPECT_EQ(mosaic.post_m(6, 1200), 40);  // and on the other
  EXPECT_EQ(mosaic.post_m(9, 1209), void_post);
  EXPECT_EQ(mosaic.post_m(1200, 2400), -300);
  EXPECT_THAT(mosaic.made_from, HasSubstr("S01W001.hgt s01e000.hgt"));
}

TEST(SourceMosaic, a_cell_that_is_missing_is_named) {
  const TemporaryFolder folder;
  write_level(folder, "N46E008.hgt", 1);
  write_level(folder, "N47E009.hgt", 1);
  EXPECT_THAT(problem_of(folder.path()).message, HasSubstr("N46E009.hgt is missing"));
}

TEST(SourceMosaic, bad_sources_are_refused_by_name) {
  const TemporaryFolder folder;
  EXPECT_EQ(problem_of(folder.path()).fault, Fault::folder_without_tiles);
  EXPECT_EQ(problem_of(folder.path() + "/none").fault, Fault::folder_unreadable);
  test::write_bytes(folder.file("N46E008.hgt"), std::vector<std::byte>(100));
  FileProblem problem = problem_of(folder.path());
  EXPECT_EQ(problem.fault, Fault::tile_truncated);
  EXPECT_THAT(problem.message, StartsWith(folder.path() + "/N46E008.hgt: "));
  test::write_bytes(folder.file("N46E008.hgt"), std::vector<std::byte>(2 * 3601 * 3601));
  EXPECT_EQ(problem_of(folder.path()).fault, Fault::tile_size_mismatch);
  write_level(folder, "N46E008.hgt", 1);
  write_level(folder, "n46e008.copy.hgt", 1);
  EXPECT_THAT(problem_of(folder.path()).message, HasSubstr("second tile"));
  write_level(folder, "alps.hgt", 1);
  EXPECT_EQ(problem_of(folder.path()).fault, Fault::tile_name_unknown);
}

TEST(SourceMosaic, synthetic_source_is_the_island) {
  const SourceMosaic mosaic = synthetic_mosaic(40);
  EXPECT_EQ(mosaic.rows(), 81);
  EXPECT_EQ(mosaic.columns(), 81);
  EXPECT_THAT(mosaic.made_from, HasSubstr("synthetic"));
  int mountains = 0;
  for (int row = 0; row < 81; ++row) {
    for (int column = 0; column < 81; ++column) {
      const double height_m =
          sim::synthetic_height_m((-49 * 40 + row) / 40.0, (-124 * 40 + column) / 40.0);
      ASSERT_EQ(mosaic.post_m(row, column), sim::stored_height_m(height_m));
      if (height_m > 1000) ++mountains;
    }
  }
  EXPECT_GT(mountains, 100);
}

}  // namespace
}  // namespace ridgeline::fine
