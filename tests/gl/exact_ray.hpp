#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "core/render/frame_blocks.hpp"

namespace ridgeline::test {

inline constexpr double rounding_unit = 0x1p-24;  ///< u of float32

/// One frame without terrain: all that the arithmetic of a ray depends on.
struct ProbeFrame {
  LocalFrame local;
  Camera camera;
  GroundMap map;
  PostLattice lattice;
  PolarGrid grid;
  double eye_column = 0, eye_row = 0;
  FrameBlocks blocks;
};

/// Aborts where the pose has no ground map.
ProbeFrame probe_frame(const GeodeticPosition& eye, const Camera& camera, double range_m,
                       double step_deg, Chart chart = Chart::geographic,
                       const PolarGrid& grid = {});

/// A ray of the model that section 3 of docs/error_bound.md draws: the osculating circle, the
/// ground map, the swell; all of it in double, no series cut short.
class ExactRay {
 public:
  /// `direction`: ENU, any length.
  ExactRay(const ProbeFrame& frame, const glm::dvec3& direction);

  struct Place {
    glm::dvec2 posts{};   ///< from the post south-west of the eye
    double height_m = 0;  ///< over the eye
    double ground_m = 0;  ///< g
  };
  [[nodiscard]] Place at(double t_m) const;
  /// Metres east and north of the ray's ground track per post: what a shift in posts is worth.
  [[nodiscard]] glm::dvec2 shift_m(double t_m, const glm::dvec2& posts) const;
  /// Distance at which the ray has passed the ground distance g.
  [[nodiscard]] double distance_at_m(double ground_m) const;

  double azimuth_rad = 0, along = 0, up = 0;

 private:
  [[nodiscard]] glm::dvec2 posts_at(double e, double n) const;
  const ProbeFrame& frame_;
  double radius_m_ = 0, eye_radius_m_ = 0;
};

/// The ray a shader made, from its azimuth (x sin, y cos), along and up.
inline glm::dvec3 direction_of(const glm::vec4& ray) {
  const glm::dvec4 r(ray);
  return {r.z * r.x, r.z * r.y, r.w};
}

}  // namespace ridgeline::test
