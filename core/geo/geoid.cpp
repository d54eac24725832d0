#include "core/geo/geoid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ridgeline {
namespace {

// Places this close outside the edge of a grid count as on it: 0.1 mm, the rounding of a header.
constexpr double edge_deg = 1e-9;
// A grid closes round the Earth when its steps add up to 360 degrees and less than this share of a
// step more, which a header with few digits makes of them.
constexpr double closing_share = 1e-3;
constexpr double unknown_m = std::numeric_limits<double>::quiet_NaN();

double post_m(const GeoidGrid& grid, int row, int column) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  const auto at = static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  return static_cast<double>(grid.posts_m[at]);
}

}  // namespace

double undulation_m(const GeoidGrid& grid, double latitude_deg, double longitude_deg) {
  if (!(std::abs(latitude_deg) <= 90.0) || !std::isfinite(longitude_deg)) return unknown_m;
  if (grid.posts_m.empty()) return 0.0;

  const double north_offset_deg = latitude_deg - grid.south_deg;
  const double height_deg = (grid.rows - 1) * grid.latitude_step_deg;
  if (north_offset_deg < -edge_deg || north_offset_deg > height_deg + edge_deg) return unknown_m;
  const double row = std::clamp(north_offset_deg / grid.latitude_step_deg, 0.0, grid.rows - 1.0);
  const int south_row = std::min(static_cast<int>(row), grid.rows - 2);

  double east_offset_deg = std::fmod(longitude_deg - grid.west_deg, 360.0);
  if (east_offset_deg < 0) east_offset_deg += 360.0;
  if (east_offset_deg >= 360.0 - edge_deg) east_offset_deg = 0.0;
  // Only where the last post is one step west of the first: between others there is no cell.
  const double excess_deg = grid.columns * grid.longitude_step_deg - 360.0;
  const bool wraps = excess_deg > -edge_deg && excess_deg < closing_share * grid.longitude_step_deg;
  const double width_deg = (grid.columns - 1) * grid.longitude_step_deg;
  if (!wraps && east_offset_deg > width_deg + edge_deg) return unknown_m;
  const double last_cell = wraps ? grid.columns - 1.0 : grid.columns - 2.0;
  const double column = std::max(east_offset_deg / grid.longitude_step_deg, 0.0);
  const int west_column = static_cast<int>(std::min(std::floor(column), last_cell));
  const int east_column = west_column + 1 == grid.columns ? 0 : west_column + 1;

  const double north_share = row - south_row;
  const double east_share = std::min(column - west_column, 1.0);
  const double south_m = (1.0 - east_share) * post_m(grid, south_row, west_column) +
                         east_share * post_m(grid, south_row, east_column);
  const double north_m = (1.0 - east_share) * post_m(grid, south_row + 1, west_column) +
                         east_share * post_m(grid, south_row + 1, east_column);
  return (1.0 - north_share) * south_m + north_share * north_m;
}

}  // namespace ridgeline
