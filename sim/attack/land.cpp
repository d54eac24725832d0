#include "sim/attack/land.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "config/limits.hpp"
#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::sim {
namespace {

constexpr double unknown_m = std::numeric_limits<double>::quiet_NaN();
constexpr double metres_per_degree = 111'195;
constexpr int octaves = 6;

/// One post as the layers see it.
struct Place {
  std::int64_t row = 0, column = 0;  ///< posts of the tile's own steps from the place of the case
  double east_m = 0, north_m = 0;
  std::size_t tile = 0;
};

std::int64_t floor_divide(std::int64_t value, std::int64_t by) {
  return value / by - (value % by < 0 ? 1 : 0);
}

/// How far along a direction a post is: 0 north, 1 east, 2 north-east, 3 north-west.
std::int64_t along(double direction, const Place& p) {
  switch (static_cast<int>(direction)) {
    case 0:
      return p.row;
    case 1:
      return p.column;
    case 2:
      return p.row + p.column;
    default:
      return p.row - p.column;
  }
}

bool in_stripe(const Place& p, double spacing, double width, double direction, double first) {
  const auto period = static_cast<std::int64_t>(spacing);
  const std::int64_t from = along(direction, p) - static_cast<std::int64_t>(first);
  return from - period * floor_divide(from, period) < static_cast<std::int64_t>(width);
}

/// 0..1, of one post alone.
double lottery(const Place& p, double seed) {
  const std::uint64_t bits = lattice_hash(p.column, p.row, static_cast<std::uint64_t>(seed));
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

bool drawn(const Place& p, double one_in, double seed) {
  return lottery(p, seed) * one_in < 1.0;
}

bool in_box(const Place& p, const std::array<double, most_layer_numbers>& n) {
  const auto row = static_cast<double>(p.row), column = static_cast<double>(p.column);
  return row >= n[0] && column >= n[1] && row < n[0] + n[2] && column < n[1] + n[3];
}

double noise(const Place& p, double wave_m, double seed, bool ridged) {
  const auto bits = static_cast<std::uint64_t>(seed);
  const double x = p.east_m / wave_m, y = p.north_m / wave_m;
  return ridged ? ridged_noise(x, y, octaves, bits) : fractal_noise(x, y, octaves, bits);
}

bool is_odd_band(const Place& p, double spacing, double direction, double first) {
  const std::int64_t from = along(direction, p) - static_cast<std::int64_t>(first);
  return (floor_divide(from, static_cast<std::int64_t>(spacing)) & 1) != 0;
}

bool is_odd_field(const Place& p, double width) {
  const auto side = static_cast<std::int64_t>(width);
  return ((floor_divide(p.row, side) + floor_divide(p.column, side)) & 1) != 0;
}

/// The height after one more layer.
double layered(double h, const Layer& layer, const Place& p) {
  const auto& n = layer.numbers;
  switch (layer.kind) {
    case LayerKind::flat:
      return h + n[0];
    case LayerKind::slope:
      return h + n[0] * static_cast<double>(p.column) + n[1] * static_cast<double>(p.row);
    case LayerKind::fractal:
      return h + n[0] * noise(p, n[1], n[2], false);
    case LayerKind::ridges:
      return h + n[0] * noise(p, n[1], n[2], true);
    case LayerKind::rough:
      return h + n[0] * lottery(p, n[1]);
    case LayerKind::spires:
      return drawn(p, n[1], n[2]) ? h + n[0] : h;
    case LayerKind::walls:
      return in_stripe(p, n[1], n[2], n[3], n[4]) ? h + n[0] : h;
    case LayerKind::cliffs:
      return is_odd_band(p, n[1], n[2], n[3]) ? h + n[0] : h;
    case LayerKind::checker:
      return is_odd_field(p, n[1]) ? h + n[0] : h;
    case LayerKind::stairs:
      return n[0] * std::floor(h / n[0]);
    case LayerKind::clamp:
      return std::clamp(h, std::min(n[0], n[1]), std::max(n[0], n[1]));
    case LayerKind::seam:
      return h + n[0] * static_cast<double>(p.tile);
    case LayerKind::holes:
      return drawn(p, n[0], n[1]) ? unknown_m : h;
    case LayerKind::islands:
      return noise(p, n[1], n[2], false) > 0.5 * (1.0 - 2.0 * n[0]) ? unknown_m : h;
    case LayerKind::stripes:
      return in_stripe(p, n[0], n[1], n[2], n[3]) ? unknown_m : h;
    case LayerKind::half:
      return along(n[0], p) >= static_cast<std::int64_t>(n[1]) ? unknown_m : h;
    case LayerKind::box:
      return in_box(p, n) ? unknown_m : h;
  }
  return h;
}

float stored(double h, TileFormat format) {
  if (std::isnan(h)) return std::numeric_limits<float>::quiet_NaN();
  h = std::clamp(h, limits::min_terrain_height_m, limits::max_terrain_height_m);
  return static_cast<float>(format == TileFormat::tif32 ? h : std::floor(h + 0.5));
}

/// Metres east of one degree of longitude, roughly: a parabola instead of a cosine.
double east_scale(double latitude_deg) {
  const double of_quarter = latitude_deg / 90;
  return std::max(metres_per_degree * (1 - of_quarter * of_quarter), 1'000.0);
}

float stored_post(const AttackCase& c, std::size_t tile, const PostGrid& grid, int row,
                  int column) {
  const double north_deg = grid.south_deg + row * grid.latitude_step_deg - c.at_latitude_deg;
  const double east_deg =
      std::remainder(grid.west_deg + column * grid.longitude_step_deg - c.at_longitude_deg, 360.0);
  const Place place{std::llround(north_deg / grid.latitude_step_deg),
                    std::llround(east_deg / grid.longitude_step_deg),
                    east_deg * east_scale(c.at_latitude_deg), north_deg * metres_per_degree, tile};
  double h = 0;
  for (const Layer& layer : c.land) h = layered(h, layer, place);
  return stored(h, c.tiles[tile].format);
}

}  // namespace

std::vector<float> posts_of(const AttackCase& c, std::size_t tile) {
  const PostGrid grid = grid_of(c.tiles[tile]);
  std::vector<float> posts;
  posts.reserve(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns));
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      posts.push_back(stored_post(c, tile, grid, row, column));
    }
  }
  return posts;
}

CaseLand::CaseLand(const AttackCase& c) : case_(c) {
  for (const TilePlan& tile : c.tiles) grids_.push_back(grid_of(tile));
}

float CaseLand::post_m(std::size_t tile, int row, int column) const {
  const PostGrid& grid = grids_[tile];
  return stored_post(case_, tile, grid, std::clamp(row, 0, grid.rows - 1),
                     std::clamp(column, 0, grid.columns - 1));
}

double CaseLand::ground_m(double latitude_deg, double longitude_deg) const {
  double highest = unknown_m;
  for (std::size_t tile = 0; tile < grids_.size(); ++tile) {
    const PostGrid& grid = grids_[tile];
    const double middle = 0.5 * (grid.west_deg + grid.east_deg());
    const double longitude = middle + std::remainder(longitude_deg - middle, 360.0);
    const double y = (latitude_deg - grid.south_deg) / grid.latitude_step_deg;
    const double x = (longitude - grid.west_deg) / grid.longitude_step_deg;
    if (!(y >= 0 && x >= 0 && y <= grid.rows - 1 && x <= grid.columns - 1)) continue;
    const int row = std::min(static_cast<int>(y), grid.rows - 2);
    const int column = std::min(static_cast<int>(x), grid.columns - 2);
    const double fy = y - row, fx = x - column;
    const auto at = [&](int r, int k) { return static_cast<double>(post_m(tile, r, k)); };
    const double h = (1 - fy) * ((1 - fx) * at(row, column) + fx * at(row, column + 1)) +
                     fy * ((1 - fx) * at(row + 1, column) + fx * at(row + 1, column + 1));
    highest = std::fmax(highest, h);
  }
  return highest;
}

double CaseLand::highest_near_m(std::size_t tile, double row, double column, int posts) const {
  double highest = unknown_m;
  const int r = static_cast<int>(std::floor(row)), c = static_cast<int>(std::floor(column));
  for (int i = r - posts; i <= r + posts + 1; ++i) {
    for (int k = c - posts; k <= c + posts + 1; ++k) {
      highest = std::fmax(highest, static_cast<double>(post_m(tile, i, k)));
    }
  }
  return highest;
}

}  // namespace ridgeline::sim
