// Seams between tiles of different steps, where the truth has two sides and a region only one: what
// the region says about itself must cover both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

struct Difference {
  double largest_m = 0;  ///< truth against region, both known
  int other_class = 0;   ///< cells known here and unknown there
  int known = 0;         ///< cells known on both sides
};

/// Compares all cells of a box inside the region with the truth, their corners seen from inside.
Difference difference(const Ground& ground, const Region& region, const PostBox& box) {
  Difference d;
  for (int r = box.row; r + 1 < box.row + box.rows; ++r) {
    for (int c = box.column; c + 1 < box.column + box.columns; ++c) {
      bool all = true;
      for (int k = 0; k < 4; ++k) all = all && !std::isnan(region.at(c + k % 2, r + k / 2));
      if (all != ground.cell_known(c, r)) ++d.other_class;
      if (!all || !ground.cell_known(c, r)) continue;
      ++d.known;
      for (int k = 0; k < 4; ++k) {
        constexpr double in = 1e-7;
        const double x = c + (k % 2 == 0 ? in : 1 - in), y = r + (k / 2 == 0 ? in : 1 - in);
        const auto height = static_cast<double>(region.at(c + k % 2, r + k / 2));
        d.largest_m = std::max(d.largest_m, std::abs(height - ground.height_m(x, y)));
      }
    }
  }
  return d;
}

void expect_covered(const Ground& ground, const PostBox& box) {
  const Region region = region_of(ground.source(), box);
  const Difference d = difference(ground, region, box);
  EXPECT_LE(d.largest_m, region.facts.seam_m + 1e-3) << box.column << ' ' << box.row;
  if (d.other_class > 0) {
    EXPECT_TRUE(region.facts.seam_void) << d.other_class << " cells at " << box.column << ' '
                                        << box.row << ", " << box.columns << " x " << box.rows;
  }
}

/// A fine tile beside a coarse one, on one of its four sides.
Ground beside(int side, int column_ratio, int row_ratio, const Ground::Height& fine,
              const Ground::Height& coarse) {
  Ground ground(lattice_1s());
  ground.add({0, 0, 1, 1, 361, 361}, fine);
  const int width = 360 / column_ratio + 1, height = 360 / row_ratio + 1;
  const int columns[] = {360, 0, -360, 0}, rows[] = {0, 360, 0, -360};
  ground.add({columns[side], rows[side], column_ratio, row_ratio, width, height}, coarse);
  ground.finish();
  return ground;
}

/// A box in the middle of the seam on a side.
PostBox across(int side, int reach) {
  const int columns[] = {360, 180, 0, 180}, rows[] = {180, 360, 180, 0};
  return {columns[side] - reach, rows[side] - reach, 2 * reach + 1, 2 * reach + 1};
}

TEST(Seam, a_fine_tile_beside_a_coarse_one_that_agrees_differs_by_its_own_edge_posts_only) {
  for (int side = 0; side < 4; ++side) {
    const Ground ground = beside(side, 3, 3, rough(21), rough(21));
    const Region region = region_of(ground.source(), across(side, 60));
    const Difference d = difference(ground, region, region.box);
    EXPECT_GT(region.facts.seam_m, 0);
    EXPECT_LE(d.largest_m, region.facts.seam_m + 1e-3);
    EXPECT_EQ(d.other_class, 0);
    EXPECT_FALSE(region.facts.seam_void);
  }
}

TEST(Seam, a_plane_on_both_sides_has_no_seam) {
  const Ground::Height plane = [](int column, int row) {
    return static_cast<float>(1000 + column * 3 - row * 6);
  };
  for (int side = 0; side < 4; ++side) {
    const Ground ground = beside(side, 3, 3, plane, plane);
    const Region region = region_of(ground.source(), across(side, 60));
    EXPECT_LE(region.facts.seam_m, 1e-3);
    EXPECT_FALSE(region.facts.seam_void);
    EXPECT_LE(difference(ground, region, region.box).largest_m, 2e-3);
  }
}

TEST(Seam, covers_tiles_that_disagree_on_coincident_posts) {
  for (int side = 0; side < 4; ++side) {
    for (const int lift : {-174, 174}) {
      const Ground::Height coarse = [lift](int column, int row) {
        return rough(21)(column, row) + static_cast<float>(lift);
      };
      const Ground ground = beside(side, 3, 3, rough(21), coarse);
      for (int offset = 0; offset < 3; ++offset) {
        PostBox box = across(side, 40);
        box.column += offset;
        box.row += offset;
        expect_covered(ground, box);
      }
    }
  }
}

TEST(Seam, covers_a_fine_tile_inside_a_coarse_one) {
  Ground ground(lattice_1s());
  ground.add({-300, -300, 3, 3, 401, 401}, rough_with_voids(22));
  ground.add({0, 0, 1, 1, 301, 301}, rough_with_voids(23));
  ground.finish();
  std::mt19937 random(5);
  for (int k = 0; k < 80; ++k) {
    const int column = static_cast<int>(random() % 340U) - 80;
    const int row = static_cast<int>(random() % 340U) - 80;
    expect_covered(ground, {column, row, 80, 80});
  }
}

TEST(Seam, a_void_of_the_fine_tile_on_the_edge_is_told) {
  for (int side = 0; side < 4; ++side) {
    const Ground ground = beside(side, 3, 3, rough_with_voids(24), rough(24));
    std::mt19937 random(6);
    for (int k = 0; k < 40; ++k) {
      PostBox box = across(side, 20 + static_cast<int>(random() % 30U));
      (side % 2 == 0 ? box.row : box.column) += static_cast<int>(random() % 240U) - 120;
      expect_covered(ground, box);
    }
  }
}

// 2026-11-23: a void post of the coarse tile that the fine one knows makes the coarse tile's cells
// known; the region left them unknown and did not say so.
TEST(Seam, a_void_of_the_coarse_tile_that_the_fine_one_knows_is_told) {
  for (int side = 0; side < 4; ++side) {
    const Ground ground = beside(side, 3, 3, rough(25), [](int column, int row) {
      const bool hole = column % 360 == 0 || row % 360 == 0;
      return hole ? unknown : rough(25)(column, row);
    });
    expect_covered(ground, across(side, 40));
  }
}

// 2026-11-23: where a box ended between the posts of a coarse tile, a taller neighbour's post just
// outside the box moved the coarse surface inside it by more than the region said.
TEST(Seam, covers_coarse_cells_whose_raised_post_lies_outside_the_box) {
  for (const int ratio : {2, 3, 6, 12}) {
    double worst_m = 0;
    for (int side = 0; side < 4; ++side) {
      const Ground ground = beside(
          side, ratio, ratio, [](int, int) { return 900.0F; }, [](int, int) { return 100.0F; });
      for (int gap = 0; gap < ratio; ++gap) {
        PostBox box = across(side, 40);
        if (side == 0) box.column = 360 + gap;
        if (side == 1) box.row = 360 + gap;
        if (side == 2) box.column = -gap - box.columns + 1;
        if (side == 3) box.row = -gap - box.rows + 1;
        const Region region = region_of(ground.source(), box);
        worst_m =
            std::max(worst_m, difference(ground, region, box).largest_m - region.facts.seam_m);
      }
    }
    EXPECT_LE(worst_m, 1e-3) << "coarser by " << ratio;
  }
}

TEST(Seam, covers_zones_of_dted_whose_heights_disagree) {
  std::mt19937 random(7);
  const int south_ratio[] = {1, 2, 3, 4}, north_ratio[] = {2, 3, 4, 6};
  for (int zone = 0; zone < 4; ++zone) {
    Ground ground({49.0, 8.0, 1.0 / 1200, 1.0 / 1200});
    const int a = south_ratio[zone], b = north_ratio[zone];
    ground.add({0, 0, a, 1, 360 / a + 1, 361}, rough(26));
    ground.add({360, 0, a, 1, 360 / a + 1, 361}, rough(27));
    ground.add({0, 360, b, 1, 360 / b + 1, 361}, rough(28));
    ground.add({360, 360, b, 1, 360 / b + 1, 361}, rough(29));
    ground.finish();
    double worst_m = 0;
    for (int k = 0; k < 60; ++k) {
      const int column = 200 + static_cast<int>(random() % 160U);
      const int row = 300 + static_cast<int>(random() % 50U);
      // Two posts of margin, as blocks read them.
      const Region region = region_of(ground.source(), {column, row, 69, 69});
      const Difference d = difference(ground, region, {column + 2, row + 2, 65, 65});
      worst_m = std::max(worst_m, d.largest_m - region.facts.seam_m);
      EXPECT_EQ(d.other_class, 0);
    }
    EXPECT_LE(worst_m, 1e-3) << a << " posts a post beside " << b;
  }
}

TEST(Seam, is_nothing_between_coarse_tiles_of_one_step_that_agree) {
  Ground ground(lattice_1s());
  ground.add({0, 0, 3, 3, 121, 121}, rough(30));
  ground.add({360, 0, 3, 3, 121, 121}, rough(30));
  ground.finish();
  const Region region = region_of(ground.source(), {300, 100, 120, 120});
  EXPECT_EQ(region.facts.seam_m, 0);
  EXPECT_LE(difference(ground, region, region.box).largest_m, 1e-3);
}

}  // namespace
}  // namespace ridgeline::test
