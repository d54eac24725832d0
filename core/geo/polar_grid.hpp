#pragma once
#include <array>

#include "config/limits.hpp"
#include "core/geo/camera.hpp"

namespace ridgeline {

/// The projected grid: columns are vertical planes through the eye, rows are slopes.
///
/// Node (plane i, row j) is the ray with azimuth plane_azimuth_rad(i) whose elevation has the
/// tangent row_slope(j). Both axes are cut into equal segments; inside a segment the spacing is
/// uniform and so dense that two neighbouring nodes anywhere in the picture are at most
/// `GridSpacing` apart. This is the view-dependent distribution that the projected-grid papers
/// warp for, with a bound instead of an average.
/// Frame: azimuths clockwise from north in the ENU frame of the eye; slope = up / horizontal.
struct PolarGrid {
  /// Index = first_index + (value - segment start) * density.
  struct Segment {
    double first_index = 0;
    double density = 0;  ///< nodes per rad (planes) or per unit of slope (rows)
  };
  using Segments = std::array<Segment, limits::grid_segments>;

  bool used = false;  ///< false: nothing of the picture lies in the grid's domain |slope| <= 1
  bool full_circle = false;  ///< plane `plane_count` would be plane 0 again
  double azimuth_start_rad = 0, azimuth_span_rad = 0;
  double slope_low = 0, slope_high = 0;
  Segments planes, rows;
  int plane_count = 0, row_count = 0;
  double margin_px = 0;  ///< border round the picture that the grid covers as well

  [[nodiscard]] double plane_azimuth_rad(int plane) const;
  [[nodiscard]] double row_slope(int row) const;
  /// Fractional row of a slope; may lie outside 0..row_count-1.
  [[nodiscard]] double row_of_slope(double slope) const;
};

/// The rows a plane needs, both included; empty when first > last.
struct RowRange {
  int first = 0, last = -1;
};

/// Largest distance between neighbours, pixels of the picture.
struct GridSpacing {
  double planes_px = 1;
  double rows_px = 1;
};

/// Grid for one camera.
/// Units:  pixels of the picture.
/// Domain: spacings > 0. Whether the counts fit the node texture is the caller's to check.
/// Cost:   about 1e5 operations, no allocation.
PolarGrid polar_grid(const Camera& camera, const GridSpacing& spacing);

/// Rows of the grid that plane `azimuth_rad` needs so that every node of a grid square that holds
/// a point of the picture is covered.
RowRange visible_rows(const Camera& camera, const PolarGrid& grid, double azimuth_rad);

}  // namespace ridgeline
