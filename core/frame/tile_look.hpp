#pragma once
#include <numbers>

#include "core/geo/camera.hpp"
#include "core/render/ray_tile.hpp"

namespace ridgeline {

inline constexpr int way_bins = 256;  ///< of directions, up to their sign
inline constexpr double way_bin_rad = std::numbers::pi / way_bins;

/// How the picture of a tile lies to the vertical: bounds that hold at each of its points.
struct TileLook {
  bool known = false;    ///< not where the vertical itself is near, nor over wide turns
  double down_rad = -1;  ///< largest angle looked down, there and as far as the range
  double stretch = 0;    ///< largest ratio of pixels per radian along and across
  double skew = 0;       ///< largest, see Upright
  double more = 1;       ///< what is needed inside against what is at the points looked at
  int first_bin = 0, last_bin = 0;  ///< of the direction of the vertical; may run over the ends
};

/// `grown_px`: a vertical so near to the tile counts as within.
TileLook tile_look(const Camera& camera, const RayTile& tile, double grown_px, double range_m);

/// What slope in the picture a block must bear, pixels up the vertical by pixels across, so that
/// over ground no steeper than `steepness` a ray above another stays above its ground; infinite
/// where none is enough.
/// Source: docs/error_bound.md, section 8.
double needed_steepness(const TileLook& look, double steepness);

}  // namespace ridgeline
