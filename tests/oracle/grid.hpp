#pragma once
#include <cmath>
#include <compare>

namespace ridgeline::oracle {

/// Posts apart by less than this count as one post. Units: steps, of the finer of two grids.
inline constexpr double same_post_steps = 1e-3;

/// A lattice of posts. Row 0 is the SOUTH row, column 0 the WEST column.
/// Units: degrees (WGS 84).
struct Grid {
  double south_deg = 0;
  double west_deg = 0;  ///< [-180, 180)
  double lat_step_deg = 0;
  double lon_step_deg = 0;
  int rows = 0;
  int columns = 0;

  [[nodiscard]] double north_deg() const { return south_deg + (rows - 1) * lat_step_deg; }
  [[nodiscard]] double east_deg() const { return west_deg + (columns - 1) * lon_step_deg; }
};

/// A cell of one degree, by its south-west corner: S90..N89, W180..E179. Units: degrees.
struct DegreeCell {
  int south_deg = 0;
  int west_deg = 0;

  friend auto operator<=>(const DegreeCell&, const DegreeCell&) = default;
};

/// A rectangle of latitudes and longitudes; west may lie on any turn. Units: degrees.
struct GeoBox {
  double south_deg = 0;
  double north_deg = 0;
  double west_deg = 0;
  double east_deg = 0;
};

/// The longitude of the west edge of a grid on the turn that brings the grid's middle closest to
/// `near_deg`.
[[nodiscard]] inline double west_on_turn(const Grid& grid, double near_deg) {
  const double middle = 0.5 * (grid.west_deg + grid.east_deg());
  return grid.west_deg + 360.0 * std::round((near_deg - middle) / 360.0);
}

/// The index of `value` in a row of posts, or -1 where no post stands within `slack_steps` of it.
[[nodiscard]] inline int post_index(double value, double first, double step, int count,
                                    double slack_steps = same_post_steps) {
  const double index = (value - first) / step;
  const double nearest = std::round(index);
  if (!(std::abs(index - nearest) <= slack_steps) || nearest < 0 || nearest > count - 1) return -1;
  return static_cast<int>(nearest);
}

}  // namespace ridgeline::oracle
