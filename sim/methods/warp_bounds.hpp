#pragma once
#include <glm/vec4.hpp>
#include <vector>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

inline constexpr int bound_block_posts = 16;  ///< a side; as in warp_importance.comp

/// Bounds on the surface of each block of the finest level, its cells up to the next block's first
/// posts included. Shape: row-major, toroidal as the posts are.
struct SurfaceBounds {
  int columns = 0, rows = 0;
  std::vector<glm::vec4> heights;  ///< lowest, highest (m), mean slope eastwards, northwards
  std::vector<glm::vec4> slopes;   ///< mean of their squares and product; farthest from the mean
};

/// Units: m; slopes in m per post. Unknown posts count at their floors and have no slope.
SurfaceBounds surface_bounds(const MethodTerrain& terrain);

}  // namespace ridgeline::sim
