#include "tests/oracle/ray_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ridgeline::oracle {
namespace {

TEST(RayPath, stretches_follow_the_exact_ray) {
  for (const double lat : {0.0, 46.0, -70.0, 83.0}) {
    const LevelFrame level = level_frame(lat, 179.9);
    const Vec3 eye = ecef_from_geodetic({lat, 179.9, 8000});
    for (int heading = 0; heading < 360; heading += 30) {
      for (const double pitch : {-80.0, -5.0, 0.0, 20.0}) {
        const Vec3 ray = camera_axes(level, 0, pitch, heading).forward;
        const double end = AxisPassage(eye, ray).stretch_length_m(0);
        const Stretch part = stretch(eye, ray, 0, end, 179.9);
        for (int step = -16; step <= 16; ++step) {
          const double s = step / 16.0;
          const Geodetic g = geodetic_from_ecef(eye + part.distance_m(s) * ray);
          const Geodetic fitted{part.lat_deg.at(s), part.lon_deg.at(s), part.height_m.at(s)};
          EXPECT_LT(length(ecef_from_geodetic(fitted) - ecef_from_geodetic(g)), 1e-6);
          EXPECT_NEAR(fitted.lon_deg, 179.9, 5);
        }
      }
    }
  }
}

TEST(RayPath, stretches_follow_the_exact_ray_past_a_pole) {
  // Rays 20 km long over a pole, passing its axis at these distances.
  for (const double side : {1.0, -1.0}) {
    for (const double beside_m : {0.0, 1e-5, 1e-3, 0.3, 70.0, 9000.0}) {
      const Vec3 eye{-10000, beside_m, side * (semi_minor_m + 3000)};
      const Vec3 ray = normalised({1, 0, -side * 0.05});
      const AxisPassage axis(eye, ray);
      double lon_deg = geodetic_from_ecef(eye).lon_deg;
      double skipped_m = axis.past_axis_m(0);
      int stretches = 0;
      for (double from_m = skipped_m; from_m < 20000; ++stretches) {
        ASSERT_LT(stretches, 4000) << beside_m;
        const double to_m = from_m + axis.stretch_length_m(from_m);
        const Stretch part = stretch(eye, ray, from_m, to_m, lon_deg);
        for (const double s : {-1.0, -0.7, -0.3, 0.1, 0.5, 0.9, 1.0}) {
          const Geodetic g = geodetic_from_ecef(eye + part.distance_m(s) * ray);
          const double turn = std::remainder(part.lon_deg.at(s) - g.lon_deg, 360.0);
          ASSERT_NEAR(part.lat_deg.at(s), g.lat_deg, 1e-11);
          ASSERT_NEAR(turn, 0, 1e-6) << beside_m << ' ' << from_m;
          ASSERT_NEAR(part.height_m.at(s), g.height_m, 1e-6);
        }
        ASSERT_NEAR(part.lon_deg.at(-1), lon_deg, beside_m < 1e-3 && from_m > 9999 ? 181 : 1e-3);
        lon_deg = part.lon_deg.at(1);
        from_m = axis.past_axis_m(to_m);
        skipped_m += from_m - to_m;
      }
      EXPECT_LT(skipped_m, 3e-3);
      EXPECT_GT(stretches, 1);
    }
  }
}

TEST(RayPath, crossings_are_found_on_both_sides_of_a_turning_point) {
  const Quartic parabola{{-0.25, 0, 1, 0, 0}};
  std::vector<double> crossings;
  append_crossings(parabola, 0, -1, 1, crossings);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_NEAR(crossings[0], -0.5, 1e-14);
  EXPECT_NEAR(crossings[1], 0.5, 1e-14);
  crossings.clear();
  append_crossings(parabola, -0.3, -1, 1, crossings);
  EXPECT_TRUE(crossings.empty());
  const Quartic line{{3, 2, 1e-3, 0, 0}};
  append_crossings(line, 4, -1, 1, crossings);
  ASSERT_EQ(crossings.size(), 1U);
  EXPECT_NEAR(line.at(crossings[0]), 4, 1e-14);
}

}  // namespace
}  // namespace ridgeline::oracle
