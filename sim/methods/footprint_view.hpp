#pragma once
#include <array>

#include "core/frame/frame_pipeline.hpp"

namespace ridgeline::sim {

/// Whether rectangles of ground may be in the picture of a frame: view frustum culling.
class FootprintView {
 public:
  /// Lattice posts.
  struct Box {
    double west = 0, south = 0, east = 0, north = 0;
  };

  /// `lowest_m`, `highest_m`: between which all ground stands, m over the ellipsoid.
  FootprintView(const RangeScene& scene, double lowest_m, double highest_m);

  /// False only where no point over the box between those heights is inside the picture (grown by
  /// half a pixel) and within the range. Cost: eight geodetic conversions; no allocation.
  [[nodiscard]] bool may_show(const Box& box) const;

 private:
  [[nodiscard]] glm::dvec3 seen(double column, double row, double height_m) const;

  PostLattice lattice_;
  glm::dmat3 camera_from_ecef_{};
  glm::dvec3 eye_ecef_{};
  std::array<glm::dvec3, 5> inward_{};  ///< of the frustum's planes, unit normals, camera axes
  double lowest_m_, highest_m_, range_m_;
  double bend_ = 0;  ///< of the ground between corners, in curvatures of the Earth
};

}  // namespace ridgeline::sim
