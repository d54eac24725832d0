#include "core/frame/upright.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace ridgeline {
namespace {

constexpr double near_vertical = 0.2;  ///< sine of the angle to straight up or down

}  // namespace

Upright upright_at(const Camera& camera, double x, double y) {
  const glm::dvec3 up = glm::transpose(camera.enu_from_camera.columns) * glm::dvec3(0, 0, 1);
  const glm::dvec2 along(camera.fx * (up.x - x * up.z), camera.fy * (up.y - y * up.z));
  const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
  const double sine = glm::length(up - glm::dot(up, ray) * ray);
  const double px = glm::length(along);
  if (sine < near_vertical || px < 1e-6) return {};
  const glm::dvec2 way = along / px;
  // Turned about the vertical by one radian, over the cosine of its elevation.
  const glm::dvec3 turned = glm::cross(up, ray) / sine;
  const glm::dvec2 beside(camera.fx * (turned.x - x * turned.z) / ray.z,
                          camera.fy * (turned.y - y * turned.z) / ray.z);
  const double square = std::abs(beside.x * way.y - beside.y * way.x);
  return {way, px * std::sqrt(1.0 + x * x + y * y) / sine, square, glm::dot(beside, way) / square};
}

}  // namespace ridgeline
