#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/frame/terrain_keeper.hpp"
#include "core/frame/tile_look.hpp"
#include "core/geo/camera.hpp"
#include "core/render/ray_tile.hpp"

namespace ridgeline {

/// What one ray for several pixels may cost, and what ground allows it.
struct RaySharing {
  double range_m = 0;
  double slack_px = 0;       ///< of the promised bound, left by everything else
  double bound_px = 0;       ///< promised
  double geometry_px = 0;    ///< what rounding can move a ray by
  bool every_pixel = false;  ///< each has a ray, sky or not
  bool may_be_cut = false;   ///< rays for every pixel may take the place of what is below a row
};

inline constexpr std::size_t block_shapes = 8;  ///< that the plan knows

/// What slopes blocks of one shape bear beside blocks of another, by the direction of the vertical
/// in the picture; negative: not asked for yet. Kept from frame to frame, as it depends on two
/// numbers only.
struct BlockBearing {
  double reach_px = -1, loss_px = -1;
  std::array<float, block_shapes * block_shapes * way_bins> steepest{};
};

/// Memory of the plan. Shape: most_tiles(width) * most_tiles(height) of each span.
struct RayTileTables {
  std::span<RayTile> tiles;
  std::span<float> steepness;
  std::span<std::uint8_t> shapes;
  std::span<TileLook> looks;
  BlockBearing* bearing = nullptr;
};

struct RayTilePlan {
  int tiles = 0;
  int ground_tiles = 0;  ///< the first so many; behind them are those where only sky can show
  int rays = 0;          ///< of all tiles
  double shared_px = 0;  ///< largest distance of a pixel from its ray
};

/// Where a plan begins that takes over from another one: below the tiles that are drawn already.
struct TileCut {
  int kept_rows = 0;  ///< of tiles, above the cut
  int from_px = 0;    ///< first row of pixels below it
};

/// The least border of a part below a cut: with it no cut needs more tiles than a whole picture.
inline constexpr int cut_ring_px = 15;

/// Cuts the picture into tiles and gives each the largest block of pixels that one ray may stand
/// for: near enough to every one of them for the promise, and so that nothing that a pixel truly
/// sees is left out of the pixels round it.
/// Ground that is drawn with a residual, or beside unknown ground, has a ray for every pixel; a
/// tile where no ground can show has one ray, as all of it is sky.
/// Result: tables.tiles is filled; with a cut, with the tiles below it, which have a border along
///         it.
/// Cost:   O(blocks of the window + tiles); no allocation.
/// Source: docs/error_bound.md, section 8.
RayTilePlan plan_ray_tiles(const TerrainKeeper& terrain, const LocalFrame& local,
                           const Camera& camera, const RaySharing& sharing,
                           const RayTileTables& tables, const TileCut& cut = {});

}  // namespace ridgeline
