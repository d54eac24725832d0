#pragma once
#include <glm/vec2.hpp>

#include "core/geo/camera.hpp"

namespace ridgeline {

/// How the picture moves at an image point when a ray turns within its vertical plane.
struct Upright {
  glm::dvec2 way{0.0};    ///< direction in the picture, of length 1
  double px_per_rad = 0;  ///< 0 where planes converge
  /// How it moves when a ray turns sideways at its elevation: square to `way` by so many pixels a
  /// radian, and along it by `skew` times as much: away from the axis lines of equal elevation are
  /// not square to the vertical.
  double beside_px_per_rad = 0, skew = 0;
};

/// At the image point with tangents x to the right and y down.
Upright upright_at(const Camera& camera, double x, double y);

}  // namespace ridgeline
