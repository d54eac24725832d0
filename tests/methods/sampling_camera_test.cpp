// The camera that lays a persistent grid on the base plane.
#include "sim/methods/sampling_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ridgeline::test {
namespace {

constexpr int columns = 512, rows = 256;
constexpr double rise = 0.6;  ///< as sampling_camera.hpp says

Camera camera_at(const Attitude& attitude, double field_of_view_deg = 60) {
  const auto made = camera(attitude, {1024, 800, field_of_view_deg});
  EXPECT_TRUE(made.ok());
  return made.value();
}

/// Grid coordinates at which a ray passes the grid.
glm::dvec2 grid_place(const sim::SamplingCamera& s, const glm::dvec3& ray) {
  const glm::dvec3 way = glm::inverse(glm::dmat3(s.corner, s.across, s.down)) * ray;
  return {way.y / way.x, way.z / way.x};
}

TEST(SamplingCamera, the_picture_samples_itself_while_all_its_rays_meet_the_plane) {
  const sim::BasePlane base{0, 500, 0, 3000, 50'000};
  for (const double roll_deg : {0.0, 40.0}) {
    const Camera c = camera_at({roll_deg, -70, 30});
    const auto s = sim::sampling_camera(c, 4000, base, columns, rows);
    EXPECT_FALSE(s.empty);
    EXPECT_FALSE(s.auxiliary);
    // Its grid is parallel to the picture's pixels.
    const glm::dvec3 right = c.enu_from_camera.columns[0], down = c.enu_from_camera.columns[1];
    EXPECT_NEAR(glm::length(glm::cross(glm::normalize(s.across), right)), 0, 1e-12);
    EXPECT_NEAR(glm::length(glm::cross(glm::normalize(s.down), down)), 0, 1e-12);
  }
  EXPECT_TRUE(sim::sampling_camera(camera_at({0, -20, 30}), 4000, base, columns, rows).auxiliary);
}

TEST(SamplingCamera, the_auxiliary_camera_meets_the_plane_at_the_range_with_its_first_row) {
  const sim::BasePlane base{0, 500, 0, 3000, 50'000};
  for (const double pitch_deg : {-20.0, 0.0, 15.0}) {
    const auto s = sim::sampling_camera(camera_at({10, pitch_deg, 77}), 3000, base, columns, rows);
    ASSERT_TRUE(s.auxiliary && !s.empty);
    double nearest_m = 1e9;
    for (int i = 0; i < columns; ++i) {
      const glm::dvec3 ray = s.corner + static_cast<double>(i) * s.across;
      ASSERT_LT(ray.z, 0);
      nearest_m = std::min(nearest_m, s.depth_m * std::hypot(ray.x, ray.y) / -ray.z);
    }
    EXPECT_GE(nearest_m, 0.999 * base.range_m);
    EXPECT_LE(nearest_m, 1.02 * base.range_m);
  }
}

// Every terrain point that the picture can show, as far as the grid promises, has its base point
// inside the grid: random points over a cone of slope 0.6 and below the highest ground.
TEST(SamplingCamera, ground_in_the_picture_stands_on_the_grid) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int shown = 0;
  for (int k = 0; k < 400; ++k) {
    const sim::BasePlane base{-100, 2000 * unit(random), -100, 3500, 60'000};
    const double eye_m = base.ground_m + 10 + 4000 * unit(random) * unit(random);
    const Attitude attitude{-60 + 120 * unit(random), -70 + 80 * unit(random), 360 * unit(random)};
    const Camera c = camera_at(attitude, 40 + 50 * unit(random));
    const auto s = sim::sampling_camera(c, eye_m, base, columns, rows);
    for (int j = 0; j < 400; ++j) {
      const glm::dvec3 ray = c.ray(c.width_px * unit(random), c.height_px * unit(random)).xyz;
      const double along = std::hypot(ray.x, ray.y);
      const double g_m = base.range_m * unit(random) * unit(random);
      const double height_m = eye_m + ray.z / along * g_m;
      const double most_m = std::min(base.highest_m, base.ground_m + rise * g_m);
      if (height_m > most_m || height_m < base.lowest_m) continue;
      ++shown;
      const glm::dvec2 at = grid_place(s, {ray.x / along * g_m, ray.y / along * g_m, -s.depth_m});
      ASSERT_FALSE(s.empty);
      ASSERT_TRUE(at.x >= 0 && at.y >= 0 && at.x <= columns - 1 && at.y <= rows - 1)
          << at.x << ' ' << at.y << " pitch " << attitude.pitch_deg << " roll " << attitude.roll_deg
          << " eye over ground " << eye_m - base.ground_m << " g " << g_m;
    }
  }
  EXPECT_GT(shown, 10'000);
}

TEST(SamplingCamera, looking_over_all_ground_there_is_no_grid) {
  const sim::BasePlane base{0, 500, 0, 3000, 50'000};
  EXPECT_TRUE(sim::sampling_camera(camera_at({0, 80, 0}), 1000, base, columns, rows).empty);
}

}  // namespace
}  // namespace ridgeline::test
