#pragma once
#include <cmath>
#include <numbers>

namespace ridgeline::test {

/// The check points of error_rad (core/geo/ground_map.cpp), which the theorem of
/// docs/error_bound.md, section 2, is about.
inline constexpr int check_azimuths = 30;  ///< steps over a half circle
inline constexpr int check_radii = 14;     ///< zeros of a Chebyshev polynomial of twice the degree
inline constexpr double check_disc = 1.001;
inline constexpr double margin = 1.5;

/// Degree up to which the theorem counts the misplacement; what is above it is the tail.
inline constexpr int counted_degree = 9;
/// What the tail and the slant of a distance over its ground distance may add.
inline constexpr double tail_share = 0.012;

/// The largest value of a polynomial of that degree (over the distance) on the disc is at most this
/// many times the largest at the check points: Ehlich and Zeller, once along and once across.
inline double norming_constant() {
  const double along = (counted_degree - 1) * std::numbers::pi / (4 * check_radii);
  const double across = counted_degree * std::numbers::pi / (2 * check_azimuths);
  return 1.0 / (std::cos(along) * std::cos(across));
}

}  // namespace ridgeline::test
