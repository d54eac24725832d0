// Posts of rectangles, where one post has one height: seams of one step, coarse tiles, edits.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

int pick(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

/// Every cell of a box has the class of the truth, and every corner its height from inside.
void expect_truth(const Ground& ground, const Region& region, double slack_m) {
  const PostBox& box = region.box;
  int known = 0;
  for (int r = box.row; r + 1 < box.row + box.rows; ++r) {
    for (int c = box.column; c + 1 < box.column + box.columns; ++c) {
      bool all = true;
      for (int k = 0; k < 4; ++k) all = all && !std::isnan(region.at(c + k % 2, r + k / 2));
      ASSERT_EQ(all, ground.cell_known(c, r)) << c << ' ' << r;
      if (!all) continue;
      ++known;
      for (int k = 0; k < 4; ++k) {
        constexpr double in = 1e-7;
        const double x = c + (k % 2 == 0 ? in : 1 - in), y = r + (k / 2 == 0 ? in : 1 - in);
        const auto height = static_cast<double>(region.at(c + k % 2, r + k / 2));
        ASSERT_NEAR(height, ground.height_m(x, y), slack_m + 1e-3) << c << ' ' << r << ' ' << k;
      }
    }
  }
  EXPECT_GT(known, 0);
}

TEST(Region, a_seam_takes_the_taller_post_in_any_order_of_files) {
  const Ground::Height ragged = [](int column, int row) {
    return column == 1200 ? (row % 2 == 0 ? 674.0F : 326.0F) : 500.0F;
  };
  for (const bool swapped : {false, true}) {
    Ground ground(lattice_3s());
    ground.add(
        {swapped ? 1200 : 0, 0, 1, 1, 1201, 1201},
        swapped ? ragged : [](int, int) { return 500.0F; });
    ground.add({swapped ? 0 : 1200, 0, 1, 1, 1201, 1201},
               swapped ? [](int, int) { return 500.0F; } : ragged);
    ground.finish();
    const Region region = region_of(ground.source(), {1150, 550, 100, 100});
    EXPECT_EQ(region.at(1200, 600), 674);
    EXPECT_EQ(region.at(1200, 601), 500);
    EXPECT_EQ(region.facts.tiles, 2);
    EXPECT_EQ(region.facts.seam_m, 0);  // both sides get the taller one
    EXPECT_FALSE(region.facts.seam_void);
    expect_truth(ground, region, 0);
  }
}

TEST(Region, a_known_post_wins_over_a_void_one_in_any_order_of_files) {
  for (const int first : {0, 1200}) {
    Ground ground(lattice_3s());
    const Ground::Height height = [&](int column, int) { return column < 1200 ? -3.0F : 500.0F; };
    for (const int column : {first, 1200 - first}) {
      ground.add({column, 0, 1, 1, 1201, 1201}, [=](int c, int r) {
        return column == 1200 && c == 1200 ? unknown : c == 1200 ? -3.0F : height(c, r);
      });
    }
    ground.finish();
    const Region region = region_of(ground.source(), {1150, 550, 100, 100});
    EXPECT_EQ(region.at(1200, 600), -3);
    EXPECT_EQ(region.facts.seam_m, 0);
    EXPECT_FALSE(region.facts.seam_void);
    expect_truth(ground, region, 0);
  }
}

TEST(Region, four_tiles_of_one_step_meet_in_one_post_over_rough_ground) {
  Ground ground(lattice_3s());
  for (int k = 0; k < 4; ++k) {
    ground.add({1200 * (k % 2), 1200 * (k / 2), 1, 1, 1201, 1201}, rough_with_voids(40 + k));
  }
  ground.finish();
  std::mt19937 random(3);
  for (int k = 0; k < 60; ++k) {
    const PostBox box{pick(random, 1050, 1200), pick(random, 1050, 1200), pick(random, 20, 170),
                      pick(random, 20, 170)};
    const Region region = region_of(ground.source(), box);
    EXPECT_EQ(region.facts.seam_m, 0);
    EXPECT_FALSE(region.facts.seam_void);
    expect_truth(ground, region, 0);
    if (HasFatalFailure()) return;
  }
}

TEST(Region, a_coarser_tile_keeps_its_bilinear_surface) {
  for (const int ratio : {2, 3, 5, 6, 9}) {
    Ground ground(lattice_1s());
    ground.add({0, 0, ratio, ratio, 121, 121}, rough_with_voids(5));
    ground.add({2000, 0, 1, 1, 61, 61}, rough(6));  // keeps nothing of the coarse one
    ground.finish();
    std::mt19937 random(4);
    for (int k = 0; k < 20; ++k) {
      const PostBox box{pick(random, -20, 60 * ratio), pick(random, -20, 60 * ratio),
                        pick(random, 21, 90), pick(random, 21, 90)};
      const Region region = region_of(ground.source(), box);
      EXPECT_EQ(region.facts.tiles, 1);
      EXPECT_EQ(region.facts.seam_m, 0);
      expect_truth(ground, region, 0);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Region, zones_of_dted_side_by_side) {
  // Half the columns north of row 1200, as at 50 degrees of latitude; heights that agree there.
  Ground ground({49.0, 8.0, 1.0 / 1200, 1.0 / 1200});
  const Ground::Height land = rough(8);
  ground.add({0, 0, 1, 1, 1201, 1201}, land);
  ground.add({0, 1200, 2, 1, 601, 1201}, land);
  ground.finish();
  const Region region = region_of(ground.source(), {300, 1120, 160, 160});
  EXPECT_EQ(region.facts.tiles, 2);
  EXPECT_GT(region.facts.seam_m, 0);
  EXPECT_FALSE(region.facts.seam_void);
  expect_truth(ground, region, region.facts.seam_m);
  const Region south = region_of(ground.source(), {300, 1000, 160, 160});
  EXPECT_EQ(south.facts.seam_m, 0);
  expect_truth(ground, south, 0);
}

TEST(Region, runs_over_the_antimeridian_on_any_turn) {
  for (const double origin_deg : {179.0, -180.0}) {
    const PostLattice lattice{-17, origin_deg, 1.0 / 1200, 1.0 / 1200};
    Ground ground(lattice);
    const int west = origin_deg > 0 ? 0 : -1200;
    ground.add({west, 0, 1, 1, 1201, 1201}, rough_with_voids(9));
    ground.add({west + 1200, 0, 1, 1, 1201, 1201}, rough_with_voids(10));
    ground.finish();
    const Region near = region_of(ground.source(), {west + 1120, 500, 160, 160});
    EXPECT_EQ(near.facts.tiles, 2);
    expect_truth(ground, near, 0);
    for (const int turn : {-3, -1, 1, 2}) {
      const int shift = turn * 432'000;
      const Region far = region_of(ground.source(), {west + 1120 + shift, 500, 160, 160});
      for (std::size_t k = 0; k < near.posts.size(); ++k) {
        const bool same = near.posts[k] == far.posts[k] ||
                          (std::isnan(near.posts[k]) && std::isnan(far.posts[k]));
        ASSERT_TRUE(same) << turn << ' ' << k;
      }
    }
  }
}

TEST(Region, a_tile_off_the_lattice_is_left_unknown_and_counted) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 1201, 1201}, [](int, int) { return 500.0F; });
  ground.finish();
  std::vector<HeightTile> tiles(ground.source().tiles.begin(), ground.source().tiles.end());
  tiles.push_back(tiles[0]);
  tiles[1].grid.west_deg = 9;
  tiles[1].grid.south_deg += 0.4 / 1200;
  TerrainSource source = ground.source();
  source.tiles = tiles;
  const Region region = region_of(source, {1150, 550, 100, 100});
  EXPECT_EQ(region.facts.tiles, 1);
  EXPECT_EQ(region.facts.mismatched_tiles, 1);
  EXPECT_EQ(region.at(1200, 600), 500);
  EXPECT_TRUE(std::isnan(region.at(1201, 600)));
}

TEST(Region, holds_nothing_beyond_the_poles_and_outside_all_tiles) {
  Ground ground({89.0, 8.0, 1.0 / 1200, 1.0 / 1200});
  ground.add({0, 0, 1, 1, 1201, 1201}, [](int, int) { return 500.0F; });
  ground.finish();
  const Region region = region_of(ground.source(), {500, 1150, 100, 100});
  EXPECT_EQ(region.at(550, 1200), 500);
  EXPECT_TRUE(std::isnan(region.at(550, 1201)));
  const Region nowhere = region_of(ground.source(), {-5000, 200, 100, 100});
  EXPECT_EQ(nowhere.facts.tiles, 0);
  for (const float h : nowhere.posts) EXPECT_TRUE(std::isnan(h));
}

TEST(Edit, replaces_posts_raises_lowers_and_voids_them) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 1201, 1201}, rough(12));
  ground.edit({600, 600, 1, 1, 9, 5}, [](int, int) { return 4000.0F; });
  ground.edit({604, 602, 1, 1, 20, 20},
              [](int column, int row) { return (column + row) % 3 == 0 ? unknown : -50.0F; });
  ground.finish();
  const PostBox box{560, 570, 100, 90};
  const Region before = region_of(ground.source(0), box), one = region_of(ground.source(1), box);
  const Region both = region_of(ground.source(), box);
  EXPECT_EQ(before.at(603, 603), rough(12)(603, 603));
  EXPECT_EQ(one.at(608, 604), 4000);
  EXPECT_EQ(one.at(609, 604), rough(12)(609, 604));
  EXPECT_EQ(both.at(605, 602), -50);  // the later edit wins
  EXPECT_EQ(both.at(603, 604), 4000);
  expect_truth(ground, both, 0);
}

TEST(Edit, on_a_shared_edge_replaces_the_posts_of_both_tiles) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 1201, 1201}, rough(13));
  ground.add({1200, 0, 1, 1, 1201, 1201}, rough(14));
  ground.edit({1195, 600, 1, 1, 11, 3}, [](int, int) { return 7.0F; });
  ground.edit({1195, 620, 1, 1, 11, 3}, [](int, int) { return unknown; });
  ground.finish();
  const Region region = region_of(ground.source(), {1150, 550, 100, 100});
  for (int column = 1195; column <= 1205; ++column) {
    EXPECT_EQ(region.at(column, 601), 7) << column;
    EXPECT_TRUE(std::isnan(region.at(column, 621))) << column;
  }
  EXPECT_EQ(region.facts.seam_m, 0);
  expect_truth(ground, region, 0);
}

TEST(Edit, of_a_coarse_tile_in_a_fine_lattice_moves_its_surface) {
  Ground ground(lattice_1s());
  ground.add({0, 0, 3, 3, 201, 201}, rough(15));
  ground.edit({300, 300, 3, 3, 4, 2}, [](int, int) { return 3000.0F; });
  ground.edit({360, 300, 3, 3, 1, 1}, [](int, int) { return unknown; });
  ground.finish();
  for (int offset = 0; offset < 3; ++offset) {
    const Region region = region_of(ground.source(), {270 + offset, 281 + offset, 120, 60});
    EXPECT_EQ(region.at(304, 302), 3000);
    expect_truth(ground, region, 0);
  }
}

TEST(Edit, of_every_third_post_of_a_fine_tile_leaves_those_between_alone) {
  Ground ground(lattice_1s());
  ground.add({0, 0, 1, 1, 601, 601}, rough(16));
  ground.add({600, 0, 3, 3, 201, 201}, rough(17));
  ground.edit({591, 300, 3, 3, 7, 2}, [](int, int) { return 3000.0F; });
  ground.finish();
  const Region region = region_of(ground.source(), {560, 280, 90, 60});
  EXPECT_EQ(region.at(594, 303), 3000);
  EXPECT_EQ(region.at(595, 303), rough(16)(595, 303));
  expect_truth(ground, region, region.facts.seam_m);
}

TEST(Edit, runs_over_the_antimeridian_from_either_spelling_of_its_west) {
  const PostLattice lattice{-17, 179, 1.0 / 1200, 1.0 / 1200};
  Ground ground(lattice);
  ground.add({0, 0, 1, 1, 1201, 1201}, rough(18));
  ground.add({1200, 0, 1, 1, 1201, 1201}, rough(19));
  ground.edit({1190, 600, 1, 1, 21, 3}, [](int, int) { return 5000.0F; });
  ground.finish();
  TerrainSource source = ground.source();
  std::vector<TerrainEdit> edits(source.edits.begin(), source.edits.end());
  source.edits = edits;
  for (const double west_deg : {179 + 1190 / 1200.0, 179 + 1190 / 1200.0 - 360}) {
    edits[0].grid.west_deg = west_deg;
    const Region region = region_of(source, {1150, 560, 100, 80});
    for (int column = 1190; column <= 1210; ++column) EXPECT_EQ(region.at(column, 601), 5000);
    EXPECT_EQ(region.at(1189, 601), rough(18)(1189, 601));
    EXPECT_EQ(region.at(1211, 601), rough(19)(1211, 601));
    expect_truth(ground, region, 0);
  }
}

TEST(Edit, finds_posts_by_coordinates_typed_with_eight_digits) {
  Ground ground(lattice_1s());
  ground.add({0, 0, 1, 1, 3601, 61}, rough(20));
  ground.edit({0, 7, 1, 1, 3601, 1}, [](int column, int) { return static_cast<float>(column); });
  ground.finish();
  TerrainSource source = ground.source();
  std::vector<TerrainEdit> edits(source.edits.begin(), source.edits.end());
  edits[0].grid.south_deg = 46.00194444;
  edits[0].grid.longitude_step_deg = 1.0 / 3600;
  source.edits = edits;
  const Region region = region_of(source, {0, 0, 3601, 20});
  for (int column = 0; column <= 3600; ++column) {
    ASSERT_EQ(region.at(column, 7), static_cast<float>(column));
    ASSERT_EQ(region.at(column, 6), rough(20)(column, 6));
  }
}

}  // namespace
}  // namespace ridgeline::test
