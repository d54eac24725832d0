#pragma once
#include <array>

#include "core/frame/terrain_keeper.hpp"
#include "core/geo/camera.hpp"

namespace ridgeline {

/// Turns of a ray, by size: what a turn wins over ground that rises towards the ray depends on how
/// far down it looks, and on how far away that ground still is the same.
inline constexpr int turn_sizes = 3;
using TurnRads = std::array<double, turn_sizes>;

/// The turns of a camera that shows so many pixels per radian: up to the pixels all round, up to a
/// few pixels, and the largest of any bound.
TurnRads turn_limits_rad(const Camera& camera);

/// What drawing terrain from surfaces with residuals can cost one frame, by parts of the picture.
struct LevelError {
  static constexpr int columns = 16, rows = 12;
  /// What the blocks behind one part of the picture, grown by their size, can do.
  struct Part {
    /// By what angle a ray must turn, in its vertical plane, to make up for any of the residuals,
    /// if that is a turn of this size.
    TurnRads angle_rad{};
    /// Least share that is left of a turn, by its size; 0: no turn of that size is known to help.
    TurnRads grip{1, 1, 1};
    double steepness = 0;  ///< largest slope of those blocks, and of nearer ground before them
    bool residual = false;

    /// The smallest turn that is large enough; infinite where none is known.
    [[nodiscard]] double turn_rad(const TurnRads& limits, double geometry_rad) const;
  };
  std::array<Part, columns * rows> parts{};
  double angle_px = 0;       ///< the largest error in pixels, each part at its own scale
  double steepest = 0;       ///< largest slope of all ground in view
  double exact_range_m = 0;  ///< nearer than every residual in view, at most the next
  double known_range_m = 0;  ///< nearer than every block that must not be drawn, at most the range
  /// The same, and nearer than all ground behind the nearest residual that faces the eye so steeply
  /// that no turn can make up for one.
  double clear_range_m = 0;
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

/// Ground that a ray meets: bounds on how far it is, on how far down the ray looks, on its slope
/// within `ring_m` round it, and on how far the surface drawn there is off.
struct SlantedGround {
  double away_m = 0, far_m = 0;
  double down_rad = 0;
  double steepness = 0, ring_m = 0;
  double residual_m = 0;
};
/// By what angle a ray must turn in its vertical plane to make up for the residual, so that it
/// meets the truth neither nearer nor farther than the contract lets go along the ray.
/// Source: docs/error_bound.md, section 5.
struct SlantedTurn {
  bool possible = true;
  TurnRads angle_rad{};
  TurnRads grip{1, 1, 1};
};
SlantedTurn slanted_turn(const SlantedGround& ground, const TurnRads& limits);

}  // namespace ridgeline
