#pragma once
#include <glm/vec2.hpp>

#include "core/render/ray_tile.hpp"

namespace ridgeline {

/// Blocks of a tile, and those of the tiles beside it.
struct BlockPair {
  BlockShape own, other;
  bool one_lattice = false;  ///< those beside go on where these end
};

/// What the picture asks of blocks.
struct WitnessLimits {
  double reach_px = 0;  ///< of completeness
  double loss_px = 0;   ///< what rounding moves
  double turn_rad = 0;  ///< the vertical may point up to so far beside `way`
};

/// The largest slope in the picture, up by across, for which blocks lose nothing where the vertical
/// has the direction `way`, a unit vector; 0 where none will do.
double steepest_for_block(const BlockPair& blocks, const glm::dvec2& way,
                          const WitnessLimits& limits);

}  // namespace ridgeline
