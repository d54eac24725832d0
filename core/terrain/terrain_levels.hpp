#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/terrain/terrain_block.hpp"

namespace ridgeline {

inline constexpr int max_levels = 6;

/// How large the terrain window is: so many levels of so many blocks each, all of one size.
struct LevelSizes {
  int levels = 0;
  int column_blocks = 0, row_blocks = 0;  ///< a side; even

  [[nodiscard]] int blocks() const { return column_blocks * row_blocks; }
  [[nodiscard]] int columns() const { return column_blocks * block_posts; }
  [[nodiscard]] int rows() const { return row_blocks * block_posts; }
  [[nodiscard]] std::int64_t posts() const {
    return static_cast<std::int64_t>(levels) * columns() * rows();
  }
};

/// The fewest levels with which a window of at most `most_posts` posts reaches `half_columns` and
/// `half_rows` lattice posts to every side of the eye wherever it stands; what is left of the
/// budget then makes all levels larger, if there are several.
/// Result: the largest window of max_levels levels where even that does not reach so far.
LevelSizes level_sizes(double half_columns, double half_rows, std::int64_t most_posts);

/// An index in toroidal memory of `count` places.
constexpr std::int32_t wrapped(std::int32_t index, int count) {
  const std::int32_t rest = index % count;
  return rest < 0 ? rest + count : rest;
}

/// Where a block stands in the memory of its level: toroidal, so that a block keeps its place as
/// long as the window holds it.
struct BlockSlot {
  int column = 0, row = 0;
};

/// A rectangle of lattice posts, ends excluded; empty when it has no width.
struct PostRect {
  std::int32_t west = 0, south = 0, east = 0, north = 0;
  [[nodiscard]] bool empty() const { return west >= east || south >= north; }
  friend bool operator==(const PostRect&, const PostRect&) = default;
};

/// A cell of the finest level written about the eye: over the ground point x columns east and y
/// rows north of it stands height + east x + north y + twist x y. m over the ellipsoid, per post.
struct NearCell {
  double height_m = 0, east_m = 0, north_m = 0, twist_m = 0;
  bool unknown = false;  ///< then flat: the floor up to which it is drawn as unknown
};

/// The nine cells round a low eye, row-major from the south-west. What a float32 height leaves out
/// counts there, half a millimetre of a few metres; beyond them it does not.
struct NearGround {
  bool used = false;
  std::array<NearCell, 9> cells{};
};

/// The terrain window as one frame sees it.
struct TerrainView {
  PostLattice lattice;
  LevelSizes sizes;
  double eye_column = 0, eye_row = 0;           ///< lattice posts
  std::array<PostRect, max_levels> drawable{};  ///< of each level
  NearGround near;                              ///< used where the eye is low
};

/// One block's place in the window.
struct HeldBlock {
  BlockId id;
  BlockFacts facts;
  BlockId asked_id;
  bool held = false, asked = false;
};

/// Which blocks the terrain window holds and which it wants: nested levels round the eye, finest
/// inside. Each level is a rectangle of blocks that follows the eye block by block; of it, the
/// valid part is a rectangle that holds the eye and grows by whole strips. Pure bookkeeping: same
/// calls, same answers.
class TerrainLevels {
 public:
  /// Shape: memory.size() >= levels * blocks(); the caller's, given once at boot.
  TerrainLevels(const LevelSizes& sizes, std::span<HeldBlock> memory);

  /// Moves every level to the eye. Units: lattice posts from the lattice's origin.
  void follow(double eye_column, double eye_row);
  /// The next blocks to build, most urgent first, marked as asked for; how many.
  int next_wanted(std::span<BlockId> wanted);
  /// Takes a built block. False when the window has no place for it any more; it then forgets an
  /// older copy as well.
  bool accept(const TerrainBlock& block);
  /// A block that was asked for will not come: it may be wanted again.
  void release(const BlockId& id);
  /// Forgets everything; for another lattice or a fresh start.
  void clear();

  /// Whether every level holds all it should.
  [[nodiscard]] bool complete() const;
  /// The lattice posts whose cells a level can draw: inside its valid part and inside that of every
  /// coarser level.
  [[nodiscard]] PostRect drawable(int level) const;
  [[nodiscard]] const HeldBlock* find(const BlockId& id) const;
  [[nodiscard]] BlockSlot slot(const BlockId& id) const;
  [[nodiscard]] const LevelSizes& sizes() const { return sizes_; }
  /// The lattice posts a level wants to hold.
  [[nodiscard]] PostRect target(int level) const;
  /// Calls use(const HeldBlock&) for every block of the valid part of a level.
  template <typename Use>
  void over_valid(int level, const Use& use) const {
    const Rect& valid = level_[static_cast<std::size_t>(level)].valid;
    for (std::int32_t row = valid.south; row < valid.north; ++row) {
      for (std::int32_t column = valid.west; column < valid.east; ++column) {
        use(place({level, column, row}));
      }
    }
  }

  /// Calls use(const HeldBlock&) for every block held, wherever it stands.
  template <typename Use>
  void over_held(const Use& use) const {
    for (const HeldBlock& block : memory_) {
      if (block.held) use(block);
    }
  }

 private:
  /// In blocks of a level, ends excluded.
  using Rect = PostRect;
  struct Level {
    Rect target, valid;
    double eye_column = 0, eye_row = 0;  ///< in blocks
    bool placed = false;
  };
  struct Strip {
    Rect blocks;
    bool exists = false;
  };

  [[nodiscard]] const HeldBlock& place(const BlockId& id) const;
  [[nodiscard]] HeldBlock& place(const BlockId& id);
  [[nodiscard]] static Strip next_strip(const Level& level, const Rect& from);
  [[nodiscard]] bool holds(int level, const Rect& blocks) const;
  void grow(int level);
  [[nodiscard]] double filled(const Level& level, const Rect& ahead) const;

  LevelSizes sizes_;
  std::span<HeldBlock> memory_;
  std::array<Level, max_levels> level_{};
};

}  // namespace ridgeline
