#pragma once
#include <span>

namespace ridgeline {

/// A view of geoid undulations on a grid: how far mean sea level lies above the ellipsoid.
/// Frame: WGS 84 latitude and longitude. Without posts it is the geoid `none`: 0 m everywhere.
/// Shape: rows x columns, row 0 = south, column 0 = west. Units: m; NaN = no data.
/// Owner: views `posts_m`; whoever loaded the file keeps it alive.
struct GeoidGrid {
  double south_deg = 0;
  double west_deg = 0;
  double latitude_step_deg = 0;   ///< > 0
  double longitude_step_deg = 0;  ///< > 0; a grid with columns * step = 360 wraps round the Earth
  int rows = 0;                   ///< >= 2, or 0 for `none`
  int columns = 0;                ///< >= 2, or 0 for `none`
  std::span<const float> posts_m;
};

/// The undulation N at a place, bilinear in the grid: ellipsoidal height h = H + N.
/// Units:  m.
/// Domain: any finite longitude. Latitude beyond 90 degrees, a place the grid does not cover and a
///         cell with a post without data give NaN: unknown is never 0 m.
/// Error:  against exact bilinear interpolation of the file's own numbers, 8e-6 m for |N| < 128 m
///         (the posts are kept in float).
/// Cost:   O(1); no allocation.
double undulation_m(const GeoidGrid& grid, double latitude_deg, double longitude_deg);

}  // namespace ridgeline
