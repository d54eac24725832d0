#include "sim/methods/footprint_view.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::sim {
namespace {

constexpr double smallest_radius_m = 6.33e6;  ///< of curvature of the ellipsoid
constexpr double deg = 0.017453292519943295;
constexpr double farthest_ranges = 3.0;  ///< that a footprint of the coarsest level reaches

}  // namespace

FootprintView::FootprintView(const RangeScene& scene, double lowest_m, double highest_m)
    : lattice_(scene.view.lattice),
      lowest_m_(lowest_m),
      highest_m_(highest_m),
      range_m_(scene.report.range_m) {
  const Camera& camera = scene.report.camera;
  const LocalFrame& local = scene.report.local;
  // Parallels bend by the tangent of their latitude; the lines of a polar chart less than circles.
  const double farthest_deg = std::min(
      std::abs(local.eye.latitude_deg) + farthest_ranges * range_m_ / smallest_radius_m / deg,
      89.0);
  bend_ = 1.0 + (lattice_.polar() ? 1.0 : std::tan(farthest_deg * deg));
  camera_from_ecef_ = glm::transpose((local.ecef_from_enu * camera.enu_from_camera).columns);
  eye_ecef_ = local.eye_ecef.xyz;
  const double left = camera.cx + 0.5, right = camera.width_px - camera.cx + 0.5;
  const double top = camera.cy + 0.5, bottom = camera.height_px - camera.cy + 0.5;
  inward_ = {glm::normalize(glm::dvec3(camera.fx, 0, left)),
             glm::normalize(glm::dvec3(-camera.fx, 0, right)),
             glm::normalize(glm::dvec3(0, camera.fy, top)),
             glm::normalize(glm::dvec3(0, -camera.fy, bottom)), glm::dvec3(0, 0, 1)};
}

glm::dvec3 FootprintView::seen(double column, double row, double height_m) const {
  const GroundPlace place = lattice_.place_of(column, row);
  const Vec3<Ecef> point = ecef_from_geodetic({place.latitude_deg, place.longitude_deg, height_m});
  return camera_from_ecef_ * (point.xyz - eye_ecef_);
}

bool FootprintView::may_show(const Box& box) const {
  std::array<glm::dvec3, 8> corners;
  glm::dvec3 middle(0);
  for (int k = 0; k < 8; ++k) {
    corners[k] = seen((k & 1) != 0 ? box.east : box.west, (k & 2) != 0 ? box.north : box.south,
                      (k & 4) != 0 ? highest_m_ : lowest_m_);
    middle += 0.125 * corners[k];
  }
  double radius_m = 0;
  for (const glm::dvec3& corner : corners) {
    radius_m = std::max(radius_m, glm::length(corner - middle));
  }
  // Between its corners the ground bulges: upwards with the Earth, sideways with its parallels.
  const double bulge_m = bend_ * radius_m * radius_m / (2.0 * smallest_radius_m);
  if (glm::length(middle) - radius_m - bulge_m > range_m_) return false;
  for (const glm::dvec3& inward : inward_) {
    double most_m = -1e12;
    for (const glm::dvec3& corner : corners) most_m = std::max(most_m, glm::dot(inward, corner));
    if (most_m < -bulge_m) return false;
  }
  return true;
}

}  // namespace ridgeline::sim
