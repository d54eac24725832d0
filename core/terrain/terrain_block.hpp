#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/base/vec.hpp"
#include "core/terrain/post_region.hpp"

namespace ridgeline {

/// The terrain window is made of blocks. A block of level l has 64 x 64 posts, 2^l lattice posts
/// apart; block (i, j) of a level starts at lattice post (64 i 2^l, 64 j 2^l).
inline constexpr int block_posts = 64;
inline constexpr int block_levels = 6;  ///< of the pyramid of highest heights inside a block
inline constexpr int block_nodes = 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1;

/// What the posts of a block mean to the shaders.
///
/// A known post is its height above the ellipsoid. A void post is stored as `floor -
/// void_offset_m`, floor being the height up to which its cells are drawn as unknown: of the
/// lattice posts, the highest known one of the smallest aligned square of 8, 16, 32 or 64 posts a
/// side that holds the void post and a known one; where there is none, the highest known post of
/// the 5 x 5 squares of 64 round it; where those hold none, the far floor of the session. All three
/// lie between what the contract says must and may be unknown (docs/adr/0006).
inline constexpr float void_offset_m = 100'000.0F;
inline constexpr float void_threshold_m = -50'000.0F;

inline constexpr int residual_parts = 4;  ///< a side, each with a residual and a slope of its own
inline constexpr int ground_parts = 8;    ///< a side, each with what its own cells are like
inline constexpr int region_margin = 2;   ///< cells of its level that a block looks beyond itself

/// Unit of TerrainBlock::rests: half an ulp of the highest float below 16384 m is 127 of it. m
inline constexpr double rest_unit_m = 0x1p-11 / 127;

struct BlockId {
  int level = 0;
  std::int32_t column = 0, row = 0;
  friend bool operator==(const BlockId&, const BlockId&) = default;
};

/// The true surface of 8 x 8 cells of a block's level, through the finest posts.
struct GroundPart {
  float steepness = 0;                ///< largest slope
  float lowest_m = 0, highest_m = 0;  ///< highest < lowest: nothing is known
};

/// What a block says about itself, for the bound and for the march.
struct BlockFacts {
  /// The true surface lies within this of the block's own bilinear surface, everywhere over its
  /// known cells. 0 at level 0 unless tiles of different steps disagree there; in a polar chart the
  /// cells of the tiles do not lie on those of the lattice, and level 0 has one too. m
  float residual_m = 0;
  /// The same for each of 4 x 4 parts, row-major from the south-west.
  std::array<float, residual_parts * residual_parts> part_residual_m{};
  /// Largest slope of the surface through the finest posts, over each part and two cells of the
  /// level round it; and over all of them.
  std::array<float, residual_parts * residual_parts> part_steepness{};
  float steepness = 0;
  std::array<GroundPart, ground_parts * ground_parts> ground{};  ///< row-major from the south-west
  float lowest_m = 0, highest_m = 0;  ///< of posts, truth and floors; highest < lowest: none
  std::int32_t known_posts = 0;       ///< of the block's own posts
  std::int32_t void_posts = 0;
  std::int32_t mismatched_tiles = 0;
  /// Some cell of the block is unknown where the truth is known, or the other way round: a void
  /// smaller than a cell. Such a block must not be drawn.
  bool mixed = false;
  Vec3<Ecef> centre;  ///< of a ball that holds the block's ground up to `highest_m`
  double radius_m = 0;
};

struct TerrainBlock {
  BlockId id;
  Chart chart = Chart::geographic;
  int edits = 0;  ///< the block knows the first so many edits
  BlockFacts facts;
  std::array<float, block_posts * block_posts> posts{};  ///< row-major from the south-west
  /// At level 0, what rounding to a float took from each post, in units of rest_unit_m; 0 in a
  /// polar chart, whose posts are off by their rounding.
  std::array<std::int8_t, block_posts * block_posts> rests{};
  /// Pyramid of maxima: 32 x 32 nodes of 2 x 2 cells, then 16 x 16, ... 1. A node bounds every
  /// post, floor and true height of its cells and of one cell more on every side, of this level and
  /// of every finer one.
  std::array<float, block_nodes> highest{};
};

/// Memory a block is built in. Shape: `posts` >= region_side(level)^2, `rows` >=
/// row_scratch(level), `rests` >= region_side(0)^2; in a polar chart `low` and `high` >=
/// polar_cells(level).
struct BlockScratch {
  std::span<float> posts;
  std::span<float> rows;
  std::span<float> rests;
  std::span<float> low{}, high{};
};
constexpr int region_side(int level) {
  return ((block_posts + 2 * region_margin) << level) + 1;
}
constexpr int row_scratch(int level) {
  return 4 * region_side(level) + 8;
}

constexpr std::size_t polar_cells(int level) {
  const auto side = static_cast<std::size_t>(region_side(level)) + 1;
  return side * side;
}

/// Builds one block from the raw tiles.
/// `far_floor_m`: up to where ground far from every known post is drawn as unknown.
/// Cost: O(4^level) posts read; more, by a constant, where posts are void. No allocation.
void build_block(const TerrainSource& source, const BlockId& id, double far_floor_m,
                 const BlockScratch& scratch, TerrainBlock& block);

/// The lattice posts that a block is built from: a change of any of them may change the block.
PostBox block_region(const BlockId& id);
/// The same with what floors of unknown ground look at.
PostBox block_neighbourhood(const BlockId& id);

}  // namespace ridgeline
