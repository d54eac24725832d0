#pragma once
#include <glm/vec2.hpp>

#include "core/render/ray_tile.hpp"

namespace ridgeline {

/// The largest slope of ground, over the share of a turn that it leaves, for which blocks of a
/// shape lose nothing where the vertical of the picture has a direction; 0 where no ground will do.
/// `other`: of blocks in the tiles beside. `way`: unit vector in the picture. `reach_px`: of
/// completeness. `loss_px`: what rounding moves.
double steepest_for_block(const BlockShape& shape, const BlockShape& other, const glm::dvec2& way,
                          double reach_px, double loss_px, bool one_lattice);

}  // namespace ridgeline
