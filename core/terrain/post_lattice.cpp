#include "core/terrain/post_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

constexpr double step_tolerance = 1e-7;   ///< relative difference of two steps that are the same
constexpr double phase_tolerance = 1e-4;  ///< posts; 1 cm at 3 arc seconds
constexpr int finest_division = 6;        ///< of the finer of two steps, to find their common one
constexpr int most_divisions = 180;       ///< 30" and a third of a second, twice
constexpr double srtm3_deg = 1.0 / 1200.0;

AxisFit fit_axis(double start, double step, double tile_start, double tile_step) {
  const double ratio = tile_step / step;
  const double whole = std::round(ratio);
  if (whole < 1 || std::abs(ratio - whole) > step_tolerance * ratio) return {};
  const double first = (tile_start - start) / step;
  if (std::abs(first - std::round(first)) > phase_tolerance) return {};
  return {static_cast<std::int32_t>(std::round(first)), static_cast<int>(whole)};
}

/// How far a tile is from a place, in degrees; 0 inside.
double distance_deg(const PostGrid& tile, const GeodeticPosition& place) {
  const double middle = 0.5 * (tile.west_deg + tile.east_deg());
  const double half = 0.5 * (tile.east_deg() - tile.west_deg);
  const double east =
      std::max(0.0, std::abs(std::remainder(place.longitude_deg - middle, 360.0)) - half);
  const double north =
      std::max({0.0, tile.south_deg - place.latitude_deg, place.latitude_deg - tile.north_deg()});
  return std::hypot(east, north);
}

/// Divides a step further until `other` is a multiple; unchanged where that takes a step much finer
/// than both.
double common_step(double step, double other) {
  const double finest = std::min(step, other) / finest_division;
  for (int division = 1; division <= most_divisions; ++division) {
    const double candidate = step / division;
    if (candidate < finest * (1 - step_tolerance)) break;
    const double ratio = other / candidate;
    if (std::round(ratio) >= 1 && std::abs(ratio - std::round(ratio)) <= step_tolerance * ratio) {
      return candidate;
    }
  }
  return step;
}

const PostGrid* leading_tile(std::span<const PostGrid> tiles, const GeodeticPosition& near) {
  constexpr double close_deg = 1.0;
  const PostGrid* lead = nullptr;
  double lead_distance = 0;
  for (const PostGrid& tile : tiles) {
    const double distance = std::max(distance_deg(tile, near), close_deg);
    const bool nearer = lead != nullptr && distance < lead_distance;
    const bool finer = lead != nullptr && distance == lead_distance &&
                       tile.latitude_step_deg < lead->latitude_step_deg * (1 - step_tolerance);
    if (lead == nullptr || nearer || finer) {
      lead = &tile;
      lead_distance = distance;
    }
  }
  return lead;
}

}  // namespace

double PostLattice::column_near(double longitude_deg, double near_column) const {
  const double column = column_of(longitude_deg);
  const double circle = circle_columns();
  return column + circle * std::round((near_column - column) / circle);
}

GroundPlace PostLattice::place_of(double column, double row) const {
  if (!polar()) return {latitude_deg(row), longitude_deg(column)};
  return polar_place(chart, {column * longitude_step_deg, row * latitude_step_deg});
}

LatticePoint PostLattice::point_of(const GroundPlace& place, double near_column) const {
  if (!polar()) return {column_near(place.longitude_deg, near_column), row_of(place.latitude_deg)};
  const ChartPoint point = polar_point(chart, place);
  return {point.east_deg / longitude_step_deg, point.north_deg / latitude_step_deg};
}

PostLattice lattice_in(Chart chart, const PostLattice& geographic) {
  if (chart == Chart::geographic) return geographic;
  const double step = 0.5 * geographic.latitude_step_deg;
  return {0.0, 0.0, step, step, chart};
}

AxisFit fit_rows(const PostLattice& lattice, const PostGrid& tile) {
  return fit_axis(lattice.origin_latitude_deg, lattice.latitude_step_deg, tile.south_deg,
                  tile.latitude_step_deg);
}

AxisFit fit_columns(const PostLattice& lattice, const PostGrid& tile, double near_column) {
  const double middle_deg = 0.5 * (tile.west_deg + tile.east_deg());
  const double shift =
      lattice.longitude_deg(lattice.column_near(middle_deg, near_column)) - middle_deg;
  return fit_axis(lattice.origin_longitude_deg, lattice.longitude_step_deg,
                  tile.west_deg + 360.0 * std::round(shift / 360.0), tile.longitude_step_deg);
}

PostLattice lattice_of(std::span<const PostGrid> tiles, const GeodeticPosition& near) {
  const PostGrid* lead = leading_tile(tiles, near);
  if (lead == nullptr) return {0.0, 0.0, srtm3_deg, srtm3_deg};
  PostLattice lattice{lead->south_deg, lead->west_deg, lead->latitude_step_deg,
                      lead->longitude_step_deg};
  for (const PostGrid& tile : tiles) {
    PostLattice finer = lattice;
    finer.latitude_step_deg = common_step(lattice.latitude_step_deg, tile.latitude_step_deg);
    finer.longitude_step_deg = common_step(lattice.longitude_step_deg, tile.longitude_step_deg);
    const bool fits = fit_rows(finer, tile).ratio > 0 && fit_columns(finer, tile, 0.0).ratio > 0;
    if (fits) lattice = finer;
  }
  return lattice;
}

}  // namespace ridgeline
