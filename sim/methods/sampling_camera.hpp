#pragma once
#include "core/frame/frame_pipeline.hpp"

namespace ridgeline::sim {

/// Where the base plane of a persistent grid lies and what may stand on it. Heights in m over the
/// ellipsoid.
struct BasePlane {
  double height_m = 0;
  double ground_m = 0;                 ///< of the ground under the eye
  double lowest_m = 0, highest_m = 0;  ///< of the terrain
  double range_m = 0;                  ///< how far the grid has to reach
};

/// The camera through which a persistent grid is laid on the base plane: rays, in ENU, of grid
/// vertex (i, j) are corner + i across + j down. Where one meets the plane beyond the range, or (in
/// a corner of the grid that no ground in the picture needs) not at all, its vertex stands at the
/// end of the range in the ray's azimuth.
struct SamplingCamera {
  glm::dvec3 corner{}, across{}, down{};
  double depth_m = 0;      ///< of the base plane under the eye
  bool auxiliary = false;  ///< not the camera of the picture
  bool empty = true;       ///< the picture shows no ground that the grid could reach
};

/// The sampling camera for one frame.
///
/// The camera of the picture samples, as long as each of its rays meets the base plane within the
/// range; else an auxiliary one with the same heading and field of view, no roll, that looks so far
/// down that its upper edge meets the plane at the range. Of its image the grid covers the part
/// that ground in the picture can need: a terrain point stands on the base point of its azimuth and
/// ground distance, so from rays all over the picture follow the base points of all terrain
/// between `lowest_m` and `highest_m`, and of ground that rises from under the eye at most at 0.6.
/// Domain: columns, rows >= 2; eye over the ground.
SamplingCamera sampling_camera(const Camera& camera, double eye_height_m, const BasePlane& base,
                               int columns, int rows);

}  // namespace ridgeline::sim
