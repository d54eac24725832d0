#pragma once
#include <array>

#include "core/frame/terrain_keeper.hpp"
#include "core/geo/camera.hpp"

namespace ridgeline {

/// What drawing far terrain from coarser levels can cost one frame, by parts of the picture.
struct LevelError {
  static constexpr int columns = 16, rows = 12;
  /// What the blocks behind one part of the picture, grown by their size, can do.
  struct Part {
    double angle_rad = 0;  ///< largest residual over distance
    double steepness = 0;  ///< largest slope of those blocks
  };
  std::array<Part, columns * rows> parts{};
  double angle_px = 0;       ///< the largest error in pixels, each part at its own scale
  double clear_range_m = 0;  ///< nearer than every block that must not be drawn, at most the range
};

/// The error of the levels as this camera sees them.
/// `clearance_m`: lower bound on the distance to the known surface.
/// Cost: O(blocks of the window), no allocation.
/// Source: docs/error_bound.md, section 5.
LevelError level_error(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       double range_m, double clearance_m);

/// Whether nothing is left out of a picture that promises `epsilon_px` while the surface of its
/// levels is off by `error`, and everything by `geometry_rad` on top: for every pixel another one
/// exists within the promise, so nearly above or below it that the difference covers the error.
/// Source: docs/error_bound.md, section 5.
bool stays_complete(const Camera& camera, double epsilon_px, const LevelError& error,
                    double geometry_rad);

}  // namespace ridgeline
