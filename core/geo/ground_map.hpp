#pragma once
#include <array>

#include "config/limits.hpp"
#include "core/base/result.hpp"
#include "core/geo/chart.hpp"
#include "core/geo/local_frame.hpp"

namespace ridgeline {

/// Where ground points lie, as the shaders compute it: short polynomials instead of trigonometry.
///
/// A vertical plane through the eye with azimuth alpha cuts the ellipsoid in a curve whose
/// osculating circle at the foot of the eye has radius R(alpha), 1/R = cos²alpha/M + sin²alpha/N.
/// A ground point is named by (alpha, g): it lies on the radial line at angle g/R(alpha) from the
/// centre of that circle. With E = g sin alpha, N = g cos alpha its offset from the eye in the
/// chart, turned so that the eye's meridian is north (core/geo/chart.hpp), is
///   north = sum over i even  a_ij (E/range)^i (N/range)^j
///   east  = sum over i odd   b_ij (E/range)^i (N/range)^j      (i + j <= 5)
/// that is, latitude and longitude from the eye's in the geographic chart;
/// and the point at height h above it has the plane coordinates
///   x = (R + h) sin(g/R),   y = (R + h) cos(g/R) - (R + height_eye).
/// The ellipsoid itself does not follow the circle: at (alpha, g) it lies
///   swell = w_0 (N/range)^3 + w_1 (E/range)^2 (N/range)
/// outside it, and heights count from there: R above stands for R + swell.
/// What these formulas leave out (its normals leave the plane, the series end) is measured against
/// GeographicLib when the map is made: `error_rad`.
struct GroundMap {
  Chart chart = Chart::geographic;
  double range_m = 0;
  double inverse_meridian_radius = 0;        ///< 1/M
  double inverse_prime_vertical_radius = 0;  ///< 1/N
  /// deg; order (i,j): 01 02 03 04 05 20 21 22 23 40 41
  std::array<double, 11> north_deg{};
  /// deg; order (i,j): 10 11 12 13 14 30 31 32 50
  std::array<double, 9> east_deg{};
  std::array<double, 2> swell_m{};  ///< w_0, w_1; order (i,j): 03 21
  /// Largest displacement of a ground point at any height of the span, over its distance from the
  /// eye, rad: the angle by which this map can misplace anything in the picture.
  double error_rad = 0;

  /// Height of the ellipsoid over its osculating circle at (E, N), both over range_m; m.
  [[nodiscard]] double swell_at_m(double e, double n) const {
    return n * (swell_m[0] * n * n + swell_m[1] * e * e);
  }
  /// Offset from the eye of ground point (E, N), both over range_m.
  [[nodiscard]] ChartPoint offset(double e, double n) const;
};

/// Heights over the ellipsoid between which a map is to be right.
struct HeightSpan {
  double lowest_m = limits::min_terrain_height_m - limits::largest_undulation_m;
  double highest_m = limits::max_terrain_height_m + limits::largest_undulation_m;
};

/// Fits the map for one eye and display range.
/// Domain: in the geographic chart the eye stays about five display ranges away from the poles, in
/// a
///         polar chart within 11 degrees of one; elsewhere, and where `error_rad` would pass 1e-4
///         rad, the answer is Fault::no_error_bound.
/// Error:  `error_rad` is 1.5 times the largest misplacement over 434 check points at both ends of
///         `heights`; docs/error_bound.md, section 2, shows that nothing between them passes it
///         (test MapError.*).
/// Cost:   about 1000 GeographicLib conversions; no allocation.
Result<GroundMap> ground_map(const LocalFrame& frame, double range_m,
                             Chart chart = Chart::geographic, const HeightSpan& heights = {});

}  // namespace ridgeline
