#include "sim/import_igc/smoothing_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ridgeline {
namespace {

using Points = std::vector<std::array<double, 3>>;

std::vector<double> times(int count, double step_s) {
  std::vector<double> list;
  for (int index = 0; index < count; ++index) list.push_back(step_s * index);
  return list;
}

TEST(SmoothingSpline, straight_lines_are_kept_whatever_the_smoothing) {
  const std::vector<double> t = {0.0, 1.0, 1.5, 4.0, 5.0, 9.0};
  Points points;
  for (const double s : t) points.push_back({3.0 * s, -2.0 * s + 7.0, 5.0});
  for (const double smoothing : {0.0, 1.0, 1e6}) {
    const SmoothingSpline spline(t, points, smoothing);
    const SplinePoint p = spline.at(3.3);
    EXPECT_NEAR(p.position[0], 9.9, 1e-9);
    EXPECT_NEAR(p.velocity[1], -2.0, 1e-9);
    EXPECT_NEAR(p.acceleration[0], 0.0, 1e-9);
  }
}

TEST(SmoothingSpline, without_smoothing_it_passes_through_the_points) {
  const std::vector<double> t = {0.0, 1.0, 1.5, 4.0, 5.0, 9.0};
  const Points points = {{1, 0, 0}, {5, 1, 0}, {-2, 4, 1}, {0, 9, 2}, {3, 3, 3}, {8, 1, 0}};
  const SmoothingSpline spline(t, points, 0.0);
  for (std::size_t index = 0; index < t.size(); ++index) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(spline.at(t[index]).position[axis], points[index][axis], 1e-9);
    }
  }
}

TEST(SmoothingSpline, derivatives_are_those_of_the_position) {
  const std::vector<double> t = times(20, 0.7);
  Points points;
  for (const double s : t) points.push_back({std::sin(s), std::cos(1.3 * s), s * s});
  const SmoothingSpline spline(t, points, 0.3);
  constexpr double h = 1e-4;
  for (double s = 0.5; s < 12.0; s += 0.37) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double before = spline.at(s - h).position[axis];
      const double here = spline.at(s).position[axis];
      const double after = spline.at(s + h).position[axis];
      EXPECT_NEAR(spline.at(s).velocity[axis], (after - before) / (2 * h), 1e-6);
      EXPECT_NEAR(spline.at(s).acceleration[axis], (after - 2 * here + before) / (h * h), 1e-3);
    }
  }
}

TEST(SmoothingSpline, attenuates_a_sine_as_documented) {
  for (const double omega : {0.3142, 1.0, 2.0}) {
    const std::vector<double> t = times(400, 1.0);
    Points points;
    for (const double s : t) points.push_back({std::sin(omega * s), 0.0, 0.0});
    const SmoothingSpline spline(t, points, 1.0);
    double largest = 0.0;
    for (double s = 150.0; s < 250.0; s += 1.0) {
      largest = std::max(largest, std::abs(spline.at(s).position[0]));
    }
    // Uniform samples: 1 / (1 + w^4) for slow motion; the sampled operator differs for fast ones.
    EXPECT_NEAR(largest, 1.0 / (1.0 + std::pow(omega, 4)), omega < 0.5 ? 1e-3 : 0.12) << omega;
  }
}

TEST(SmoothingSpline, times_outside_are_moved_to_the_ends) {
  const SmoothingSpline spline(times(4, 1.0), Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                               1.0);
  EXPECT_NEAR(spline.at(-5.0).position[0], 0.0, 1e-9);
  EXPECT_NEAR(spline.at(99.0).position[0], 3.0, 1e-9);
}

}  // namespace
}  // namespace ridgeline
