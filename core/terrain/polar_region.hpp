#pragma once
#include <span>

#include "core/terrain/post_region.hpp"

namespace ridgeline {

/// Up to where unknown ground is drawn in a polar chart: under what may and over what must be
/// unknown, for every ground of the Earth near its poles.
inline constexpr float polar_floor_m = 8'800.0F;

/// What is known of the finest cells of a box in a polar chart. The cells of the tiles do not lie
/// on those of the lattice, so each lattice cell keeps a range that holds the truth everywhere in
/// it, counted from the plane through the middles of its four sides. Shape:  (box.columns + 1) x
/// (box.rows + 1) cells, row-major: those of the box and one more on
///         every side, which are known or not but have no range.
/// Owner:  views memory of the caller.
struct PolarCells {
  PostBox box;
  std::span<float> low, high;  ///< m

  enum class Kind : std::uint8_t {
    unknown,
    known,
    mixed,  ///< in part, or not as its posts draw it
  };
  [[nodiscard]] int columns() const { return box.columns + 1; }
  [[nodiscard]] int rows() const { return box.rows + 1; }
  /// Cell (x, y) has post (x, y) of the box at its south-west. Domain: -1 <= x < box.columns.
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(columns()) +
           static_cast<std::size_t>(x + 1);
  }
  [[nodiscard]] Kind kind(std::size_t index) const;
};

/// Reads a box in a polar chart. A post is the truth at its place, or where that is unknown the
/// middle of what is known round it; where nothing is, a void post as terrain_block.hpp says. What
/// the posts leave out of the truth is in `cells`. A cell that no tile covers whole is mixed.
/// Result: whether there is a void post.
/// Shape:  posts.size() == rows * columns.
/// Cost:   O(cells of the tiles and of the box, tiles^2). No allocation.
bool read_polar_region(const TerrainSource& source, const PolarCells& cells,
                       std::span<float> posts);

/// How far the truth may be from the bilinear surface of the posts over a square of cells.
struct PolarGap {
  float gap_m = 0;
  bool mixed = false;  ///< some cell is not as known or unknown as it is drawn
};
PolarGap polar_gap(const PolarCells& cells, std::span<const float> posts, int x, int y, int side);

}  // namespace ridgeline
