#pragma once
#include <array>
#include <glm/vec2.hpp>

#include "sim/methods/relief_pyramid.hpp"

namespace ridgeline::sim {

/// The ground that a picture may show: for rays round its border, the ground point under the ray
/// where it may first meet terrain and the one where it must have.
///
/// Source: the paper only says that the field of view of the grid is increased. This is the usual
///         way to do it (the volume between lowest and highest terrain, seen by the camera, dropped
///         onto the base plane), with the near end taken from the relief pyramid instead of the
///         highest terrain anywhere, which an eye in the mountains is below.
/// Hole L7: rays between the sampled ones may see nearer ground, so the grid is still not proven to
///         reach all that is visible; `near_share` is a margin, not a bound.
class Footprint {
 public:
  static constexpr int samples_a_side = 16;
  static constexpr int points = 2 * 4 * samples_a_side;

  /// Units: m, E and N of the frame's ground map, none farther than the range.
  void look(const RangeScene& scene, const ReliefPyramid& relief, double lowest_m);
  [[nodiscard]] const std::array<glm::dvec2, points>& ground() const { return ground_; }

 private:
  std::array<glm::dvec2, points> ground_{};
};

}  // namespace ridgeline::sim
