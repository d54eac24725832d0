// What is said about terrain besides its tiles: stated sea and timed edits, drawn and judged alike.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/cli/program.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

using Words = std::vector<std::string>;

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Hills that end in a steep coast: 60 m and more, whatever the steps of the tile.
std::optional<int> hill_m(int row, int column) {
  return 60 + (row * 7 + column * 13) % 40;
}

/// A coast whose western neighbour has no file; the eye is 1.6 km east of it and looks at it.
class Coast : public ::testing::Test {
 protected:
  void SetUp() override {
    write_hgt(folder_.file("tiles/S46W073.hgt"), 1201, hill_m);
    write_text(list(), "# the ocean\nsea S46W074\nsea S46W073  # has a file\n");
  }

  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] std::string list() const { return folder_.file("coverage.txt"); }

  [[nodiscard]] Ended pose(const std::string& dump, const Words& more = {}) const {
    return ridgeline(
        joined({"pose", latitude_, "-72.98", "700", "0", "-10", "270", "--terrain", file("tiles"),
                "--size", "64x48", "--range", "6000", "--error", "0.4", "--dump", file(dump)},
               more));
  }
  [[nodiscard]] Ended verify(const std::string& dump, const Words& more = {}) const {
    return ridgeline(
        joined({"verify", file(dump), "--terrain", file("tiles"), "--pixels", "1500"}, more));
  }

  /// The range shown 17 degrees down, beyond the coast. Units: m, NaN where unknown.
  [[nodiscard]] double range_beyond_m(const std::string& dump) const {
    const auto bytes = read_bytes(file(dump) + "/000000_range.npy");
    std::vector<float> values(64 * 48);
    const std::size_t size = values.size() * sizeof(float);
    std::memcpy(values.data(), bytes.data() + bytes.size() - size, size);
    return static_cast<double>(values[30 * 64 + 32]);
  }

  /// Expects a dump to be sea beyond the coast and to hold with the list, and only with it.
  void expect_sea(const std::string& dump) const {
    const Ended drawn = pose(dump, {"--coverage", list()});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    ASSERT_NE(drawn.out.find("svs: bound 0.400 px"), std::string::npos) << drawn.out << drawn.err;
    EXPECT_NEAR(range_beyond_m(dump), 2437, 5);  // 700 m below
    const Ended told = verify(dump, {"--coverage", list()});
    EXPECT_EQ(told.status, 0) << told.out << told.err;
    EXPECT_NE(told.out.find("violations 0 "), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("stated to be sea 1 (and 1 that"), std::string::npos) << told.out;
    EXPECT_EQ(verify(dump).status, 1);
  }

  std::string latitude_ = "-45.5";

 private:
  TemporaryFolder folder_;
};

TEST_F(Coast, is_followed_by_unknown_ground_unless_the_list_says_sea) {
  ASSERT_EQ(pose("without").status, 0);
  EXPECT_TRUE(std::isnan(range_beyond_m("without"))) << range_beyond_m("without");
  const Ended held = verify("without");
  EXPECT_EQ(held.status, 0) << held.out << held.err;
  EXPECT_EQ(verify("without", {"--coverage", list()}).status, 1);
  expect_sea("with");
}

TEST_F(Coast, may_have_coarser_posts_than_the_sea) {
  // 6" from west to east on land; at sea 3", from the tile elsewhere in the folder.
  write_dted(file("tiles/s56_w073.dt1"), 1, -56, -73, hill_m);
  write_text(list(), "sea S56W074\nsea S56W073\n");
  latitude_ = "-55.5";
  expect_sea("with");
}

TEST_F(Coast, may_lie_below_the_sea) {
  write_hgt(file("tiles/S46W073.hgt"), 1201, [](int, int column) { return column / 40 - 20; });
  expect_sea("with");
}

TEST_F(Coast, is_not_followed_by_sea_where_a_damaged_file_lies) {
  write_text(file("tiles/S46W074.hgt"), "short");
  ASSERT_EQ(pose("damaged", {"--coverage", list()}).status, 0);
  EXPECT_TRUE(std::isnan(range_beyond_m("damaged")));
  const Ended held = verify("damaged", {"--coverage", list()});
  EXPECT_EQ(held.status, 0) << held.out << held.err;
}

TEST_F(Coast, is_edited_together_with_the_sea) {
  // A mole of 40 m across the shore line, a void and an island in the sea, after one of two
  // seconds.
  const std::string edits = file("edits.txt");
  write_text(edits,
             "1700000001 -45.505 -73.01 3 3 4 24 fill 40\n"
             "1700000001 -45.495 -73.005 3 3 4 7 fill void\n"
             "1700000001 -45.5 -73.02 3 3 8 8 fill 300\n");
  write_text(file("flight.log"), level_flight(-45.5, -72.98, 270));
  const Ended flown = ridgeline({"replay", file("flight.log"), "--terrain", file("tiles"),
                                 "--coverage", list(), "--edit", edits, "--size", "64x48",
                                 "--range", "6000", "--rate", "2", "--dump", file("flown")});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const Ended told = verify("flown", {"--coverage", list(), "--edit", edits});
  EXPECT_EQ(told.status, 0) << told.out << told.err;
  EXPECT_EQ(verify("flown", {"--coverage", list()}).status, 1);
}

TEST_F(Coast, is_measured_with_the_list_as_well) {
  write_text(file("flight.log"), level_flight(-45.5, -72.98, 270));
  const Ended measured = ridgeline({"bench", "--terrain", file("tiles"), "--coverage", list(),
                                    "--log", file("flight.log"), "--size", "64x48", "--range",
                                    "6000", "--repeats", "1", "--pixels", "60", "--methods",
                                    "ridgeline:error=0.4,raycast", "--json", file("bench.json")});
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto json = nlohmann::json::parse(text_of(file("bench.json")));
  ASSERT_FALSE(json["rows"].empty());
  for (const auto& row : json["rows"]) {
    EXPECT_EQ(row["wrong_class_pixels"], 0) << row;
    EXPECT_LE(row["error_px_max"], 1.0) << row;
  }
}

TEST(CoverageList, malformed_or_missing_is_bad_input_of_every_command) {
  const FlatScene scene;
  const std::string dump = scene.file("dump");
  ASSERT_EQ(ridgeline(scene.pose({"--dump", dump})).status, 0);
  const std::string list = scene.file("coverage.txt");
  const Words verify{"verify", dump, "--terrain", scene.tiles()};
  const Words bench{"bench", "--terrain", scene.tiles(), "--size", "64x48", "--range", "6000"};
  for (const std::string bad : {"sea", "sea N91E000", "sea 46N008E", "land N46E008", "\xff\x01"}) {
    write_text(list, "sea S46W074\n# fine so far\n" + bad + "\n");
    for (const Words& command : {scene.pose(), scene.replay(), verify, bench}) {
      const Ended ended = ridgeline(joined(command, {"--coverage", list}));
      expect_one_line(ended, 3, {"coverage.txt:", "3: "});
    }
  }
  for (const Words& command : {scene.pose(), scene.replay(), verify, bench}) {
    expect_one_line(ridgeline(joined(command, {"--coverage", "/nowhere/list"})), 3,
                    {"/nowhere/list: "});
    expect_one_line(ridgeline(joined(command, {"--coverage", scene.tiles()})), 3,
                    {scene.tiles() + ": "});
  }
}

TEST(EditFile, malformed_missing_or_off_the_posts_is_bad_input) {
  const FlatScene scene;
  const std::string dump = scene.file("dump");
  ASSERT_EQ(ridgeline(scene.pose({"--dump", dump})).status, 0);
  const std::string edits = scene.file("edits.txt");
  const Words verify{"verify", dump, "--terrain", scene.tiles()};
  for (const std::string bad :
       {"10", "10 -45.5 -72.5 3 3 1 1", "10 -45.5 -72.5 3 3 1 2 5", "x -45.5 -72.5 3 3 1 1 5",
        "10 -45.5 -72.5 3 3 1 1 9001", "10 -45.5 -72.5 3 3 300 300 fill 5",
        "10 -45.5 -72.5 1 1 1 1 5", "10 -40 -72.5 3 3 1 1 5", "10 -45.5001 -72.5 3 3 1 1 5"}) {
    write_text(edits, "# time and place\n0 -45.5 -72.5 3 3 1 1 5\n" + bad + "\n");
    for (const Words& command : {scene.replay(), verify}) {
      const Ended ended = ridgeline(joined(command, {"--edit", edits}));
      expect_one_line(ended, 3, {"edits.txt:", "3: "});
    }
  }
  for (const Words& command : {scene.replay(), verify}) {
    expect_one_line(ridgeline(joined(command, {"--edit", "/nowhere/edits"})), 3,
                    {"/nowhere/edits: "});
  }
}

TEST(EditFile, is_judged_with_what_was_flown) {
  const FlatScene scene;
  const std::string edits = scene.file("edits.txt");
  // A ridge of 900 m, 2 km ahead, after one of two seconds; its foot is turned unknown.
  write_text(edits,
             "1700000001 -45.52 -72.475 3 3 48 6 fill 900\n"
             "1700000001 -45.52 -72.469166666667 3 3 48 2 fill void\n");
  const std::string dump = scene.file("dump");
  const Ended flown = ridgeline(scene.replay({"--edit", edits, "--dump", dump}));
  ASSERT_EQ(flown.status, 0) << flown.err;
  const Words verify{"verify", dump, "--terrain", scene.tiles(), "--pixels", "600"};
  const Ended told = ridgeline(joined(verify, {"--edit", edits}));
  EXPECT_EQ(told.status, 0) << told.out << told.err;
  EXPECT_EQ(ridgeline(verify).status, 1);
}

}  // namespace
}  // namespace ridgeline::test
