#pragma once
#include <array>
#include <span>

#include "core/terrain/post_region.hpp"

namespace ridgeline {

/// Gives every void post of a region its floor: stores floor - void_offset_m instead of NaN.
/// The rule is at void_offset_m (core/terrain/terrain_block.hpp); it depends on the place alone,
/// not on the region or its level.
/// `region`: row-major posts of `box`.
/// Cost: O(posts) and the reading of up to 25 squares of 64 x 64 posts for each square with a void.
///       No allocation.
void put_floors(const TerrainSource& source, const PostBox& box, double far_floor_m,
                std::span<float> region);

}  // namespace ridgeline
