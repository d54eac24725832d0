#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/synthetic/arc_tangent.hpp"
#include "sim/synthetic/erosion.hpp"
#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::sim {
namespace {

TEST(ArcTangent, agrees_with_libm_all_round_and_at_all_sizes) {
  for (int k = 0; k < 7200; ++k) {
    const double angle_rad = (k * 0.05 - 180) * 0.017453292519943295;
    for (const double length : {1e-9, 1.0, 3e7}) {
      const double y = length * std::sin(angle_rad);
      const double x = length * std::cos(angle_rad);
      ASSERT_NEAR(arc_tangent_deg(y, x), std::atan2(y, x) * 57.29577951308232, 1e-12) << k;
    }
  }
}

TEST(ArcTangent, axes_are_exact) {
  EXPECT_EQ(arc_tangent_deg(0, 0), 0);
  EXPECT_EQ(arc_tangent_deg(0, 5), 0);
  EXPECT_EQ(arc_tangent_deg(5, 0), 90);
  EXPECT_EQ(arc_tangent_deg(-5, 0), -90);
  EXPECT_EQ(arc_tangent_deg(0, -5), 180);
}

TEST(GradientNoise, is_bounded_centred_and_smooth) {
  double sum = 0;
  double largest = 0;
  double jump = 0;
  for (int row = 0; row < 400; ++row) {
    for (int column = 0; column < 400; ++column) {
      const double x = column * 0.113 - 20;
      const double y = row * 0.097 - 20;
      const double value = gradient_noise(x, y, 5);
      sum += value;
      largest = std::max(largest, std::fabs(value));
      jump = std::max(jump, std::fabs(gradient_noise(x + 1e-6, y, 5) - value));
    }
  }
  EXPECT_LE(largest, 1.0);
  EXPECT_GE(largest, 0.5);
  EXPECT_LT(std::fabs(sum / 160'000), 0.02);
  EXPECT_LT(jump, 1e-5);
}

TEST(GradientNoise, lattice_points_are_zero_and_seeds_differ) {
  EXPECT_EQ(gradient_noise(3, -7, 1), 0);
  EXPECT_NE(gradient_noise(0.4, 0.3, 1), gradient_noise(0.4, 0.3, 2));
}

TEST(RidgedNoise, stays_between_hollow_and_crest) {
  for (int k = 0; k < 5000; ++k) {
    const double value = ridged_noise(k * 0.173, k * 0.071, 5, 9);
    ASSERT_GE(value, 0);
    ASSERT_LE(value, 1);
  }
}

/// A square island in a square sea.
Field island(int side) {
  Field uplift(side, side, -1);
  for (int row = 3; row < side - 3; ++row) {
    for (int column = 3; column < side - 3; ++column) uplift.at(row, column) = 1e-3;
  }
  return uplift;
}

TEST(Erode, leaves_no_pit_on_land_and_no_change_at_sea) {
  constexpr int side = 40;
  const Field uplift = island(side);
  Field height(side, side, -5);
  for (int row = 3; row < side - 3; ++row) {
    for (int column = 3; column < side - 3; ++column) {
      height.at(row, column) = 100 * (1 + gradient_noise(row * 0.3, column * 0.3, 1));
    }
  }
  const Field area = erode(height, uplift, {500, 1e5, 2e-6, 0.8}, 40);
  double highest = 0;
  for (int row = 1; row < side - 1; ++row) {
    for (int column = 1; column < side - 1; ++column) {
      if (uplift.at(row, column) < 0) {
        ASSERT_EQ(height.at(row, column), -5);
        continue;
      }
      bool drains = false;
      for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = column - 1; c <= column + 1; ++c) {
          const double fall_m = height.at(row, column) - std::max(0.0, height.at(r, c));
          const double steepest_m = 0.8 * 500 * std::hypot(r - row, c - column);
          drains = drains || (fall_m > 0 && fall_m <= steepest_m * (1 + 1e-9));
        }
      }
      ASSERT_TRUE(drains) << "pit, or steeper than loose rock lies: " << row << ' ' << column;
      ASSERT_GE(area.at(row, column), 500.0 * 500.0);
      highest = std::max(highest, height.at(row, column));
    }
  }
  EXPECT_GT(highest, 200);
}

TEST(Erode, all_water_reaches_the_sea) {
  constexpr int side = 30;
  const Field uplift = island(side);
  Field height(side, side, 0);
  const Field area = erode(height, uplift, {100, 1e5, 2e-6, 0.8}, 3);
  double arriving_m2 = 0;
  double land_cells = 0;
  for (std::size_t cell = 0; cell < area.values.size(); ++cell) {
    if (uplift.values[cell] >= 0) {
      land_cells += 1;
    } else {
      arriving_m2 += area.values[cell] - 1e4;
    }
  }
  EXPECT_DOUBLE_EQ(arriving_m2, land_cells * 1e4);
}

TEST(CarveValleys, only_lowers_and_keeps_the_river_bed) {
  Field height(41, 41, 800);
  Field area(41, 41, 1e4);
  for (int row = 0; row < 41; ++row) {
    height.at(row, 20) = 100;
    area.at(row, 20) = 400e6;
  }
  const Field before = height;
  carve_valleys(height, area, 278);
  for (std::size_t cell = 0; cell < height.values.size(); ++cell) {
    ASSERT_LE(height.values[cell], before.values[cell]);
  }
  EXPECT_EQ(height.at(20, 20), 100);
  EXPECT_LT(height.at(20, 21), 200);
  EXPECT_EQ(height.at(20, 0), 800);
}

TEST(Doubled, keeps_old_cells_and_halves_between) {
  Field coarse(2, 2);
  coarse.values = {0, 4, 8, 20};
  const Field fine = doubled(coarse);
  ASSERT_EQ(fine.rows, 3);
  EXPECT_EQ(fine.at(0, 0), 0);
  EXPECT_EQ(fine.at(2, 2), 20);
  EXPECT_EQ(fine.at(0, 1), 2);
  EXPECT_EQ(fine.at(1, 0), 4);
  EXPECT_EQ(fine.at(1, 1), 8);
}

}  // namespace
}  // namespace ridgeline::sim
