#include "tests/oracle/edits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "tests/oracle/coverage.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/tracer.hpp"
#include "tests/oracle/verify.hpp"
#include "tests/unit/oracle/scenes.hpp"

/// Terrain that changes while frames are judged.
namespace ridgeline::oracle {
namespace {

class Edits : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "edits.txt";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  [[nodiscard]] std::string fault_of(const std::string& text) const {
    try {
      (void)read_edits(file(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  [[nodiscard]] TimedEdits timed(const std::string& text, Terrain& terrain) const {
    const std::filesystem::path path = file(text);
    return {path, read_edits(path), terrain};
  }

  scenes::TemporaryFolder folder_;
};

double ground_m(const Terrain& terrain, double lat, double lon) {
  const Geodetic eye{lat, lon, 9500};
  return 9500 - Tracer(terrain, eye, 12000).first_hit(level_frame(lat, lon).down).distance_m;
}

Terrain plain(double height_m) {
  return Terrain({scenes::tile(46, 8, 1200, 1200, [=](double, double) { return height_m; })},
                 Geoid());
}

TEST_F(Edits, are_read_in_order_of_time_then_line) {
  const auto edits =
      read_edits(file("# SECONDS SOUTH WEST ...\n"
                      "20 46.5 8.5 3 3 2 3 1 2 3 4 void 6.5 # a dam\n\n"
                      "10.5 46.5 8.5 1 1 100 50 fill -12\r\n"
                      "20 -90 -180 3 0.3333333333 1 1 fill void\n"));
  ASSERT_EQ(edits.size(), 3U);
  EXPECT_EQ(edits[0].time_s, 10.5);
  ASSERT_EQ(edits[0].patch.posts.size(), 5000U);
  for (std::size_t i = 0; i < 5000; ++i) ASSERT_EQ(edits[0].patch.posts[i], -12);
  EXPECT_EQ(edits[1].line, 2);
  EXPECT_EQ(edits[1].patch.rows, 2);
  EXPECT_EQ(edits[1].patch.at(0, 2), 3);
  EXPECT_TRUE(std::isnan(edits[1].patch.at(1, 1)));
  EXPECT_EQ(edits[1].patch.at(1, 2), 6.5);
  EXPECT_EQ(edits[1].patch.lat_step_deg, 1.0 / 1200);
  EXPECT_EQ(edits[2].patch.lon_step_deg, 1.0 / 10800);
  EXPECT_TRUE(std::isnan(edits[2].patch.posts[0]));
}

TEST_F(Edits, name_the_file_and_the_line_of_a_malformed_statement) {
  for (const std::string bad : {"10",
                                "10 46 8 3 3 1 1",
                                "x 46 8 3 3 1 1 5",
                                "nan 46 8 3 3 1 1 5",
                                "10 91 8 3 3 1 1 5",
                                "10 46 181 3 3 1 1 5",
                                "10 46 8 0 3 1 1 5",
                                "10 46 8 -3 3 1 1 5",
                                "10 46 8 3 inf 1 1 5",
                                "10 46 8 3 3 0 1 5",
                                "10 46 8 3 3 1.5 1 5",
                                "10 46 8 3 3 1 1 5 6",
                                "10 46 8 3 3 1 2 5",
                                "10 46 8 3 3 1 1 9001",
                                "10 46 8 3 3 1 1 -12001",
                                "10 46 8 3 3 1 1 fill",
                                "10 46 8 3 3 1 1 fill 5 6",
                                "10 46 8 3 3 1 1 5m",
                                "10 46 8 3 3 1 1 nan",
                                "10 46 8 3 3 300 300 fill 5",
                                "10 89.9999 8 3 3 2 1 fill 5",
                                "10 0 8 3 7200 1 182 fill 5",
                                "10 46 8 3 3 1e9 1e9 fill 5",
                                "\xff\xfe"}) {
    const std::string fault = fault_of("1 46 8 3 3 1 1 5\n\n" + bad + "\n");
    EXPECT_NE(fault.find("edits.txt: line 3: "), std::string::npos) << bad << " -> " << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
  EXPECT_THROW((void)read_edits(folder_.path()), InputError);
  EXPECT_THROW((void)read_edits(folder_.path() / "none"), InputError);
}

TEST_F(Edits, are_limited_in_number_and_in_posts_of_all_together) {
  std::string many;
  for (int i = 0; i < 64; ++i) many += "1 46 8 3 3 1 1 5\n";
  EXPECT_EQ(read_edits(file(many)).size(), 64U);
  EXPECT_NE(fault_of(many + "1 46 8 3 3 1 1 5\n").find("line 65: "), std::string::npos);
  const std::string large = "1 46 8 3 3 256 255 fill 5\n1 46 8 3 3 16 16 fill 5\n";
  EXPECT_EQ(read_edits(file(large)).size(), 2U);
  EXPECT_NE(fault_of(large + "1 46 8 3 3 1 1 5\n").find("line 3: "), std::string::npos);
}

TEST_F(Edits, need_a_tile_of_their_steps_there) {
  Terrain terrain = plain(100);
  for (const std::string good :
       {"1 46.5 8.5 3 3 1 1 5", "1 47 9 3 3 1 1 5", "1 45.9991666667 8.5 3 3 2 1 5 5",
        "1 46.500000001 8.5 3 3 1 1 5"}) {
    EXPECT_NO_THROW((void)timed(good, terrain)) << good;
  }
  for (const std::string bad : {"1 46.5 8.5 1 1 1 1 5", "1 46.5 8.5 3 6 1 1 5",
                                "1 46.5004 8.5 3 3 1 1 5", "1 48 8.5 3 3 2 2 fill 5"}) {
    EXPECT_THROW((void)timed(bad, terrain), InputError) << bad;
  }
}

TEST_F(Edits, happen_at_their_time_and_are_undone_when_time_goes_back) {
  Terrain terrain = plain(100);
  TimedEdits edits = timed(
      "10 46.5 8.5 3 3 1 1 3000\n"
      "20 46.5 8.5 3 3 1 1 50\n"
      "20 46.5 8.5 3 3 1 1 60\n",
      terrain);
  for (const auto& [time_s, expected_m] :
       {std::pair{9.999, 100.0}, std::pair{10.0, 3000.0}, std::pair{19.0, 3000.0},
        std::pair{20.0, 60.0}, std::pair{15.0, 3000.0}, std::pair{0.0, 100.0},
        std::pair{1e9, 60.0}}) {
    edits.advance_to(time_s);
    EXPECT_NEAR(ground_m(terrain, 46.5, 8.5), expected_m, 1e-5) << time_s;
    EXPECT_NEAR(ground_m(terrain, 46.5, 8.6), 100, 1e-5);
    EXPECT_EQ(terrain.highest_post_m(), std::max(100.0, expected_m));
    EXPECT_EQ(terrain.lowest_post_m(), std::min(100.0, expected_m == 3000 ? 100 : expected_m));
  }
}

TEST_F(Edits, replace_without_the_rule_of_the_taller_in_every_tile_that_has_the_post) {
  const auto high = [](double, double) { return 500.0; };
  Terrain terrain({scenes::tile(46, 8, 1200, 1200, high), scenes::tile(46, 9, 1200, 1200, high),
                   scenes::tile(47, 8, 3600, 3600, high)},
                  Geoid());
  // The corner that all three share, from the lattice of the 3" ones.
  TimedEdits edits = timed("0 47 9 3 3 1 1 -10\n0 46.5 9 3 3 1 1 20\n", terrain);
  edits.advance_to(0);
  EXPECT_NEAR(ground_m(terrain, 46.5, 9 - 0.5 / 1200), 260, 1e-4);
  EXPECT_NEAR(ground_m(terrain, 46.5, 9 + 0.5 / 1200), 260, 1e-4);
  EXPECT_NEAR(ground_m(terrain, 47 - 0.5 / 1200, 9 - 1e-7), 245, 0.1);
  EXPECT_NEAR(ground_m(terrain, 47 + 0.5 / 3600, 9 - 1e-7), 245, 0.5);
  EXPECT_EQ(terrain.lowest_post_m(), -10);
}

TEST_F(Edits, reach_stated_sea_and_turn_it_unknown) {
  Terrain terrain({scenes::tile(46, 8, 1200, 1200, [](double, double) { return 5.0; }),
                   sea_tile({46, 9}, {1200, 1200})},
                  Geoid());
  TimedEdits edits = timed(
      "5 46.5 9.5 3 3 1 1 void\n"
      "5 46.2 9 3 3 1 2 70 90\n",
      terrain);
  EXPECT_NEAR(ground_m(terrain, 46.5001, 9.5001), 0, 1e-6);
  edits.advance_to(5);
  const FirstHit hit =
      Tracer(terrain, {46.5001, 9.5001, 1000}, 2000).first_hit(level_frame(46.5001, 9.5001).down);
  EXPECT_TRUE(hit.is_sky());
  EXPECT_TRUE(hit.must_be_unknown);
  EXPECT_NEAR(ground_m(terrain, 46.2, 9 + 0.5 / 1200), 80, 1e-3);
  EXPECT_NEAR(ground_m(terrain, 46.2, 9 - 0.5 / 1200), 37.5, 1e-3);  // the coast's post, too
  EXPECT_EQ(terrain.highest_post_m(), 90);
  edits.advance_to(0);
  EXPECT_NEAR(ground_m(terrain, 46.5001, 9.5001), 0, 1e-6);
  EXPECT_EQ(terrain.highest_post_m(), 5);
}

TEST_F(Edits, give_the_terrain_that_was_read_with_them) {
  // Whatever the order of edits and undone edits, summaries are those of a terrain made anew.
  const scenes::Surface hills = scenes::rugged(2500, 3);
  const auto with_void = [&](double lat, double lon) {
    return std::hypot(lat - 46.15, lon - 8.15) < 0.01 ? std::nan("") : hills(lat, lon);
  };
  const Tile west = scenes::tile(46, 8, 1200, 240, with_void);
  const Tile east = scenes::tile(46, 8.2, 1200, 240, with_void);
  Terrain terrain({west, east}, Geoid());
  TimedEdits edits = timed(
      "1 46.04 8.18 3 3 20 60 fill 4000\n"
      "2 46.14 8.14 3 3 5 40 fill void\n"
      "3 46.02 8.03 3 3 1 1 -300\n"
      "4 46.15 8.15 3 3 30 30 fill 700\n",
      terrain);
  for (const double time_s : {4.0, 2.0, 0.0, 3.0, 1.0}) {
    edits.advance_to(time_s);
    std::vector<Tile> tiles;
    for (const TerrainTile& entry : terrain.tiles()) tiles.push_back(entry.tile);
    const Terrain anew(tiles, Geoid());
    EXPECT_EQ(terrain.lowest_post_m(), anew.lowest_post_m());
    EXPECT_EQ(terrain.highest_post_m(), anew.highest_post_m());
    EXPECT_GE(terrain.steepest(), anew.steepest());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      const auto& levels = terrain.tiles()[t].levels;
      const auto& expected = anew.tiles()[t].levels;
      ASSERT_EQ(levels.size(), expected.size());
      for (std::size_t level = 0; level < levels.size(); ++level) {
        expected[level].for_each_held([&](int row, int column) {
          const Block& a = levels[level].at(row, column);
          const Block& b = expected[level].at(row, column);
          EXPECT_EQ(a.lowest_m, b.lowest_m) << time_s;
          EXPECT_EQ(a.highest_m, b.highest_m) << time_s;
          EXPECT_EQ(a.has_unknown, b.has_unknown) << time_s;
          EXPECT_EQ(a.must_below_m, b.must_below_m) << time_s << ' ' << level << ' ' << row;
        });
      }
    }
  }
}

TEST_F(Edits, are_what_verify_judges_with) {
  scenes::write_hgt(folder_.path(), 46, 8, [](double, double) { return 200.0; });
  const std::string peak = "100 46.40 8.49 3 3 12 24 fill 2500\n";
  scenes::Shot shot;
  shot.eye = {46.3, 8.5, 1500};
  Terrain terrain = Terrain::load(folder_.path(), Geoid(), {});
  Frame before = scenes::drawn(terrain, shot);
  before.time_s = 99.9;
  TimedEdits edits = timed(peak, terrain);
  edits.advance_to(100);
  Frame after = scenes::drawn(terrain, shot);
  after.time_s = 100;
  after.name = "000001";
  const scenes::TemporaryFolder dump;
  scenes::write_frame(dump.path(), before);
  scenes::write_frame(dump.path(), after);
  VerifyOptions options;
  options.dump_folder = dump.path();
  options.terrain_folder = folder_.path();
  options.pixels_per_frame = 400;
  options.edit_file = file(peak);
  std::ostringstream progress;
  const VerifySummary told = run_verify(options, progress);
  EXPECT_EQ(told.violations() + told.undecided, 0U);
  options.edit_file = file("99.8" + peak.substr(3));  // too early for the first frame
  EXPECT_GT(run_verify(options, progress).soundness_violations, 10U);
  options.edit_file.reset();
  EXPECT_GT(run_verify(options, progress).soundness_violations, 10U);
}

}  // namespace
}  // namespace ridgeline::oracle
