#include "core/frame/terrain_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double least_height_m = 0.05;  ///< over the ground; lower counts as below it
constexpr double least_clearance_m = 1e-3;
constexpr int window_margin_posts = 4;  ///< posts beyond the range that nodes may look at
constexpr int clearance_cells = 8;
constexpr double metres_per_degree = 110'574.0;  ///< of latitude at the equator, the smallest
constexpr double latitude_slack_deg =
    1.0;  ///< a window is sized for an eye this much farther north

}  // namespace

GeoBox range_box(double latitude_deg, double longitude_deg, double range_m) {
  constexpr double smallest_radius_m = 6'335'000.0;  // meridian radius at the equator
  const double angle = 1.01 * range_m / smallest_radius_m;
  const double ratio = std::sin(angle) / std::cos(latitude_deg * deg);
  const double half_longitude = ratio < 1.0 ? std::asin(ratio) / deg : 180.0;
  return {latitude_deg - angle / deg, longitude_deg - half_longitude, latitude_deg + angle / deg,
          longitude_deg + half_longitude};
}

LevelSizes window_sizes(const PostLattice& lattice, double latitude_deg, double range_m,
                        double gpu_bytes, bool polar) {
  const double highest_deg = polar ? 90.0 - polar_enter_deg(range_m) : 89.0;
  const double latitude = std::min(std::abs(latitude_deg) + latitude_slack_deg, highest_deg);
  const GeoBox box = range_box(latitude, 0.0, range_m);
  double half_columns = 0.5 * (box.east_deg - box.west_deg) / lattice.longitude_step_deg;
  double half_rows = 0.5 * (box.north_deg - box.south_deg) / lattice.latitude_step_deg;
  if (polar) {
    const PostLattice at_pole = lattice_in(Chart::north_polar, lattice);
    const double half = 0.5 * (box.north_deg - box.south_deg) / at_pole.latitude_step_deg;
    half_columns = std::max(half_columns, half);
    half_rows = std::max(half_rows, half);
  }
  return level_sizes(half_columns + window_margin_posts, half_rows + window_margin_posts,
                     static_cast<std::int64_t>(gpu_bytes / gpu_bytes_per_post));
}

TerrainKeeper::TerrainKeeper(BlockPort& port, const PostLattice& lattice, const LevelSizes& sizes,
                             std::span<HeldBlock> held, std::span<float> finest_posts,
                             double polar_range_m)
    : port_(port),
      geographic_(lattice),
      lattice_(lattice),
      polar_range_m_(polar_range_m),
      levels_(sizes, held),
      finest_posts_(finest_posts) {
  RL_ASSERT(finest_posts.size() >=
            static_cast<std::size_t>(sizes.columns()) * static_cast<std::size_t>(sizes.rows()));
}

bool TerrainKeeper::change_chart(const GeodeticPosition& eye) {
  if (!(polar_range_m_ > 0)) return false;
  const Chart chart = chart_for(lattice_.chart, eye.latitude_deg, polar_range_m_);
  if (chart == lattice_.chart) return false;
  lattice_ = lattice_in(chart, geographic_);
  levels_.clear();
  focus_ = {};
  return true;
}

void TerrainKeeper::follow(const GeodeticPosition& eye, Renderer& renderer) {
  const bool fresh = change_chart(eye);
  const LatticePoint at = lattice_.point_of({eye.latitude_deg, eye.longitude_deg}, eye_column_);
  eye_column_ = at.column;
  eye_row_ = at.row;
  levels_.follow(eye_column_, eye_row_);
  arrived_ = 0;
  take_arrived(renderer);
  order_missing();
  if (!fresh) return;
  take_arrived(renderer);  // nothing is left to draw from but what can be had at once
  order_missing();
}

void TerrainKeeper::settle(const GeodeticPosition& eye, Renderer& renderer) {
  follow(eye, renderer);
  while (!levels_.complete()) {
    take_arrived(renderer);
    order_missing();
  }
}

void TerrainKeeper::take_arrived(Renderer& renderer) {
  while (const TerrainBlock* block = port_.take()) {
    if (block->chart != lattice_.chart) continue;  // ordered before the chart changed
    if (block->edits < edits_) {                   // built before the terrain changed
      levels_.release(block->id);
      continue;
    }
    put(*block, renderer);
    ++arrived_;
  }
}

void TerrainKeeper::put(const TerrainBlock& block, Renderer& renderer) {
  if (!levels_.accept(block)) return;
  const BlockSlot slot = levels_.slot(block.id);
  renderer.upload_block(block, slot);
  if (block.id.level != 0) return;
  const auto index =
      static_cast<std::size_t>(slot.row * levels_.sizes().column_blocks + slot.column);
  std::copy(block.posts.begin(), block.posts.end(),
            finest_posts_.begin() + static_cast<std::ptrdiff_t>(index * block.posts.size()));
}

void TerrainKeeper::order_missing() {
  const int coarsest = levels_.sizes().levels - 1;
  const PostRect target = levels_.target(coarsest);
  if (!(target == focus_)) {
    focus_ = target;
    const int edge = 4 * block_posts << coarsest;
    port_.focus(geo_box(
        lattice_, {target.west - edge, target.south - edge, target.east - target.west + 2 * edge,
                   target.north - target.south + 2 * edge}));
  }
  std::array<BlockId, limits::blocks_in_flight> wanted;
  const int room = std::min(port_.room(), limits::blocks_in_flight);
  const int count = levels_.next_wanted(std::span(wanted).first(static_cast<std::size_t>(room)));
  for (int k = 0; k < count; ++k) {
    port_.order({wanted[static_cast<std::size_t>(k)], edits_, lattice_.chart});
  }
}

bool TerrainKeeper::touches(const PostGrid& edited, const BlockId& id) const {
  if (lattice_.polar()) {
    PostGrid wide = edited;  // cells round a changed post change
    wide.south_deg -= edited.latitude_step_deg;
    wide.west_deg -= edited.longitude_step_deg;
    wide.rows += 2;
    wide.columns += 2;
    PostBox box = block_region(id);
    box.column -= 2;
    box.row -= 2;
    box.columns += 4;
    box.rows += 4;
    return overlaps(geo_box(lattice_, box), wide);
  }
  const double middle = 0.5 * (edited.west_deg + edited.east_deg());
  const double shift = lattice_.column_near(middle, eye_column_) - lattice_.column_of(middle);
  // A tile coarser than the lattice carries a changed post to its next posts.
  const double more_columns = edited.longitude_step_deg / lattice_.longitude_step_deg;
  const double more_rows = edited.latitude_step_deg / lattice_.latitude_step_deg;
  const double west = std::floor(lattice_.column_of(edited.west_deg) + shift - more_columns);
  const double east = std::ceil(lattice_.column_of(edited.east_deg()) + shift + more_columns);
  const double south = std::floor(lattice_.row_of(edited.south_deg) - more_rows);
  const double north = std::ceil(lattice_.row_of(edited.north_deg()) + more_rows);
  const PostBox box = block_neighbourhood(id);
  return box.column <= east && box.column + box.columns >= west && box.row <= north &&
         box.row + box.rows >= south;
}

void TerrainKeeper::edit(std::span<const PostGrid> regions, Renderer& renderer) {
  edits_ += static_cast<int>(regions.size());
  for (const PostGrid& region : regions) {
    levels_.over_held([&](const HeldBlock& held) {
      if (!touches(region, held.id)) return;
      const TerrainBlock* block = port_.build({held.id, edits_, lattice_.chart});
      if (block != nullptr) put(*block, renderer);
    });
  }
}

double TerrainKeeper::covered_range_m(const GeodeticPosition& eye, double range_m) const {
  const PostRect rect = levels_.drawable(levels_.sizes().levels - 1);
  if (rect.empty()) return 0.0;
  double range = range_m;
  const double margin = window_margin_posts << (levels_.sizes().levels - 1);
  for (int step = 0; step < 120; ++step) {
    const GeoBox box = range_box(eye.latitude_deg, eye.longitude_deg, range);
    // In a polar chart no metre is longer in posts than along a meridian.
    const double rows = 0.5 * (box.north_deg - box.south_deg) / lattice_.latitude_step_deg + margin;
    const double columns =
        lattice_.polar()
            ? rows
            : 0.5 * (box.east_deg - box.west_deg) / lattice_.longitude_step_deg + margin;
    const bool inside = eye_column_ - columns >= rect.west && eye_column_ + columns <= rect.east &&
                        eye_row_ - rows >= rect.south && eye_row_ + rows <= rect.north;
    if (inside) return range;
    range *= 0.96;
  }
  return 0.0;
}

float TerrainKeeper::finest_post(std::int32_t column, std::int32_t row) const {
  const BlockId id{0, column >> 6, row >> 6};
  if (levels_.find(id) == nullptr) return -2 * void_offset_m;
  const BlockSlot slot = levels_.slot(id);
  const auto block =
      static_cast<std::size_t>(slot.row * levels_.sizes().column_blocks + slot.column);
  const int inside = (row & (block_posts - 1)) * block_posts + (column & (block_posts - 1));
  return finest_posts_[block * block_posts * block_posts + static_cast<std::size_t>(inside)];
}

/// Height of the known surface, NaN where it is unknown.
double TerrainKeeper::height_below_m(double column, double row) const {
  const auto c = static_cast<std::int32_t>(std::floor(column));
  const auto r = static_cast<std::int32_t>(std::floor(row));
  const double fx = column - c, fy = row - r;
  const float sw = finest_post(c, r), se = finest_post(c + 1, r);
  const float nw = finest_post(c, r + 1), ne = finest_post(c + 1, r + 1);
  if (std::min({sw, se, nw, ne}) < void_threshold_m) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return (static_cast<double>(sw) * (1 - fx) + static_cast<double>(se) * fx) * (1 - fy) +
         (static_cast<double>(nw) * (1 - fx) + static_cast<double>(ne) * fx) * fy;
}

double TerrainKeeper::residual_near_m(const BlockId& id) const {
  const HeldBlock* block = levels_.find(id);
  return block == nullptr ? 0.0 : static_cast<double>(block->facts.residual_m);
}

/// Lower bound on the distance from the eye to the known ground of one cell, whatever is round it.
double TerrainKeeper::cell_distance_m(const GeodeticPosition& eye, std::int32_t c, std::int32_t r,
                                      double post_x, double post_y) const {
  const std::array<float, 4> posts{finest_post(c, r), finest_post(c + 1, r), finest_post(c, r + 1),
                                   finest_post(c + 1, r + 1)};
  const float highest = *std::max_element(posts.begin(), posts.end());
  if (highest < void_threshold_m) return std::numeric_limits<double>::infinity();
  const double x = post_x * std::max({0.0, c - eye_column_, eye_column_ - (c + 1)});
  const double y = post_y * std::max({0.0, r - eye_row_, eye_row_ - (r + 1)});
  const double away2 = x * x + y * y;
  double over = std::max(0.0, eye.height_m - static_cast<double>(highest));
  if (*std::min_element(posts.begin(), posts.end()) > void_threshold_m) {
    // From the point of the cell nearest to the eye the ground rises by its slope at most.
    const auto post = [&](std::size_t k) { return static_cast<double>(posts[k]); };
    const double fx = std::clamp(eye_column_ - c, 0.0, 1.0);
    const double fy = std::clamp(eye_row_ - r, 0.0, 1.0);
    const double nearest_m =
        (post(0) * (1 - fx) + post(1) * fx) * (1 - fy) + (post(2) * (1 - fx) + post(3) * fx) * fy;
    const double east = std::max(std::abs(post(1) - post(0)), std::abs(post(3) - post(2))) / post_x;
    const double north =
        std::max(std::abs(post(2) - post(0)), std::abs(post(3) - post(1))) / post_y;
    const double gap_m = std::max(0.0, eye.height_m - nearest_m);
    over = std::max(over, gap_m / std::sqrt(1.0 + east * east + north * north));
  }
  return std::sqrt(away2 + over * over);
}

/// Between the lowest and the highest post of a known cell; 0 for an unknown one, which is flat.
double TerrainKeeper::cell_relief_m(std::int32_t c, std::int32_t r) const {
  const auto [low, high] = std::minmax(
      {finest_post(c, r), finest_post(c + 1, r), finest_post(c, r + 1), finest_post(c + 1, r + 1)});
  return low < void_threshold_m ? 0.0 : static_cast<double>(high) - static_cast<double>(low);
}

Clearance TerrainKeeper::near_clearance(const GeodeticPosition& eye) const {
  const auto column = static_cast<std::int32_t>(std::floor(eye_column_));
  const auto row = static_cast<std::int32_t>(std::floor(eye_row_));
  const double post_y = lattice_.latitude_step_deg * metres_per_degree;
  const double narrow =
      lattice_.polar() ? 1.0 : std::max(std::cos(eye.latitude_deg * deg) - 1e-4, 1e-3);
  const double post_x = lattice_.longitude_step_deg * metres_per_degree * narrow;
  double near_m = (clearance_cells - 1) * std::min(post_x, post_y);  // to what is not looked at
  double relief_m = 0;
  for (std::int32_t r = row - clearance_cells; r <= row + clearance_cells; ++r) {
    for (std::int32_t c = column - clearance_cells; c <= column + clearance_cells; ++c) {
      near_m = std::min(near_m, cell_distance_m(eye, c, r, post_x, post_y));
      relief_m = std::max(relief_m, cell_relief_m(c, r));
    }
  }
  double residual = 0;  // what the truth may be nearer by
  for (const std::int32_t c : {column - clearance_cells, column + clearance_cells + 1}) {
    for (const std::int32_t r : {row - clearance_cells, row + clearance_cells + 1}) {
      residual = std::max(residual, residual_near_m({0, c >> block_levels, r >> block_levels}));
    }
  }
  const double below = height_below_m(eye_column_, eye_row_);
  const double over = eye.height_m - below;
  if (over + residual <= least_height_m) {
    return {Clearance::Kind::below, least_clearance_m, relief_m};
  }
  return {Clearance::Kind::above, std::max(near_m - residual, least_clearance_m), relief_m};
}

Clearance TerrainKeeper::clearance(const GeodeticPosition& eye) const {
  const auto column = static_cast<std::int32_t>(std::floor(eye_column_));
  const auto row = static_cast<std::int32_t>(std::floor(eye_row_));
  const PostRect near = levels_.drawable(0);
  const bool drawn = !near.empty() && column >= near.west && column < near.east &&
                     row >= near.south && row < near.north;
  if (drawn) return near_clearance(eye);
  // Ground outside a block and one cell of its level round it may stand higher than the block says.
  const double north_deg = std::min(std::abs(eye.latitude_deg) + 1.0, 90.0);
  const double narrow = lattice_.polar() ? 1.0 : std::cos(north_deg * deg);
  const double post_m = metres_per_degree *
                        std::min(lattice_.latitude_step_deg, lattice_.longitude_step_deg * narrow);
  double least = 0, relief_m = 0;
  for (int level = 1; level < levels_.sizes().levels; ++level) {
    const HeldBlock* block = levels_.find({level, column >> (6 + level), row >> (6 + level)});
    if (block == nullptr) continue;
    const double over = eye.height_m - static_cast<double>(block->facts.highest_m);
    least = std::max(least, std::min(over, post_m * (1 << level)));
    relief_m = std::max(relief_m, static_cast<double>(block->facts.highest_m) -
                                      static_cast<double>(block->facts.lowest_m));
  }
  if (least > 0) return {Clearance::Kind::above, std::max(least, least_clearance_m), relief_m};
  return {};
}

WindowSummary TerrainKeeper::summary() const {
  WindowSummary summary;
  summary.lowest_m = 1e9;
  summary.highest_m = -1e9;
  levels_.over_valid(levels_.sizes().levels - 1, [&](const HeldBlock& block) {
    const BlockFacts& facts = block.facts;
    if (facts.known_posts > 0) {
      summary.lowest_m = std::min(summary.lowest_m, static_cast<double>(facts.lowest_m));
    }
    summary.highest_m = std::max(summary.highest_m, static_cast<double>(facts.highest_m));
    summary.known_posts += facts.known_posts;
    summary.void_posts += facts.void_posts;
    summary.mismatched_tiles = std::max(summary.mismatched_tiles, facts.mismatched_tiles);
  });
  summary.blocks_arrived = arrived_;
  summary.complete = levels_.complete();
  return summary;
}

TerrainView TerrainKeeper::view() const {
  TerrainView view;
  view.lattice = lattice_;
  view.sizes = levels_.sizes();
  view.eye_column = eye_column_;
  view.eye_row = eye_row_;
  for (int l = 0; l < view.sizes.levels; ++l) {
    view.drawable[static_cast<std::size_t>(l)] = levels_.drawable(l);
  }
  return view;
}

}  // namespace ridgeline
