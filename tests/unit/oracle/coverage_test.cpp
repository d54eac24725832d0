#include "tests/oracle/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/oracle/input_error.hpp"
#include "tests/oracle/terrain.hpp"
#include "tests/oracle/tracer.hpp"
#include "tests/oracle/verify.hpp"
#include "tests/unit/oracle/scenes.hpp"

/// Cells that an installer states to be sea.
namespace ridgeline::oracle {
namespace {

class Coverage : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path list(const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "coverage.txt";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  [[nodiscard]] std::string fault_of(const std::string& text) const {
    try {
      (void)read_coverage(list(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  [[nodiscard]] Terrain loaded(const std::string& text) const {
    return Terrain::load(folder_.path(), Geoid(), {}, read_coverage(list(text)));
  }

  void write_hgt(int south_deg, int west_deg, double height_m) const {
    scenes::write_hgt(folder_.path(), south_deg, west_deg,
                      [=](double, double) { return height_m; });
  }

  scenes::TemporaryFolder folder_;
};

FirstHit straight_down(const Terrain& terrain, const Geodetic& eye) {
  return Tracer(terrain, eye, 9000).first_hit(level_frame(eye.lat_deg, eye.lon_deg).down);
}

TEST_F(Coverage, is_one_cell_a_line_in_any_case_with_comments) {
  const auto cells =
      read_coverage(list("# the islands\n\nsea N46E008\r\n  SEA s20w180 # here\n\tsea n46e008\n"
                         "sea S90W001\nsea N89E179\nsea S00W000"));
  const std::vector<DegreeCell> expected{{-90, -1}, {-20, -180}, {0, 0}, {46, 8}, {89, 179}};
  EXPECT_EQ(cells, expected);
  EXPECT_TRUE(read_coverage(list("")).empty());
  // Found by fuzzing: the display takes such a list.
  EXPECT_EQ(read_coverage(list("\xef\xbb\xbfsea N46E008")), (std::vector<DegreeCell>{{46, 8}}));
}

TEST_F(Coverage, names_the_file_and_the_line_of_a_malformed_statement) {
  for (const std::string bad :
       {"sea", "sea N46", "sea N46E8", "sea N90E000", "sea S91E000", "sea N10E180", "sea N10W181",
        "sea N46E008 N47E008", "land N46E008", "sea X46E008", "sea N4-E008", "seaN46E008",
        "sea N46E0080", "sea 0000000", "\x01\x02"}) {
    const std::string fault = fault_of("sea N00E000\n" + bad + "\nsea N00E001\n");
    EXPECT_NE(fault.find("coverage.txt: line 2: "), std::string::npos) << bad << " -> " << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
  EXPECT_THROW((void)read_coverage(folder_.path()), InputError);
  EXPECT_THROW((void)read_coverage(folder_.path() / "none"), InputError);
}

TEST_F(Coverage, makes_a_missing_tile_sea_and_leaves_others_unknown) {
  write_hgt(46, 8, 0);
  const Terrain terrain = loaded("sea N46E009");
  EXPECT_EQ(terrain.sea_cells(), 1);
  const FirstHit sea = straight_down(terrain, {46.5, 9.5, 5000});
  EXPECT_NEAR(sea.distance_m, 5000, 1e-6);
  EXPECT_FALSE(sea.may_be_unknown);
  const FirstHit missing = straight_down(terrain, {47.5, 9.5, 5000});
  EXPECT_TRUE(missing.is_sky());
  EXPECT_TRUE(missing.must_be_unknown);
}

TEST_F(Coverage, lies_on_the_geoid) {
  write_hgt(46, 8, 0);
  const Geoid geoid = Geoid::from_nodes(45, 7, 0.3, 0.3, 20, 20, std::vector<float>(400, 47.5F));
  const Terrain terrain =
      Terrain::load(folder_.path(), geoid, {}, read_coverage(list("sea N46E009")));
  EXPECT_NEAR(straight_down(terrain, {46.3, 9.2, 5047.5}).distance_m, 5000, 1e-6);
}

TEST_F(Coverage, slopes_down_from_a_coast_within_one_cell) {
  write_hgt(46, 8, 100);
  const Terrain terrain = loaded("sea N46E009\nsea N46E010\n");
  EXPECT_NEAR(straight_down(terrain, {46.5, 9 + 0.25 / 1200, 5000}).distance_m, 4925, 1e-4);
  EXPECT_NEAR(straight_down(terrain, {46.5, 9 + 1.01 / 1200, 5000}).distance_m, 5000, 1e-6);
  EXPECT_NEAR(straight_down(terrain, {46.5, 10, 5000}).distance_m, 5000, 1e-6);
  EXPECT_NEAR(straight_down(terrain, {46.5, 8.9999, 5000}).distance_m, 4900, 1e-6);
  // A coast below the sea is lifted to it, within its last cell.
  scenes::write_hgt(folder_.path(), 46, 8, [](double, double) { return -40.0; });
  const Terrain low = loaded("sea N46E009");
  EXPECT_NEAR(straight_down(low, {46.5, 9.001, 5000}).distance_m, 5000, 1e-6);
  EXPECT_NEAR(straight_down(low, {46.5, 9 - 0.5 / 1200, 5000}).distance_m, 5020, 1e-4);
  EXPECT_NEAR(straight_down(low, {46.5, 8.99, 5000}).distance_m, 5040, 1e-6);
}

TEST_F(Coverage, has_the_finest_steps_of_the_files_in_either_direction) {
  const auto per_degree = [](std::vector<Grid> grids) {
    const StepsPerDegree steps = finest_steps(grids);
    return std::pair{steps.lat, steps.lon};
  };
  const Grid zone{60, 8, 3.0 / 3600, 6.0 / 3600, 1201, 601};
  const Grid wide{46, 8, 30.0 / 3600, 4.0 / 3600, 121, 901};
  EXPECT_EQ(per_degree({zone}), (std::pair{1200, 600}));
  EXPECT_EQ(per_degree({zone, wide}), (std::pair{1200, 900}));
  EXPECT_EQ(per_degree({{46, 8, 0.0007, 0.3, 500, 3}}), (std::pair{1429, 3}));
  EXPECT_EQ(per_degree({}), (std::pair{1200, 1200}));
  EXPECT_EQ(per_degree({{-80, 8, 3.0, 3.0, 20, 20}}), (std::pair{1200, 1200}));
  EXPECT_EQ(per_degree({{46, 8, 1e-7, 1e-7, 20, 20}}), (std::pair{36000, 36000}));
  // Files far from all places count as well.
  write_hgt(46, 8, 0);
  const std::filesystem::path far = folder_.path() / "N10E100.hgt";
  std::ofstream(far) << "";
  std::filesystem::resize_file(far, std::uintmax_t{2} * 3601 * 3601);
  const Terrain terrain =
      Terrain::load(folder_.path(), Geoid(), {{46.5, 8.5, 1000}}, {{46, 9}, {46, 8}});
  ASSERT_EQ(terrain.tiles().size(), 1U);
  const Terrain wider = Terrain::load(folder_.path(), Geoid(), {{46.5, 9, 1000}}, {{46, 9}});
  ASSERT_EQ(wider.tiles().size(), 2U);
  EXPECT_EQ(wider.tiles()[0].tile.lat_step_deg, 1.0 / 3600);
  EXPECT_TRUE(wider.tiles()[0].tile.sea);
}

TEST_F(Coverage, takes_little_memory_however_fine_it_is) {
  Tile coast = scenes::tile(46, 8, 10800, 1, [](double, double) { return 5.0; });
  coast.rows = 10801;
  coast.posts.resize(coast.index(coast.rows, 0));
  for (int row = 0; row < coast.rows; ++row) coast.set(row, 1, 5);
  coast.west_deg = 9 - coast.lon_step_deg;
  const Terrain terrain({coast, sea_tile({46, 9}, {10800, 10800})}, Geoid());
  const TerrainTile& sea = terrain.tiles()[1];
  ASSERT_TRUE(sea.tile.sea);
  std::size_t bytes = sea.tile.sea->held_count() * sizeof(float);
  for (const BlockLevel& level : sea.levels) bytes += level.held_count() * sizeof(Block);
  EXPECT_LT(bytes, 400U * 1024);
  EXPECT_EQ(sea.tile.at(5000, 0), 5);
  EXPECT_EQ(sea.tile.at(5000, 1), 0);
}

/// Sea as a tile that holds each of its posts.
Tile dense(const Tile& sea) {
  Tile tile = sea;
  tile.sea.reset();
  tile.posts.resize(tile.index(tile.rows, 0));
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; ++column) {
      tile.set(row, column, sea.at(row, column));
    }
  }
  return tile;
}

void expect_same(const Terrain& a, const Terrain& b) {
  EXPECT_EQ(a.lowest_post_m(), b.lowest_post_m());
  EXPECT_EQ(a.highest_post_m(), b.highest_post_m());
  for (std::size_t t = 0; t < a.tiles().size(); ++t) {
    const std::vector<BlockLevel>& levels = a.tiles()[t].levels;
    ASSERT_EQ(levels.size(), b.tiles()[t].levels.size());
    for (std::size_t level = 0; level < levels.size(); ++level) {
      for (int row = 0; row < levels[level].rows(); ++row) {
        for (int column = 0; column < levels[level].columns(); ++column) {
          const Block& one = levels[level].at(row, column);
          const Block& other = b.tiles()[t].levels[level].at(row, column);
          ASSERT_EQ(one.lowest_m, other.lowest_m) << t << ' ' << level << ' ' << row;
          ASSERT_EQ(one.highest_m, other.highest_m) << t << ' ' << level << ' ' << row;
          ASSERT_EQ(one.has_unknown, other.has_unknown) << t << ' ' << level << ' ' << row;
          ASSERT_EQ(one.must_below_m, other.must_below_m) << t << ' ' << level << ' ' << row;
        }
      }
    }
  }
}

TEST_F(Coverage, is_summed_up_like_a_tile_that_holds_every_post) {
  const Tile coast = scenes::tile(46, 8, 333, 333, scenes::rugged(900, 5));
  const Tile west = sea_tile({46, 7}, {333, 333});
  const Tile east = sea_tile({46, 9}, {333, 200});
  Terrain sparse({coast, west, east}, Geoid());
  Terrain full({coast, dense(west), dense(east)}, Geoid());
  expect_same(sparse, full);
  EXPECT_EQ(sparse.steepest(), full.steepest());
  for (int round = 0; round < 2; ++round) {
    const float height_m = round == 0 ? 700.0F : void_post;
    Tile patch = scenes::tile(46 + 48.0 / 333, 8 - 40.0 / 333, 333, 70,
                              [&](double, double) { return static_cast<double>(height_m); });
    const ReplacedPosts replaced = sparse.replace(patch);
    const ReplacedPosts expected = full.replace(patch);
    expect_same(sparse, full);
    EXPECT_EQ(sparse.steepest(), full.steepest());
    std::vector<Tile> tiles;
    for (const TerrainTile& entry : sparse.tiles()) tiles.push_back(entry.tile);
    expect_same(Terrain(tiles, Geoid()), full);
    sparse.put_back(replaced);
    full.put_back(expected);
    expect_same(sparse, full);
  }
}

TEST_F(Coverage, never_replaces_a_file_not_even_a_damaged_one) {
  write_hgt(46, 8, 300);
  std::ofstream(folder_.path() / "N46E009.hgt") << "short";
  std::ofstream(folder_.path() / "n46_e010.dt1") << "short";
  const Terrain terrain = loaded("sea N46E008\nsea N46E009\nsea N46E010\nsea N46E011\n");
  EXPECT_EQ(terrain.refused().size(), 2U);
  EXPECT_EQ(terrain.sea_cells(), 1);
  EXPECT_EQ(terrain.ignored_sea_cells(), 3);
  EXPECT_NEAR(straight_down(terrain, {46.5, 8.5, 5000}).distance_m, 4700, 1e-6);
  EXPECT_TRUE(straight_down(terrain, {46.5, 9.5, 5000}).must_be_unknown);
  EXPECT_TRUE(straight_down(terrain, {46.5, 10.5, 5000}).must_be_unknown);
  EXPECT_FALSE(straight_down(terrain, {46.5, 11.5, 5000}).may_be_unknown);
}

TEST_F(Coverage, is_left_by_a_raster_that_reaches_a_little_into_the_cell) {
  Grid raster{46.0, 8.0, 0.01, 0.01, 101, 101};
  EXPECT_TRUE(reaches_into(raster, {46, 8}));
  EXPECT_FALSE(reaches_into(raster, {46, 9}));
  EXPECT_FALSE(reaches_into(raster, {47, 8}));
  raster.columns = 102;
  EXPECT_TRUE(reaches_into(raster, {46, 9}));
  raster = {-20.0, 179.0, 0.01, 0.01, 101, 151};
  EXPECT_TRUE(reaches_into(raster, {-20, -180}));
  EXPECT_FALSE(reaches_into(raster, {-20, -179}));
}

TEST_F(Coverage, alone_makes_an_empty_folder_usable) {
  EXPECT_THROW((void)loaded(""), InputError);
  const Terrain terrain = loaded("sea N46E008");
  EXPECT_NEAR(straight_down(terrain, {46.5, 8.5, 700}).distance_m, 700, 1e-6);
  EXPECT_TRUE(straight_down(terrain, {47.5, 8.5, 700}).must_be_unknown);
}

TEST_F(Coverage, is_what_verify_judges_with) {
  write_hgt(46, 8, 200);
  const std::filesystem::path file = list("sea N47E008\nsea N46E008\n");
  scenes::Shot shot;
  shot.eye = {46.9, 8.5, 1200};  // looking out to sea
  shot.pitch_deg = -8;
  const Frame frame =
      scenes::drawn(Terrain::load(folder_.path(), Geoid(), {}, read_coverage(file)), shot);
  const scenes::TemporaryFolder dump;
  scenes::write_frame(dump.path(), frame);
  VerifyOptions options;
  options.dump_folder = dump.path();
  options.terrain_folder = folder_.path();
  options.pixels_per_frame = 400;
  std::ostringstream progress;
  EXPECT_GT(run_verify(options, progress).soundness_violations, 60U);
  options.coverage_file = file;
  const VerifySummary told = run_verify(options, progress);
  EXPECT_EQ(told.violations() + told.undecided, 0U);
  EXPECT_EQ(told.sea_cells, 1);
  EXPECT_EQ(told.ignored_sea_cells, 1);
}

}  // namespace
}  // namespace ridgeline::oracle
