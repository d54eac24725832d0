#include "tests/oracle/ray_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
        const double end = stretch_length_m(eye);
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
