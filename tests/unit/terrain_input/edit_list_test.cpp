#include "sim/terrain_input/edit_list.hpp"

#include <cmath>
#include <cstdint>

#include "tests/unit/terrain_input/input_file.hpp"

namespace ridgeline::sim {
namespace {

using Edits = std::vector<TerrainEdit>;

Edits edits_of(std::string_view text) {
  const InputFile file(text);
  auto edits = edit_list(file.path());
  EXPECT_TRUE(edits.ok()) << edits.problem().message;
  return edits.ok() ? std::move(edits).value() : Edits{};
}

void expect_refused(std::string_view text, int line, const std::string& words,
                    Fault fault = Fault::file_malformed) {
  const InputFile file(text);
  const auto edits = edit_list(file.path());
  ASSERT_FALSE(edits.ok()) << text.substr(0, 80);
  expect_problem(file, edits.problem(), fault, line, words);
}

TEST(EditList, an_edit_has_its_time_place_and_heights) {
  const Edits edits = edits_of(
      "# a crane\n"
      "1700000012.5 46.25 -8.5 3 1.5 2 3  1 -2.5 3e2 void 9000 -12000 # two rows\n");
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0].time_s, 1700000012.5);
  EXPECT_EQ(edits[0].grid, (PostGrid{46.25, -8.5, 3.0 / 3600, 1.5 / 3600, 2, 3}));
  EXPECT_EQ(edits[0].line, 2);
  const std::vector<float>& heights_m = edits[0].heights_m;
  ASSERT_EQ(heights_m.size(), 6U);
  EXPECT_EQ(heights_m[0], 1.0F);
  EXPECT_EQ(heights_m[1], -2.5F);
  EXPECT_EQ(heights_m[2], 300.0F);
  EXPECT_TRUE(std::isnan(heights_m[3]));
  EXPECT_EQ(heights_m[4], 9000.0F);
  EXPECT_EQ(heights_m[5], -12000.0F);
}

TEST(EditList, fill_gives_every_post_one_height) {
  const Edits edits = edits_of("0 0 0 3 3 2 2 fill 12.5\r\n0 0 0 3600 3600 1 2 fill void");
  ASSERT_EQ(edits.size(), 2U);
  EXPECT_EQ(edits[0].heights_m, std::vector<float>(4, 12.5F));
  ASSERT_EQ(edits[1].heights_m.size(), 2U);
  EXPECT_TRUE(std::isnan(edits[1].heights_m[0]) && std::isnan(edits[1].heights_m[1]));
}

TEST(EditList, edits_are_in_order_of_time_then_line) {
  const Edits edits = edits_of(
      "20 0 0 3 3 1 1 1\n"
      "10 0 0 3 3 1 1 2\n"
      "20 0 0 3 3 1 1 3\n"
      "-5 0 0 3 3 1 1 4\n"
      "10 0 0 3 3 1 1 5\n");
  std::vector<float> order;
  for (const TerrainEdit& edit : edits) order.push_back(edit.heights_m[0]);
  EXPECT_EQ(order, (std::vector<float>{4, 2, 5, 1, 3}));
}

TEST(EditList, a_file_without_statements_has_no_edits) {
  EXPECT_TRUE(edits_of("").empty());
  EXPECT_TRUE(edits_of("\n# nothing\n\r\n").empty());
}

TEST(EditList, places_reach_the_poles_and_the_antimeridian) {
  EXPECT_EQ(edits_of("0 90 180 3 3 1 1 5")[0].grid.west_deg, -180);
  EXPECT_EQ(edits_of("0 89 179.5 3600 3600 2 2 fill 5")[0].grid.north_deg(), 90);
  EXPECT_EQ(edits_of("0 -90 -180 3600 3600 181 361 fill 0")[0].heights_m.size(), 181U * 361);
  expect_refused("0 89 0 3600 3600 3 1 fill 5", 1, "pole");
  expect_refused("0 0 0 3600 3600 1 362 fill 5", 1, "round the Earth");
}

TEST(EditList, every_wrong_field_is_named) {
  expect_refused("# one\nx 0 0 3 3 1 1 5", 2, "time 'x'");
  expect_refused("nan 0 0 3 3 1 1 5", 1, "time");
  expect_refused("inf 0 0 3 3 1 1 5", 1, "time");
  expect_refused("0 90.1 0 3 3 1 1 5", 1, "south '90.1' is not a number from -90 to 90");
  expect_refused("0 0 181 3 3 1 1 5", 1, "west");
  expect_refused("0 0 0 0 3 1 1 5", 1, "step '0' is not a number from 0.01 to 3600");
  expect_refused("0 0 0 3 -3 1 1 5", 1, "step '-3'");
  expect_refused("0 0 0 3601 3 1 1 5", 1, "step");
  expect_refused("0 0 0 1e-320 3 1 1 5", 1, "step");
  expect_refused("0 0 0 3 3 0 1 5", 1, "rows '0'");
  expect_refused("0 0 0 3 3 1.5 1 5", 1, "rows '1.5'");
  expect_refused("0 0 0 3 3 1 99999999999 5", 1, "columns");
  expect_refused("0 0 0 3 3 1 1 9000.5", 1, "height '9000.5'");
  expect_refused("0 0 0 3 3 1 1 -12001", 1, "height");
  expect_refused("0 0 0 3 3 1 1 nan", 1, "height 'nan'");
  expect_refused("0 0 0 3 3 1 1 12m", 1, "height '12m'");
}

TEST(EditList, the_number_of_heights_must_fit) {
  expect_refused("0 0 0 3 3 2 2 1 2 3", 1, "3 heights for 4 posts");
  expect_refused("0 0 0 3 3 2 2 1 2 3 4 5", 1, "5 heights for 4 posts");
  expect_refused("0 0 0 3 3 2 2 fill", 1, "one height");
  expect_refused("0 0 0 3 3 2 2 fill 1 2", 1, "one height");
  expect_refused("0 0 0 3 3 2 2", 1, "expected SECONDS");
  expect_refused("\n\nhello\n", 3, "expected SECONDS");
}

TEST(EditList, limits_are_those_of_edits_and_posts) {
  std::string text;
  for (std::size_t k = 0; k < most_edits; ++k) text += "0 0 0 3 3 32 32 fill 1\n";
  EXPECT_EQ(edits_of(text).size(), most_edits);  // 64 x 1024 posts: both limits met
  expect_refused(text + "0 0 0 3 3 1 1 1\n", 65, "64 edits", Fault::capacity_exceeded);
  expect_refused("0 0 0 3 3 256 256 fill 1\n0 0 0 3 3 1 1 1\n", 2, "65536 posts",
                 Fault::capacity_exceeded);
  expect_refused("0 0 0 3 3 257 256 fill 1\n", 1, "65536 posts", Fault::capacity_exceeded);
  expect_refused("0 -90 0 0.1 0.1 65536 65536 fill 1\n", 1, "65536 posts",
                 Fault::capacity_exceeded);
}

TEST(EditList, a_long_line_of_single_heights_is_read) {
  std::string text = "0 0 0 3 3 256 256";
  for (int k = 0; k < 65'536; ++k) text += " " + std::to_string(k % 9000);
  const Edits edits = edits_of(text);
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0].heights_m[65'535], 65'535 % 9000);
}

TEST(EditList, damaged_files_end_in_edits_or_in_one_line) {
  const std::string good = "5 46.25 -8.5 3 1.5 2 2 1 -2.5 3e2 void # two\n9 0 0 3 3 2 2 fill 7\n";
  std::uint32_t random = 1;
  const auto next = [&](std::size_t below) {
    random = random * 1664525U + 1013904223U;
    return static_cast<std::size_t>(random >> 8U) % below;
  };
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::string text = good.substr(0, 1 + next(good.size()));
    for (int change = 0; change < 3; ++change) {
      text[next(text.size())] = static_cast<char>(next(2) == 0 ? next(256) : '0' + next(12));
    }
    const InputFile file(text);
    const auto edits = edit_list(file.path());
    if (edits.ok()) continue;
    ++refused;
    EXPECT_THAT(edits.problem().message, testing::StartsWith(file.path() + ":"));
    for (const char c : edits.problem().message) ASSERT_TRUE(c >= ' ' && c <= '~') << round;
  }
  EXPECT_GT(refused, 200);
}

TEST(EditList, files_that_cannot_be_read_are_named) {
  const test::TemporaryFolder folder;
  const auto edits = edit_list(folder.path() + "/none.txt");
  ASSERT_FALSE(edits.ok());
  EXPECT_EQ(edits.problem().fault, Fault::file_unreadable);
  EXPECT_THAT(edits.problem().message, testing::StartsWith(folder.path() + "/none.txt: "));
}

}  // namespace
}  // namespace ridgeline::sim
