#pragma once
#include <span>

#include "core/terrain/terrain_block.hpp"

namespace ridgeline {

/// Square of posts, row-major from the south-west, and how far apart they are.
struct PostSquare {
  std::span<const float> posts;
  int side = 0;
  bool with_voids = false;
  float per_east = 0, per_north = 0;  ///< one over the distance of two posts, 1/m
};

/// Cells of such a square: the first, and how many a side.
struct CellSquare {
  int x0 = 0, y0 = 0, side = 0;
};

/// Largest slope of the known cells, none too small.
[[nodiscard]] float steepest_slope(const PostSquare& fine, const CellSquare& cells);

/// The known cells and their posts.
[[nodiscard]] GroundPart ground_part(const PostSquare& fine, const CellSquare& cells);

}  // namespace ridgeline
