#include "core/geo/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {
namespace {
constexpr double deg = std::numbers::pi / 180.0;

bool inside(double value, double low, double high) {
  return value >= low && value <= high;
}
}  // namespace

double Camera::half_diagonal_rad(double margin_px) const {
  const double x = (std::max(cx, width_px - cx) + margin_px) / fx;
  const double y = (std::max(cy, height_px - cy) + margin_px) / fy;
  return std::atan(std::hypot(x, y));
}

Result<Camera> camera(const Attitude& attitude, const ImageGeometry& image) {
  if (!inside(attitude.roll_deg, -360, 360) || !inside(attitude.pitch_deg, -90, 90) ||
      !inside(attitude.heading_deg, -720, 720)) {
    return Fault::attitude_out_of_range;
  }
  if (!inside(image.horizontal_field_of_view_deg, limits::min_field_of_view_deg,
              limits::max_field_of_view_deg)) {
    return Fault::field_of_view_out_of_range;
  }
  if (!inside(image.width_px, limits::min_image_px, limits::max_image_px) ||
      !inside(image.height_px, limits::min_image_px, limits::max_image_px)) {
    return Fault::image_size_out_of_range;
  }
  const double psi = attitude.heading_deg * deg, theta = attitude.pitch_deg * deg;
  const double phi = attitude.roll_deg * deg;
  const glm::dvec3 forward(std::sin(psi) * std::cos(theta), std::cos(psi) * std::cos(theta),
                           std::sin(theta));
  const glm::dvec3 level_right(std::cos(psi), -std::sin(psi), 0.0);
  const glm::dvec3 level_down(std::sin(psi) * std::sin(theta), std::cos(psi) * std::sin(theta),
                              -std::cos(theta));
  Camera result;
  result.attitude = attitude;
  result.enu_from_camera.columns =
      glm::dmat3(std::cos(phi) * level_right + std::sin(phi) * level_down,
                 std::cos(phi) * level_down - std::sin(phi) * level_right, forward);
  result.width_px = image.width_px;
  result.height_px = image.height_px;
  result.fx = 0.5 * image.width_px / std::tan(0.5 * image.horizontal_field_of_view_deg * deg);
  result.fy = result.fx;
  result.cx = 0.5 * image.width_px;
  result.cy = 0.5 * image.height_px;
  return result;
}

}  // namespace ridgeline
