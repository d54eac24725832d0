#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// What one texel of a relief pyramid says of its block of posts. Heights over the ellipsoid, m.
struct Relief {
  float average_m = 0, lowest_m = 0, highest_m = 0;  ///< of known posts; of floors where none is
  float known_posts = 0;                             ///< 0: all of the block is unknown
};

/// Average, minimum and maximum of aligned blocks of 2^level x 2^level posts, level 1 upwards, over
/// the part of the finest window level that can be drawn. Texel (0, 0) of every level begins at the
/// south-west post; what is left over at the north and east goes into the last texel.
/// A plain mip chain, as the projected-grid papers use it: it knows posts, not the cells between
/// two blocks, so it bounds no surface (hole L3 of docs/evidence/published_holes.md).
struct ReliefPyramid {
  struct Level {
    int columns = 0, rows = 0;
    std::vector<Relief> texels;  ///< row-major from the south-west
  };
  std::int32_t west = 0, south = 0;  ///< lattice post of texel (0, 0)
  std::vector<Level> levels;         ///< levels[k] is level k + 1
  std::int64_t void_posts = 0;       ///< of all it was built from

  /// The texel of a level (1 upwards) that holds a lattice post; the nearest one beyond the edge.
  [[nodiscard]] const Relief& at(int level, std::int32_t column, std::int32_t row) const;
  [[nodiscard]] std::size_t bytes() const;
};

/// Builds it anew. Cost: 5 ns a post and less; memory is kept from call to call.
void build_relief(const MethodTerrain& terrain, ReliefPyramid& pyramid);

}  // namespace ridgeline::sim
