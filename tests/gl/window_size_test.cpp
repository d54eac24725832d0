// How large the terrain window must be, and which part of the Earth it must hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "config/limits.hpp"
#include "core/frame/terrain_keeper.hpp"
#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

TEST(RangeBox, holds_every_ground_point_within_the_range) {
  for (const double latitude : {0.0, 46.5, -46.5, 70.0, -85.0, 89.0}) {
    for (const double range_m : {1'000.0, 100'000.0, 200'000.0}) {
      const GeoBox box = range_box(latitude, 8.5, range_m);
      const Vec3<Ecef> from = ecef_from_geodetic({latitude, 8.5, 0});
      for (int k = 0; k < 40'000; ++k) {
        const GeodeticPosition place{-90 + 180 * lottery(k, 1, 111),
                                     -180 + 360 * lottery(k, 2, 111), 0};
        // Half of the places near the eye, where it matters.
        GeodeticPosition near = place;
        if (k % 2 == 0) {
          near.latitude_deg =
              std::clamp(latitude + place.latitude_deg * range_m / 5e6, -90.0, 90.0);
          near.longitude_deg = 8.5 + place.longitude_deg;
        }
        if (glm::length((ecef_from_geodetic(near) - from).xyz) > range_m) continue;
        EXPECT_GE(near.latitude_deg, box.south_deg);
        EXPECT_LE(near.latitude_deg, box.north_deg);
        const double off = std::abs(std::remainder(near.longitude_deg - 8.5, 360.0));
        EXPECT_LE(off, 0.5 * (box.east_deg - box.west_deg) + 1e-9) << latitude << ' ' << range_m;
      }
    }
  }
}

TEST(WindowSizes, keep_the_budget_and_reach_the_range_at_every_step_and_latitude) {
  for (const double step_arcsec : {1.0 / 3, 1.0, 3.0, 30.0}) {
    for (const double latitude : {0.0, 46.0, -70.0}) {
      const double step = step_arcsec / 3600;
      const LevelSizes sizes = window_sizes({0, 0, step, step}, latitude, limits::default_range_m,
                                            limits::terrain_gpu_bytes);
      EXPECT_LE(static_cast<double>(sizes.posts()) * gpu_bytes_per_post, limits::terrain_gpu_bytes);
      const GeoBox box = range_box(latitude, 0, limits::default_range_m);
      const double reach = 64.0 * (1 << (sizes.levels - 1)) * step;
      EXPECT_GE(sizes.column_blocks * reach, box.east_deg - box.west_deg) << step_arcsec;
      EXPECT_GE(sizes.row_blocks * reach, box.north_deg - box.south_deg) << step_arcsec;
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
