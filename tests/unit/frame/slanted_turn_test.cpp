// The turn that makes up for a surface that is off, against rays over ground made for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/frame/level_error.hpp"

namespace ridgeline::test {
namespace {

constexpr double eta = 1e-4;
constexpr double step_m = 30;
constexpr TurnRads turns{2e-3, 8e-3, 0.072};

/// Heights at x = from + k step in one vertical plane; linear between. The eye is at (0, 0).
struct Profile {
  double from_m = 0;
  std::vector<double> height_m;

  /// Distance of the first point on or below the surface along a ray that looks down by `down_rad`;
  /// infinite where it leaves the profile first.
  [[nodiscard]] double hit_m(double down_rad) const {
    const double fall = -std::tan(down_rad);
    for (std::size_t k = 0; k + 1 < height_m.size(); ++k) {
      const double x = from_m + static_cast<double>(k) * step_m;
      const double gap = x * fall - height_m[k];
      if (gap <= 0) return x / std::cos(down_rad);
      const double next = (x + step_m) * fall - height_m[k + 1];
      if (next > 0) continue;
      return (x + step_m * gap / (gap - next)) / std::cos(down_rad);
    }
    return std::numeric_limits<double>::infinity();
  }
};

struct Case {
  Profile truth, drawn;
  SlantedGround ground;
};

/// Ground `away_m` away, some cliffs towards the eye among it, looked at by about `down_rad`; drawn
/// up to a residual too high or too low.
Case case_of(std::mt19937& random) {
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  Case c;
  const double away_m = 3000 + 30'000 * unit(), down_rad = 0.02 + 0.7 * unit() * unit();
  const double steepness = 0.2 + 6 * unit() * unit(), residual_m = 40 * unit() * unit() * unit();
  constexpr int posts = 60;
  const bool bumpy = unit() < 0.5;
  c.truth.from_m = c.drawn.from_m = away_m;
  double height_m = -away_m * std::tan(down_rad) - 200 * unit();
  double off_m = (2 * unit() - 1) * residual_m;
  double lowest_m = 0;
  for (int k = 0; k < posts; ++k) {
    c.truth.height_m.push_back(height_m);
    c.drawn.height_m.push_back(height_m + off_m);
    lowest_m = std::min({lowest_m, height_m, height_m + off_m});
    const double rise = unit() < 0.4 ? steepness : (2 * unit() - 1) * steepness;
    height_m += rise * step_m;
    if (bumpy || unit() < 0.05) off_m = unit() < 0.5 ? residual_m : -residual_m;
  }
  const double far_m = std::hypot(away_m + posts * step_m, lowest_m);
  c.ground = {away_m, far_m, std::atan2(-lowest_m, away_m), steepness, posts * step_m, residual_m};
  return c;
}

struct Rays {
  bool near = false, far = false;
};

/// Whether rays turned by at most `turn_rad` meet the truth near enough and far enough.
Rays rays_within(const Profile& truth, double down_rad, double turn_rad, double drawn_m) {
  Rays found;
  constexpr int rays = 400;
  for (int k = -rays; k <= rays && !(found.near && found.far); ++k) {
    const double hit_m = truth.hit_m(down_rad + turn_rad * k / rays);
    found.near = found.near || hit_m <= drawn_m * (1 + eta);
    found.far = found.far || hit_m >= drawn_m * (1 - eta);
  }
  return found;
}

TEST(SlantedTurn, makes_up_for_any_residual_it_says_it_can) {
  std::mt19937 random(404);
  int tried = 0, slanted = 0;
  while (tried < 6000) {
    const Case c = case_of(random);
    const SlantedTurn turn = slanted_turn(c.ground, turns);
    if (!turn.possible) continue;
    LevelError::Part part;
    part.angle_rad = turn.angle_rad;
    part.grip = turn.grip;
    const double turn_rad = part.turn_rad(turns, 0.0);
    ASSERT_LE(turn_rad, turns.back());
    for (int ray = 0; ray < 12; ++ray) {
      const double down_rad =
          std::atan2(-c.drawn.height_m[static_cast<std::size_t>(2 + 4 * ray)] - 1.0,
                     c.drawn.from_m + (2 + 4 * ray) * step_m) *
          (1 + 1e-3 * (static_cast<double>(random()) * 0x1p-31 - 1));
      const double drawn_m = c.drawn.hit_m(down_rad);
      const double out_m = c.drawn.from_m + 50 * step_m;
      if (!(drawn_m * std::cos(down_rad) > c.drawn.from_m + step_m) || drawn_m > out_m) continue;
      ++tried;
      const double plain_rad = c.ground.residual_m / c.ground.away_m;
      slanted += turn_rad > 1.01 * plain_rad ? 1 : 0;
      const Rays found = rays_within(c.truth, down_rad, turn_rad * 1.0001 + 1e-9, drawn_m);
      EXPECT_TRUE(found.near && found.far)
          << "residual " << c.ground.residual_m << " m at " << drawn_m << " m, down " << down_rad
          << " rad, slopes to " << c.ground.steepness << ", turn " << turn_rad << " rad";
    }
  }
  EXPECT_GT(slanted, 1000);  // the cases are such that the slant counts
}

TEST(SlantedTurn, the_plain_angle_is_not_enough) {
  // The hole this rule closes: ground off by 20 m at 10 km, seen from 30 degrees above.
  std::mt19937 random(405);
  int missed = 0;
  for (int k = 0; k < 4000; ++k) {
    const Case c = case_of(random);
    const double down_rad = std::atan2(-c.drawn.height_m[20] - 1.0, c.drawn.from_m + 20 * step_m);
    const double drawn_m = c.drawn.hit_m(down_rad);
    if (!(drawn_m * std::cos(down_rad) > c.drawn.from_m + step_m)) continue;
    if (drawn_m > c.drawn.from_m + 50 * step_m) continue;
    const double plain_rad = c.ground.residual_m / c.ground.away_m;
    const Rays found = rays_within(c.truth, down_rad, plain_rad, drawn_m);
    missed += found.near && found.far ? 0 : 1;
  }
  EXPECT_GT(missed, 20);
}

TEST(SlantedTurn, ground_at_right_angles_to_the_ray_has_none) {
  SlantedGround ground{10'000, 10'500, 0.4, 2.4, 500, 20};
  EXPECT_FALSE(slanted_turn(ground, turns).possible);
  ground.residual_m = 0;  // exact ground behind a residual: the same, for what that one hides
  EXPECT_FALSE(slanted_turn(ground, turns).possible);
  ground.down_rad = -0.1;
  EXPECT_TRUE(slanted_turn(ground, turns).possible);
  ground = {10'000, 10'500, 0.4, 0.5, 500, 20};
  EXPECT_TRUE(slanted_turn(ground, turns).possible);
}

TEST(SlantedTurn, level_looks_pay_the_plain_angle) {
  const SlantedTurn turn = slanted_turn({20'000, 20'100, 0.0, 5.0, 100, 10}, turns);
  EXPECT_TRUE(turn.possible);
  EXPECT_DOUBLE_EQ(turn.angle_rad[0], 10.0 / 20'000);
  EXPECT_DOUBLE_EQ(turn.grip[2], 1.0);
}

}  // namespace
}  // namespace ridgeline::test
