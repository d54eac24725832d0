#pragma once

#include "core/frame/terrain_keeper.hpp"
#include "core/geo/camera.hpp"

namespace ridgeline {

/// What drawing far terrain from coarser levels can cost one frame.
struct LevelError {
  /// Largest angle by which the surface of a block that the picture may show can be off, rad: the
  /// block's residual over its distance.
  double angle_rad = 0;
  double angle_px = 0;    ///< the same in pixels, each block at the scale it is seen at
  double steepness = 0;   ///< largest slope of those blocks
  double clear_range_m = 0;  ///< nearer than every block that must not be drawn, at most the range
};

/// The error of the levels as this camera sees them.
/// `clearance_m`: lower bound on the distance to the known surface.
/// Cost: O(blocks of the window), no allocation.
/// Source: docs/error_bound.md, section 5.
LevelError level_error(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       double range_m, double clearance_m);

/// Whether nothing is left out of a picture that promises `epsilon_px` while its surface is off by at
/// most `angle_rad` where slopes are at most `steepness`: for every pixel another one exists within
/// the promise, so nearly above or below it that the difference covers the error.
/// Source: docs/error_bound.md, section 5.
bool stays_complete(const Camera& camera, double epsilon_px, double angle_rad, double steepness);

}  // namespace ridgeline
