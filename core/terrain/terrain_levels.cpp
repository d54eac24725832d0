#include "core/terrain/terrain_levels.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/assert.hpp"

namespace ridgeline {
namespace {

constexpr double recentre_blocks = 0.75;  ///< the eye may be this far from the middle of its level
constexpr double travel_blocks = 1.0;     ///< beyond the range: recentring, and strips on their way
constexpr int edge_posts = 8;             ///< of a level, next to its valid part's edge: not drawn

int blocks_for(double half_posts, int level) {
  const double posts = half_posts / (1 << level) + edge_posts + travel_blocks * block_posts;
  return 2 * static_cast<int>(std::ceil(posts / block_posts));
}

PostRect intersection(const PostRect& a, const PostRect& b) {
  return {std::max(a.west, b.west), std::max(a.south, b.south), std::min(a.east, b.east),
          std::min(a.north, b.north)};
}

PostRect united(const PostRect& a, const PostRect& b) {
  return {std::min(a.west, b.west), std::min(a.south, b.south), std::max(a.east, b.east),
          std::max(a.north, b.north)};
}

}  // namespace

LevelSizes level_sizes(double half_columns, double half_rows, std::int64_t most_posts) {
  LevelSizes sizes;
  for (sizes.levels = 1; sizes.levels <= max_levels; ++sizes.levels) {
    sizes.column_blocks = blocks_for(half_columns, sizes.levels - 1);
    sizes.row_blocks = blocks_for(half_rows, sizes.levels - 1);
    if (sizes.posts() <= most_posts) break;
  }
  if (sizes.levels > max_levels) {
    sizes.levels = max_levels;
    const double shrink =
        std::sqrt(static_cast<double>(most_posts) / static_cast<double>(sizes.posts()));
    sizes.column_blocks = std::max(2, 2 * static_cast<int>(0.5 * shrink * sizes.column_blocks));
    sizes.row_blocks = std::max(2, 2 * static_cast<int>(0.5 * shrink * sizes.row_blocks));
    return sizes;
  }
  while (sizes.levels > 1) {
    LevelSizes larger = sizes;
    // Grow the side that is shorter on the ground.
    const bool wider = sizes.column_blocks * half_rows <= sizes.row_blocks * half_columns;
    (wider ? larger.column_blocks : larger.row_blocks) += 2;
    if (larger.posts() > most_posts) break;
    sizes = larger;
  }
  return sizes;
}

TerrainLevels::TerrainLevels(const LevelSizes& sizes, std::span<HeldBlock> memory)
    : sizes_(sizes), memory_(memory) {
  RL_ASSERT(sizes.levels >= 1 && sizes.levels <= max_levels);
  RL_ASSERT(memory.size() >= static_cast<std::size_t>(sizes.levels * sizes.blocks()));
  clear();
}

void TerrainLevels::clear() {
  for (HeldBlock& block : memory_) block = {};
  level_ = {};
}

BlockSlot TerrainLevels::slot(const BlockId& id) const {
  return {wrapped(id.column, sizes_.column_blocks), wrapped(id.row, sizes_.row_blocks)};
}

const HeldBlock& TerrainLevels::place(const BlockId& id) const {
  const BlockSlot at = slot(id);
  return memory_[static_cast<std::size_t>(id.level * sizes_.blocks() +
                                          at.row * sizes_.column_blocks + at.column)];
}

HeldBlock& TerrainLevels::place(const BlockId& id) {
  const BlockSlot at = slot(id);
  return memory_[static_cast<std::size_t>(id.level * sizes_.blocks() +
                                          at.row * sizes_.column_blocks + at.column)];
}

const HeldBlock* TerrainLevels::find(const BlockId& id) const {
  const HeldBlock& block = place(id);
  return block.held && block.id == id ? &block : nullptr;
}

void TerrainLevels::follow(double eye_column, double eye_row) {
  for (int l = 0; l < sizes_.levels; ++l) {
    Level& level = level_[static_cast<std::size_t>(l)];
    const double block = static_cast<double>(block_posts << l);
    level.eye_column = eye_column / block;
    level.eye_row = eye_row / block;
    const double middle_column = level.target.west + 0.5 * sizes_.column_blocks;
    const double middle_row = level.target.south + 0.5 * sizes_.row_blocks;
    const auto start = [](double eye, int count) {
      return static_cast<std::int32_t>(std::lround(eye)) - count / 2;
    };
    if (!level.placed || std::abs(level.eye_column - middle_column) > recentre_blocks) {
      level.target.west = start(level.eye_column, sizes_.column_blocks);
    }
    if (!level.placed || std::abs(level.eye_row - middle_row) > recentre_blocks) {
      level.target.south = start(level.eye_row, sizes_.row_blocks);
    }
    level.placed = true;
    level.target.east = level.target.west + sizes_.column_blocks;
    level.target.north = level.target.south + sizes_.row_blocks;
    level.valid = intersection(level.valid, level.target);
    const auto eye_x = static_cast<std::int32_t>(std::floor(level.eye_column));
    const auto eye_y = static_cast<std::int32_t>(std::floor(level.eye_row));
    const bool holds_eye = eye_x >= level.valid.west && eye_x < level.valid.east &&
                           eye_y >= level.valid.south && eye_y < level.valid.north;
    if (!holds_eye) level.valid = {};
    grow(l);
  }
}

bool TerrainLevels::holds(int level, const Rect& blocks) const {
  for (std::int32_t row = blocks.south; row < blocks.north; ++row) {
    for (std::int32_t column = blocks.west; column < blocks.east; ++column) {
      if (find({level, column, row}) == nullptr) return false;
    }
  }
  return true;
}

/// The strip that a rectangle grows by next: on the side where the eye is nearest to its edge.
TerrainLevels::Strip TerrainLevels::next_strip(const Level& level, const Rect& from) {
  if (from.empty()) {
    const auto x = static_cast<std::int32_t>(std::floor(level.eye_column));
    const auto y = static_cast<std::int32_t>(std::floor(level.eye_row));
    const Rect eye{x, y, x + 1, y + 1};
    return {eye, !intersection(eye, level.target).empty()};
  }
  Strip best;
  double least = 0;
  const auto offer = [&](bool wanted, double distance, const Rect& strip) {
    if (!wanted || (best.exists && distance >= least)) return;
    best = {strip, true};
    least = distance;
  };
  const Rect& t = level.target;
  offer(from.west > t.west, level.eye_column - from.west,
        {from.west - 1, from.south, from.west, from.north});
  offer(from.east < t.east, from.east - level.eye_column,
        {from.east, from.south, from.east + 1, from.north});
  offer(from.south > t.south, level.eye_row - from.south,
        {from.west, from.south - 1, from.east, from.south});
  offer(from.north < t.north, from.north - level.eye_row,
        {from.west, from.north, from.east, from.north + 1});
  return best;
}

void TerrainLevels::grow(int l) {
  Level& level = level_[static_cast<std::size_t>(l)];
  for (;;) {
    const Strip strip = next_strip(level, level.valid);
    if (!strip.exists || !holds(l, strip.blocks)) return;
    level.valid = level.valid.empty() ? strip.blocks : united(level.valid, strip.blocks);
  }
}

/// How much of its reach a level has: the least distance from the eye to an edge that can still
/// grow, in halves of the level.
double TerrainLevels::filled(const Level& level, const Rect& ahead) const {
  if (ahead.empty()) return 0.0;
  const Strip strip = next_strip(level, ahead);
  if (!strip.exists) return 2.0;
  const double column = std::min(level.eye_column - ahead.west, ahead.east - level.eye_column);
  const double row = std::min(level.eye_row - ahead.south, ahead.north - level.eye_row);
  return std::min(column / (0.5 * sizes_.column_blocks), row / (0.5 * sizes_.row_blocks));
}

int TerrainLevels::next_wanted(std::span<BlockId> wanted) {
  std::array<Rect, max_levels> ahead{};
  for (int l = 0; l < sizes_.levels; ++l) {
    ahead[static_cast<std::size_t>(l)] = level_[static_cast<std::size_t>(l)].valid;
  }
  std::size_t count = 0;
  while (count < wanted.size()) {
    int chosen = -1;
    double least = 1.9;
    for (int l = sizes_.levels - 1; l >= 0; --l) {  // the coarser one first: it carries the range
      const Level& level = level_[static_cast<std::size_t>(l)];
      const double part = level.placed ? filled(level, ahead[static_cast<std::size_t>(l)]) : 2.0;
      if (part < least) {
        least = part;
        chosen = l;
      }
    }
    if (chosen < 0) break;
    Rect& from = ahead[static_cast<std::size_t>(chosen)];
    const Strip strip = next_strip(level_[static_cast<std::size_t>(chosen)], from);
    if (!strip.exists) break;
    for (std::int32_t row = strip.blocks.south; row < strip.blocks.north; ++row) {
      for (std::int32_t column = strip.blocks.west; column < strip.blocks.east; ++column) {
        const BlockId id{chosen, column, row};
        HeldBlock& block = place(id);
        const bool on_its_way = block.asked && block.asked_id == id;
        if (find(id) != nullptr || on_its_way) continue;
        if (count == wanted.size()) return static_cast<int>(count);
        block.asked = true;
        block.asked_id = id;
        wanted[count++] = id;
      }
    }
    from = from.empty() ? strip.blocks : united(from, strip.blocks);
  }
  return static_cast<int>(count);
}

bool TerrainLevels::accept(const TerrainBlock& block) {
  const BlockId& id = block.id;
  HeldBlock& place_of = place(id);
  if (place_of.asked && place_of.asked_id == id) place_of.asked = false;
  const Level& level = level_[static_cast<std::size_t>(id.level)];
  const Rect own{id.column, id.row, id.column + 1, id.row + 1};
  if (intersection(own, level.target).empty()) {
    // An older copy must not come back with the eye: the terrain may have changed since.
    if (place_of.held && place_of.id == id) place_of.held = false;
    return false;
  }
  place_of.id = id;
  place_of.facts = block.facts;
  place_of.held = true;
  grow(id.level);
  return true;
}

void TerrainLevels::release(const BlockId& id) {
  HeldBlock& block = place(id);
  if (block.asked && block.asked_id == id) block.asked = false;
}

bool TerrainLevels::complete() const {
  for (int l = 0; l < sizes_.levels; ++l) {
    const Level& level = level_[static_cast<std::size_t>(l)];
    if (!level.placed || !(level.valid == level.target)) return false;
  }
  return true;
}

PostRect TerrainLevels::target(int level) const {
  const Rect& t = level_[static_cast<std::size_t>(level)].target;
  const std::int32_t span = block_posts << level;
  return {t.west * span, t.south * span, t.east * span, t.north * span};
}

PostRect TerrainLevels::drawable(int level) const {
  PostRect rect{};
  for (int l = sizes_.levels - 1; l >= level; --l) {
    const Rect& valid = level_[static_cast<std::size_t>(l)].valid;
    if (valid.empty()) return {};
    const std::int32_t span = block_posts << l, edge = edge_posts << l;
    const PostRect own{valid.west * span + edge, valid.south * span + edge,
                       valid.east * span - edge, valid.north * span - edge};
    rect = l == sizes_.levels - 1 ? own : intersection(rect, own);
  }
  return rect.empty() ? PostRect{} : rect;
}

}  // namespace ridgeline
