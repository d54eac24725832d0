#include "sim/terrain_input/coverage_list.hpp"

#include "sim/terrain_input/statements.hpp"
#include "tests/unit/terrain_input/input_file.hpp"

namespace ridgeline::sim {
namespace {

using Cells = std::vector<TileLocation>;

Cells cells_of(std::string_view text) {
  const InputFile file(text);
  const auto cells = coverage_list(file.path());
  EXPECT_TRUE(cells.ok()) << cells.problem().message;
  return cells.ok() ? cells.value() : Cells{};
}

void expect_refused(std::string_view text, int line, const std::string& words) {
  const InputFile file(text);
  const auto cells = coverage_list(file.path());
  ASSERT_FALSE(cells.ok()) << text;
  expect_problem(file, cells.problem(), Fault::file_malformed, line, words);
}

TEST(CoverageList, cells_are_read_in_any_case_and_sorted) {
  EXPECT_EQ(cells_of("sea N46E008\nsea s01w073\nsea N46w008\n"),
            (Cells{{-1, -73}, {46, -8}, {46, 8}}));
}

TEST(CoverageList, corners_of_the_world_are_cells) {
  EXPECT_EQ(cells_of("sea S90W180\nsea N89E179\nsea N00E000\n"),
            (Cells{{-90, -180}, {0, 0}, {89, 179}}));
}

TEST(CoverageList, comments_blank_lines_and_line_ends_are_free) {
  EXPECT_EQ(cells_of("\xef\xbb\xbf# the gulf\r\n\r\n \t \n  sea \t N10E010  # deep\r\nSEA N11E010"),
            (Cells{{10, 10}, {11, 10}}));
  EXPECT_EQ(cells_of("sea\rN10E010\n"), (Cells{{10, 10}})) << "the oracle reads it so";
  EXPECT_EQ(cells_of(""), Cells{});
  EXPECT_EQ(cells_of("#sea N10E010"), Cells{});
}

TEST(CoverageList, a_cell_stated_twice_is_there_once) {
  EXPECT_EQ(cells_of("sea N10E010\nsea n10e010\n"), (Cells{{10, 10}}));
}

TEST(CoverageList, a_malformed_line_is_named) {
  expect_refused("sea N10E010\n\nlake N10E010\n", 3, "'lake'");
  expect_refused("sea\n", 1, "one cell");
  expect_refused("sea N10E010 N11E010\n", 1, "one cell");
  expect_refused("seaN10E010\n", 1, "expected sea");
}

TEST(CoverageList, what_is_no_cell_is_named) {
  for (const char* cell : {"N90E000", "S91E000", "N10E180", "N10W181", "E010N10", "N10E01",
                           "N10E0100", "N10_E010", "N10E010.hgt", "N1xE010", "N-1E010", "10,10"}) {
    expect_refused(std::string("# cells\nsea ") + cell, 2, cell);
  }
}

TEST(CoverageList, binary_and_long_lines_do_not_reach_the_message) {
  expect_refused(std::string("sea N10E010\n") + std::string(1, '\0') + "\x01\xff\x1b[2J", 2,
                 "'???");
  expect_refused(std::string(500'000, 'x'), 1, "'xxxxxxxxxxxxxxxxxxxxxxxx...'");
}

TEST(CoverageList, files_that_cannot_be_read_are_named) {
  const test::TemporaryFolder folder;
  for (const std::string& path : {folder.path() + "/none.txt", folder.path()}) {
    const auto cells = coverage_list(path);
    ASSERT_FALSE(cells.ok());
    EXPECT_EQ(cells.problem().fault, Fault::file_unreadable);
    EXPECT_THAT(cells.problem().message, testing::StartsWith(path + ": file cannot be read ("));
  }
  const InputFile large(std::string(most_statement_bytes + 1, '#'));
  EXPECT_EQ(coverage_list(large.path()).problem().fault, Fault::capacity_exceeded);
}

}  // namespace
}  // namespace ridgeline::sim
