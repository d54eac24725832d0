#include "core/frame/terrain_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double least_clearance_m = 0.05;
constexpr int window_margin_posts = 4;  ///< posts beyond the range that nodes may look at
constexpr int clearance_cells = 8;
constexpr double travel_share = 0.25;  ///< part of the range the eye may move before a refill
constexpr double metres_per_degree = 110'574.0;  ///< of latitude at the equator, the smallest

bool inside(const GeoBox& box, const GeoBox& outer) {
  double shift = 0;  // the two boxes may name the same meridians 360 degrees apart
  const double middle = 0.5 * (box.west_deg + box.east_deg);
  const double outer_middle = 0.5 * (outer.west_deg + outer.east_deg);
  shift = 360.0 * std::round((outer_middle - middle) / 360.0);
  return box.south_deg >= outer.south_deg && box.north_deg <= outer.north_deg &&
         box.west_deg + shift >= outer.west_deg && box.east_deg + shift <= outer.east_deg;
}

int round_up(double posts) {
  const int unit = limits::window_alignment_posts;
  const int count = static_cast<int>(std::ceil(posts / unit)) * unit;
  return std::clamp(count, 2 * unit, limits::max_window_posts);
}

}  // namespace

WindowSize window_size(double latitude_deg, double range_m, double latitude_step_deg,
                       double longitude_step_deg) {
  const double latitude = std::min(std::abs(latitude_deg) + 0.5, 89.0);
  const GeoBox box = range_box(latitude, 0.0, range_m * (1.0 + travel_share));
  // Half a block is lost to alignment, and nodes look a few posts beyond the range.
  const double extra = 64 + 4 * window_margin_posts;
  return {round_up((box.east_deg - box.west_deg) / longitude_step_deg + extra),
          round_up((box.north_deg - box.south_deg) / latitude_step_deg + extra)};
}

PostSteps finest_steps(std::span<const HeightTile> tiles) {
  PostSteps steps;
  for (const HeightTile& tile : tiles) {
    const PostGrid& g = tile.grid;
    if (steps.latitude_deg == 0 || g.latitude_step_deg < steps.latitude_deg * (1 - 1e-6)) {
      steps.latitude_deg = g.latitude_step_deg;
      steps.phase_latitude_deg = g.south_deg;
    }
    if (steps.longitude_deg == 0 || g.longitude_step_deg < steps.longitude_deg * (1 - 1e-6)) {
      steps.longitude_deg = g.longitude_step_deg;
      steps.phase_longitude_deg = g.west_deg;
    }
  }
  return steps;
}

TerrainKeeper::TerrainKeeper(TerrainPort& port, const GeoidLookup& geoid, int columns, int rows,
                             std::span<float> posts, std::span<float> scratch)
    : port_(port), geoid_(geoid), columns_(columns), rows_(rows), posts_(posts), scratch_(scratch) {
  RL_ASSERT(posts.size() == static_cast<std::size_t>(columns) * rows);
  RL_ASSERT(scratch.size() >= 2 * static_cast<std::size_t>(limits::max_window_posts));
}

bool TerrainKeeper::follow(const GeodeticPosition& eye, double range_m) {
  range_m_ = range_m;
  if (filled_) {
    const GeoBox needed = range_box(eye.latitude_deg, eye.longitude_deg, range_m);
    if (inside(needed, window_box(grid_, window_margin_posts))) return false;
    // A window that cannot cover the range is moved only when the eye has left its middle.
    const double north = std::abs(eye.latitude_deg - grid_.latitude_deg(rows_ / 2));
    const double east =
        std::abs(std::remainder(eye.longitude_deg - grid_.longitude_deg(columns_ / 2), 360.0));
    const double limit_posts = 0.05 * std::min(rows_, columns_) + 64;
    if (north < limit_posts * grid_.latitude_step_deg &&
        east < limit_posts * grid_.longitude_step_deg) {
      return false;
    }
  }
  fill(eye);
  return true;
}

void TerrainKeeper::rebase(const GeodeticPosition& eye) {
  fill(eye);
}

void TerrainKeeper::fill(const GeodeticPosition& eye) {
  // The window takes the finest step of the tiles within the display range; what it then holds is
  // chosen by its own box, which may be larger or, where it cannot cover the range, smaller.
  constexpr double srtm3_deg = 1.0 / 1200.0;  // no tile in range: any step will do, all is unknown
  const GeoBox in_range = range_box(eye.latitude_deg, eye.longitude_deg, range_m_);
  const PostSteps steps = finest_steps(port_.select(in_range));
  const double step_lat = steps.latitude_deg > 0 ? steps.latitude_deg : srtm3_deg;
  const double step_lon = steps.longitude_deg > 0 ? steps.longitude_deg : srtm3_deg;
  grid_ = window_grid_at(eye.latitude_deg, eye.longitude_deg, step_lat, step_lon,
                         steps.phase_latitude_deg, steps.phase_longitude_deg, columns_, rows_);
  const std::span<const HeightTile> tiles = port_.select(window_box(grid_, 0));
  base_height_m_ = std::round(eye.height_m);
  summary_ = fill_window(grid_, tiles, geoid_, base_height_m_, posts_, scratch_);
  filled_ = true;
}

double TerrainKeeper::covered_range_m(const GeodeticPosition& eye, double range_m) const {
  const GeoBox outer = window_box(grid_, window_margin_posts);
  double range = range_m;
  for (int step = 0; step < 40; ++step) {
    if (inside(range_box(eye.latitude_deg, eye.longitude_deg, range), outer)) return range;
    range *= 0.93;
  }
  return 0.0;
}

double TerrainKeeper::height_over_terrain_m(const GeodeticPosition& eye) const {
  return eye.height_m - base_height_m_ -
         window_height_m(grid_, posts_, eye.latitude_deg, eye.longitude_deg);
}

double TerrainKeeper::clearance_m(const GeodeticPosition& eye) const {
  double east = eye.longitude_deg - grid_.west_deg;
  east -= 360.0 * std::floor(east / 360.0);
  const auto column = static_cast<int>(east / grid_.longitude_step_deg);
  const auto row = static_cast<int>((eye.latitude_deg - grid_.south_deg) / grid_.latitude_step_deg);
  const double post_y = grid_.latitude_step_deg * metres_per_degree;
  const double post_x = grid_.longitude_step_deg * metres_per_degree *
                        std::max(std::cos(eye.latitude_deg * deg), 1e-3);
  double steepest_x = 0, steepest_y = 0, highest = -1e9;
  for (int r = row - clearance_cells; r <= row + clearance_cells; ++r) {
    for (int c = column - clearance_cells; c <= column + clearance_cells; ++c) {
      if (r < 0 || c < 0 || r + 1 >= rows_ || c + 1 >= columns_) continue;
      const auto at = static_cast<std::size_t>(r) * columns_ + c;
      const auto h = static_cast<double>(posts_[at]);
      const auto right = static_cast<double>(posts_[at + 1]);
      const auto up = static_cast<double>(posts_[at + columns_]);
      if (h < static_cast<double>(void_threshold_m)) continue;
      highest = std::max(highest, h);
      const auto limit = static_cast<double>(void_threshold_m);
      if (right > limit) steepest_x = std::max(steepest_x, std::abs(right - h) / post_x);
      if (up > limit) steepest_y = std::max(steepest_y, std::abs(up - h) / post_y);
    }
  }
  // The surface is Lipschitz within the cells looked at; what lies beyond is at least that far off.
  double over = height_over_terrain_m(eye);
  if (std::isnan(over)) over = eye.height_m - base_height_m_ - highest;
  const double near = over / std::sqrt(1.0 + steepest_x * steepest_x + steepest_y * steepest_y);
  const double beyond = (clearance_cells - 1) * std::min(post_x, post_y);
  return std::max(std::min(near, beyond), least_clearance_m);
}

}  // namespace ridgeline
