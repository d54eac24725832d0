#pragma once
#include <limits>
#include <span>

#include "core/frame/terrain_keeper.hpp"
#include "core/geo/camera.hpp"
#include "core/render/ray_tile.hpp"

namespace ridgeline {

/// Steepness of ground over which no pixel may do without its own ray.
inline constexpr float any_steepness = std::numeric_limits<float>::infinity();
/// Ground up to here counts as so steep everywhere, and is not looked for.
inline constexpr float gentle_steepness = 0.05F;
/// Of a tile where no ground shows at all, known or not: all of it is sky.
inline constexpr float no_ground = -1.0F;

/// What is looked at, and by how much tiles are grown.
struct SteepGroundLimits {
  double range_m = 0;
  double margin_px = 0;
};

/// How steep the ground behind each tile may be. Shape of `steepness`: down.count() rows of
/// across.count() tiles.
struct TileSteepness {
  TileAxis across, down;
  std::span<float> steepness;
};

/// Puts the largest slope of all known ground that shows in each tile of the picture, hidden or
/// not: 0 where all is gentle, any_steepness where some is drawn with a residual or lies beside
/// unknown ground, no_ground where none shows.
/// Domain: blocks cover the range; not a polar chart.
/// Cost:   O(parts of the window's blocks in view); no allocation.
/// Source: docs/error_bound.md, section 8.
void mark_steep_ground(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       const SteepGroundLimits& limits, const TileSteepness& tiles);

}  // namespace ridgeline
