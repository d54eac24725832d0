#include "core/frame/terrain_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr int window_margin_posts = 4;           ///< posts beyond the range that nodes may look at
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
                             std::span<HeldBlock> held, const FinestPosts& finest_posts,
                             double polar_range_m)
    : port_(port),
      geographic_(lattice),
      lattice_(lattice),
      polar_range_m_(polar_range_m),
      levels_(sizes, held),
      finest_(finest_posts) {
  const auto posts =
      static_cast<std::size_t>(sizes.columns()) * static_cast<std::size_t>(sizes.rows());
  RL_ASSERT(finest_.heights_m.size() >= posts && finest_.rests.size() >= posts);
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
  const auto start = static_cast<std::ptrdiff_t>(index * block.posts.size());
  std::copy(block.posts.begin(), block.posts.end(), finest_.heights_m.begin() + start);
  std::copy(block.rests.begin(), block.rests.end(), finest_.rests.begin() + start);
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
