// Random cases: a function of seed and number alone, inside every domain, and of every kind.
#include "sim/attack/random_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "config/limits.hpp"

namespace ridgeline::sim {
namespace {

constexpr std::uint64_t cases = 400;

TEST(RandomCase, depends_on_seed_and_number_alone) {
  const std::string of_seven = text_of(random_case(3, 7));
  static_cast<void>(random_case(3, 8));
  EXPECT_EQ(text_of(random_case(3, 7)), of_seven);
  EXPECT_NE(text_of(random_case(3, 8)), of_seven);
  EXPECT_NE(text_of(random_case(4, 7)), of_seven);
}

TEST(RandomCase, is_small_enough_to_be_judged_in_a_moment) {
  for (std::uint64_t number = 0; number < cases; ++number) {
    const AttackCase c = random_case(11, number);
    ASSERT_LE(c.poses.size(), 8U);
    EXPECT_LE(c.image.width_px * c.image.height_px, 300 * 240);
    for (const TilePlan& tile : c.tiles) {
      const PostGrid grid = grid_of(tile);
      EXPECT_LE(static_cast<double>(grid.rows) * grid.columns, 1'500'000) << text_of(c);
    }
  }
}

/// Whether latitude or longitude is one of a post, up to the rounding of the text.
bool on_post(double degrees, double first_deg, double step_deg) {
  const double post = (degrees - first_deg) / step_deg;
  return std::abs(post - std::round(post)) < 1e-6;
}

TEST(RandomCase, holds_the_hard_ones) {
  std::set<LayerKind> kinds;
  std::set<TileFormat> formats;
  std::set<double> windows;
  int on_a_post = 0, poses = 0, low = 0, down = 0, rolled = 0, on_axis = 0, polar = 0, late = 0;
  int edited = 0, stated = 0, with_geoid = 0, two_steps = 0, antimeridian = 0, oblong = 0;
  for (std::uint64_t number = 0; number < cases; ++number) {
    const AttackCase c = random_case(12, number);
    for (const Layer& layer : c.land) kinds.insert(layer.kind);
    std::set<int> steps;
    for (const TilePlan& tile : c.tiles) {
      formats.insert(tile.format);
      steps.insert(static_cast<int>(std::lround(1 / grid_of(tile).latitude_step_deg)));
    }
    windows.insert(c.window_mib);
    const CaseLand land(c);
    for (const AttackPose& p : c.poses) {
      ++poses;
      const PostGrid& grid = land.grids().front();
      on_a_post += on_post(p.latitude_deg, grid.south_deg, grid.latitude_step_deg) &&
                           on_post(p.longitude_deg, grid.west_deg, grid.longitude_step_deg)
                       ? 1
                       : 0;
      low += p.height_m - land.ground_m(p.latitude_deg, p.longitude_deg) < 3 ? 1 : 0;
      down += std::abs(p.pitch_deg) > 89 ? 1 : 0;
      rolled += p.roll_deg != 0 ? 1 : 0;
      on_axis += std::fmod(p.heading_deg, 45) == 0 ? 1 : 0;
    }
    polar += std::abs(c.at_latitude_deg) > 89 && steps.count(120) > 0 ? 1 : 0;
    late += c.arrival != SceneOptions::Arrival::settled ? 1 : 0;
    edited += c.edits.empty() ? 0 : 1;
    stated += c.sea.empty() ? 0 : 1;
    with_geoid += c.geoid.amplitude_m != 0 ? 1 : 0;
    two_steps += steps.size() > 1 ? 1 : 0;
    antimeridian += std::abs(c.at_longitude_deg) == 180 ? 1 : 0;
    oblong += c.image.width_px > 2 * c.image.height_px || c.image.height_px > 2 * c.image.width_px;
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(layer_kinds));
  EXPECT_EQ(formats.size(), 5U);
  EXPECT_GE(windows.size(), 10U);
  for (const int many : {on_a_post, low, rolled, on_axis}) EXPECT_GT(20 * many, poses);
  for (const int some : {down, late, edited, stated, with_geoid, two_steps, antimeridian, oblong}) {
    EXPECT_GE(some, 10);
  }
  EXPECT_GE(polar, 5);
}

}  // namespace
}  // namespace ridgeline::sim
