// error_rad is a bound: between its check points nothing is misplaced by more.
#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <glm/geometric.hpp>
#include <vector>

#include "config/limits.hpp"
#include "core/geo/ground_map.hpp"
#include "tests/unit/bound/check_points.hpp"

namespace ridgeline::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double deg = pi / 180.0;

class Random {
 public:
  explicit Random(std::uint32_t seed) : seed_(seed) {}
  double between(double low, double high) {
    seed_ = seed_ * 1664525U + 1013904223U;
    return low + (high - low) * seed_ * 0x1p-32;
  }

 private:
  std::uint32_t seed_;
};

struct Misplaced {
  glm::dvec3 by_m{};
  double distance_m = 0;
};

/// Where the map puts a ground point, less where GeographicLib puts it; ENU.
Misplaced misplaced(const LocalFrame& frame, const GroundMap& map, double alpha, double g_m,
                    double height_m) {
  const double s = std::sin(alpha), c = std::cos(alpha);
  const double e = g_m * s / map.range_m, n = g_m * c / map.range_m;
  const GroundPlace place = place_at(map.chart, frame.eye, map.offset(e, n));
  double x = 0, y = 0, z = 0;
  GeographicLib::Geocentric::WGS84().Forward(place.latitude_deg, place.longitude_deg, height_m, x,
                                             y, z);
  const glm::dvec3 exact =
      glm::transpose(frame.ecef_from_enu.columns) * (glm::dvec3(x, y, z) - frame.eye_ecef.xyz);
  const double radius =
      1.0 / (c * c / frame.meridian_radius_m + s * s / frame.prime_vertical_radius_m);
  const double rho = radius + map.swell_at_m(e, n) + height_m;
  const double across = rho * std::sin(g_m / radius);
  const glm::dvec3 model(across * s, across * c,
                         rho * std::cos(g_m / radius) - radius - frame.eye.height_m);
  return {model - exact, glm::length(exact)};
}

struct Pose {
  LocalFrame frame;
  GroundMap map;
  HeightSpan heights;
};

/// A pose of its chart's domain; every other one at the border of the domain.
Pose random_pose(Random& random, int k) {
  const double ranges_m[] = {1'000, 3'000, 20'000, 100'000, 200'000};
  const double range_m = ranges_m[k % 5];
  const bool polar = k % 3 == 2;
  const double border_deg =
      std::acos(std::min(1.0, (polar ? 5.6 : 5.2) * range_m / 6'378'137.0)) / deg;
  double latitude_deg = border_deg;
  if (k % 2 == 0) latitude_deg = polar ? random.between(border_deg, 90) : random.between(0, 75);
  if (k % 4 < 2) latitude_deg = -latitude_deg;
  const Chart chart = !polar             ? Chart::geographic
                      : latitude_deg > 0 ? Chart::north_polar
                                         : Chart::south_polar;
  Pose pose;
  pose.frame = local_frame({latitude_deg, random.between(-180, 180),
                            random.between(limits::min_eye_height_m, limits::max_eye_height_m)})
                   .value();
  if (k % 7 < 3) pose.heights = {random.between(-500, 1'000), random.between(1'000, 5'000)};
  const Result<GroundMap> map = ground_map(pose.frame, range_m, chart, pose.heights);
  EXPECT_TRUE(map.ok()) << latitude_deg << ' ' << range_m;
  if (map) pose.map = map.value();
  return pose;
}

TEST(MapError, bounds_every_point_of_the_disc_at_every_height) {
  Random random(1);
  double closest = 0;
  int points = 0;
  for (int k = 0; k < 140; ++k) {
    const Pose pose = random_pose(random, k);
    for (int i = 0; i < 1'000; ++i, ++points) {
      // Near the eye, near the end of the range and between; heights at both ends and between.
      const double share = i % 2 == 0 ? random.between(0.9, 1.0) : random.between(0.001, 1.0);
      const double h = i % 3 == 0   ? pose.heights.lowest_m
                       : i % 3 == 1 ? pose.heights.highest_m
                                    : random.between(pose.heights.lowest_m, pose.heights.highest_m);
      const Misplaced point =
          misplaced(pose.frame, pose.map, random.between(0, 2 * pi), pose.map.range_m * share, h);
      const double error_rad = glm::length(point.by_m) / point.distance_m;
      // Of the margin only what the theorem needs; the rest pays for the composed series.
      const double bound_rad =
          pose.map.error_rad / margin * norming_constant() * (1 + tail_share) + 1e-11;
      ASSERT_LE(error_rad, bound_rad)
          << pose.frame.eye.latitude_deg << ' ' << pose.map.range_m << ' ' << share << ' ' << h;
      closest = std::max(closest, error_rad / bound_rad);
    }
  }
  std::printf("[ bound ] %d points, the worst at %.3f of the bound\n", points, closest);
  EXPECT_GT(closest, 0.5);  // or the bound is slack, and this test shows little
}

/// Parts of the misplacement over the distance beyond the counted degree, summed: Chebyshev in the
/// signed distance, Fourier in the azimuth.
double tail_of(const Pose& pose, double height_m) {
  constexpr int radii = 28, azimuths = 40;
  std::vector<glm::dvec3> at(static_cast<std::size_t>(radii) * azimuths);
  for (int i = 0; i < radii; ++i) {
    const double r = check_disc * std::cos(pi * (2 * i + 1) / (2.0 * radii));
    for (int j = 0; j < azimuths; ++j) {
      const double alpha = 2 * pi * j / azimuths + (r < 0 ? pi : 0);
      const double g_m = std::abs(r) * pose.map.range_m;
      at[static_cast<std::size_t>(i * azimuths + j)] =
          misplaced(pose.frame, pose.map, alpha, g_m, height_m).by_m / (r * pose.map.range_m);
    }
  }
  double tail = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int m = 0; m < radii; ++m) {
      for (int f = 0; f <= azimuths / 2; ++f) {
        if (m < counted_degree && f <= counted_degree) continue;
        std::complex<double> sum = 0;
        for (int i = 0; i < radii; ++i) {
          const double t = std::cos(m * pi * (2 * i + 1) / (2.0 * radii));
          for (int j = 0; j < azimuths; ++j) {
            sum += at[static_cast<std::size_t>(i * azimuths + j)][axis] * t *
                   std::polar(1.0, -2 * pi * f * j / azimuths);
          }
        }
        tail += std::abs(sum) * (m == 0 ? 1.0 : 2.0) * (f == 0 ? 1.0 : 2.0) / (radii * azimuths);
      }
    }
  }
  return tail;
}

TEST(MapError, is_a_polynomial_of_degree_9_but_for_a_hundredth) {
  Random random(2);
  double largest = 0;
  for (int k = 0; k < 30; ++k) {
    const Pose pose = random_pose(random, k);
    const double worst_rad = pose.map.error_rad / margin;
    for (const double h : {pose.heights.lowest_m, pose.heights.highest_m}) {
      const double tail = tail_of(pose, h);
      // Below 5e-10 rad stand the roundings of degrees and of the Earth's radius in double.
      EXPECT_LE(tail, 0.01 * worst_rad + 5e-10)
          << pose.frame.eye.latitude_deg << ' ' << pose.map.range_m;
      if (worst_rad > 1e-8) largest = std::max(largest, tail / worst_rad);
    }
  }
  std::printf("[ bound ] tail: at most %.4f of the largest misplacement\n", largest);
}

TEST(MapError, margin_covers_the_norming_constant_the_tail_and_the_composed_series) {
  // The last term is derived in section 4 and attacked by gl.arithmetic (near the limit of the
  // chart).
  EXPECT_LE(norming_constant() * (1 + tail_share) + 0.19, margin);
}

}  // namespace
}  // namespace ridgeline::test
