#include "sim/methods/sampling_camera.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::sim {
namespace {

constexpr double steepest_rise = 0.6;      ///< of ground in front, from under the eye
constexpr double least_clearance_m = 5.0;  ///< of the eye over the ground, as far as the grid goes
constexpr double least_axial = 0.17;       ///< cosine of the largest angle off the sampling axis
constexpr double margin = 0.01;            ///< of the covered part, to each side
constexpr double past_range = 1.002;       ///< the last row stands a little beyond it
constexpr int ray_steps = 24;              ///< rays looked at along each side of the picture

struct Window {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};

/// Right, down and forward of a camera without roll.
glm::dmat3 level_axes(double heading_rad, double pitch_rad) {
  const double s = std::sin(heading_rad), c = std::cos(heading_rad);
  const double sp = std::sin(pitch_rad), cp = std::cos(pitch_rad);
  return {{c, -s, 0}, {s * sp, c * sp, -cp}, {s * cp, c * cp, sp}};
}

/// Slopes (over one metre of ground) of the first and last base point under what a ray can see.
struct Slopes {
  double high = 0, low = 0;
  bool seen = false;
};

Slopes base_slopes(double slope, double eye_height_m, const BasePlane& base, double depth_m) {
  const double far_slope = -depth_m / (past_range * base.range_m);
  const double clearance_m = std::max(eye_height_m - base.ground_m, least_clearance_m);
  const double above_lowest_m = std::max(eye_height_m - base.lowest_m, depth_m);
  Slopes result;
  result.seen = slope < steepest_rise;
  result.high = std::min(far_slope, slope < 0 ? slope * depth_m / above_lowest_m : far_slope);
  double nearest_m = clearance_m / std::max(steepest_rise - slope, 1e-9);
  if (slope < 0) nearest_m = std::max(nearest_m, (eye_height_m - base.highest_m) / -slope);
  result.low = std::min(result.high, -depth_m / nearest_m);
  return result;
}

void take_in(Window& window, const glm::dmat3& axes, const glm::dvec3& ray) {
  glm::dvec3 seen = glm::transpose(axes) * (ray / glm::length(ray));
  seen.z = std::max(seen.z, least_axial);
  window.left = std::min(window.left, seen.x / seen.z);
  window.right = std::max(window.right, seen.x / seen.z);
  window.top = std::min(window.top, seen.y / seen.z);
  window.bottom = std::max(window.bottom, seen.y / seen.z);
}

/// Calls use(ray) for rays all over the picture, its edges included.
template <typename Use>
void over_picture(const Camera& camera, const Use& use) {
  for (int row = 0; row <= ray_steps; ++row) {
    for (int column = 0; column <= ray_steps; ++column) {
      use(camera
              .ray(camera.width_px * static_cast<double>(column) / ray_steps,
                   camera.height_px * static_cast<double>(row) / ray_steps)
              .xyz);
    }
  }
}

Window covered(const Camera& camera, const glm::dmat3& axes, double eye_height_m,
               const BasePlane& base, double depth_m) {
  constexpr double plumb = 1e-9;
  Window window;
  over_picture(camera, [&](const glm::dvec3& ray) {
    const double along = std::max(std::hypot(ray.x, ray.y), plumb);
    const Slopes slopes = base_slopes(ray.z / along, eye_height_m, base, depth_m);
    if (!slopes.seen) return;
    take_in(window, axes, {ray.x, ray.y, along * slopes.high});
    take_in(window, axes, {ray.x, ray.y, along * slopes.low});
  });
  return window;
}

}  // namespace

SamplingCamera sampling_camera(const Camera& camera, double eye_height_m, const BasePlane& base,
                               int columns, int rows) {
  SamplingCamera result;
  result.depth_m = eye_height_m - base.height_m;
  const double far_slope = -result.depth_m / (past_range * base.range_m);
  bool meets = true;
  over_picture(camera, [&](const glm::dvec3& ray) {
    meets = meets && ray.z <= far_slope * std::hypot(ray.x, ray.y);
  });
  glm::dmat3 axes = camera.enu_from_camera.columns;
  if (!meets) {
    result.auxiliary = true;
    constexpr double deg = 0.017453292519943295;
    const double half_rad = std::atan(camera.cy / camera.fy);
    const double pitch_rad =
        std::min(camera.attitude.pitch_deg * deg, std::atan(far_slope) - half_rad);
    axes = level_axes(camera.attitude.heading_deg * deg, std::max(pitch_rad, -90.0 * deg));
  }
  Window window = covered(camera, axes, eye_height_m, base, result.depth_m);
  if (!(window.right > window.left && window.bottom > window.top)) return result;
  result.empty = false;
  const double x = margin * (window.right - window.left);
  const double y = margin * (window.bottom - window.top);
  window = {window.left - x, window.right + x, window.top, window.bottom + y};
  result.corner = axes[2] + window.left * axes[0] + window.top * axes[1];
  result.across = axes[0] * ((window.right - window.left) / (columns - 1));
  result.down = axes[1] * ((window.bottom - window.top) / (rows - 1));
  return result;
}

}  // namespace ridgeline::sim
