#include "core/frame/level_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double view_margin_rad = 0.09;  ///< the disc of the largest bound, and block corners
constexpr double smallest_radius_m = 6'335'000.0;
constexpr double chord_share = 0.99;  ///< of a distance in latitude and longitude, at 200 km
constexpr double neighbour_px = 0.7071;
constexpr double farthest_neighbour_px = 4.0;
constexpr int places = 7;  ///< a side, in the picture

/// Lower bound on the distance from the eye to everything outside a rectangle of posts.
double distance_out_m(const TerrainView& view, const PostRect& rect, double latitude_deg) {
  if (rect.empty()) return 0.0;
  const double north_deg =
      std::min(view.eye_row - rect.south, rect.north - view.eye_row) * view.lattice.latitude_step_deg;
  const double east_deg = std::min(view.eye_column - rect.west, rect.east - view.eye_column) *
                          view.lattice.longitude_step_deg;
  const double narrow = std::cos(std::min(std::abs(latitude_deg) + std::abs(north_deg), 90.0) *
                                 rad_per_deg);
  const double arc = std::min(north_deg, east_deg * std::max(narrow, 0.0)) * rad_per_deg;
  return std::max(0.0, chord_share * smallest_radius_m * arc);
}

bool inside(const BlockId& id, const PostRect& rect) {
  const std::int32_t span = block_posts << id.level;
  return id.column * span >= rect.west && id.row * span >= rect.south &&
         (id.column + 1) * span <= rect.east && (id.row + 1) * span <= rect.north;
}

/// How a block lies in the picture.
struct Sight {
  double distance_m = 0;  ///< lower bound
  bool seen = false;
  double px_per_rad = 0;  ///< largest scale it is seen at
};

Sight sight_of(const BlockFacts& facts, const LocalFrame& local, const Camera& camera,
               double half_diagonal_rad) {
  const Vec3<Enu> way = local.ecef_from_enu.inverse() * (facts.centre - local.eye_ecef);
  const double centre_m = glm::length(way.xyz);
  Sight sight;
  sight.distance_m = std::max({centre_m - facts.radius_m, 0.0,
                               local.eye.height_m - static_cast<double>(facts.highest_m)});
  const double spread =
      centre_m > facts.radius_m ? std::asin(facts.radius_m / centre_m) : std::numbers::pi;
  const double cosine = glm::dot(camera.enu_from_camera.columns[2], way.xyz) / std::max(centre_m, 1.0);
  const double off_axis = std::acos(std::clamp(cosine, -1.0, 1.0));
  sight.seen = off_axis - spread <= half_diagonal_rad + view_margin_rad;
  const double widest = std::cos(std::min(off_axis + spread, half_diagonal_rad));
  sight.px_per_rad = std::max(camera.fx, camera.fy) / (widest * widest);
  return sight;
}

}  // namespace

LevelError level_error(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       double range_m, double clearance_m) {
  const TerrainView view = terrain.view();
  const double half_diagonal_rad = camera.half_diagonal_rad(0.0);
  LevelError error;
  error.clear_range_m = range_m;
  for (int level = 0; level < view.sizes.levels; ++level) {
    const PostRect finer =
        level > 0 ? view.drawable[static_cast<std::size_t>(level - 1)] : PostRect{};
    const double inner_m = distance_out_m(view, finer, local.eye.latitude_deg);
    terrain.levels().over_valid(level, [&](const HeldBlock& block) {
      const BlockFacts& facts = block.facts;
      if (!(facts.residual_m > 0) && !facts.mixed) return;
      if (level > 0 && inside(block.id, finer)) return;
      const Sight sight = sight_of(facts, local, camera, half_diagonal_rad);
      const double distance_m = std::max({sight.distance_m, inner_m, clearance_m, 0.05});
      if (distance_m > range_m) return;
      if (facts.mixed) {
        error.clear_range_m = std::min(error.clear_range_m, chord_share * distance_m);
        return;
      }
      if (!sight.seen) return;
      const double angle = static_cast<double>(facts.residual_m) / distance_m;
      error.angle_rad = std::max(error.angle_rad, angle);
      error.angle_px = std::max(error.angle_px, angle * sight.px_per_rad);
      error.steepness = std::max(error.steepness, static_cast<double>(facts.steepness));
    });
  }
  return error;
}

bool stays_complete(const Camera& camera, double epsilon_px, double angle_rad, double steepness) {
  if (angle_rad <= 0) return true;
  const double reach = std::min(epsilon_px + neighbour_px, farthest_neighbour_px);
  const int whole = static_cast<int>(reach);
  const glm::dvec3 up = glm::transpose(camera.enu_from_camera.columns) * glm::dvec3(0, 0, 1);
  for (int k = 0; k < places * places; ++k) {
    const double x = (camera.width_px * (k % places) / (places - 1.0) - camera.cx) / camera.fx;
    const double y = (camera.height_px * (k / places) / (places - 1.0) - camera.cy) / camera.fy;
    // How the picture moves when a ray moves within its vertical plane.
    const glm::dvec2 along(camera.fx * (up.x - x * up.z), camera.fy * (up.y - y * up.z));
    const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
    const double upright = glm::length(up - glm::dot(up, ray) * ray);
    const double px = glm::length(along);
    if (upright < 0.2 || px < 1e-6) continue;  // within 12 degrees of straight up or down
    const double px_per_rad = px * std::sqrt(1.0 + x * x + y * y) / upright;
    double best = 0;
    for (int j = -whole; j <= whole; ++j) {
      for (int i = -whole; i <= whole; ++i) {
        if (std::hypot(i, j) > reach) continue;
        const double above = (i * along.x + j * along.y) / px;
        const double beside = std::abs(i * along.y - j * along.x) / px;
        best = std::max(best, 0.99 * above / px_per_rad -
                                  steepness * beside / std::min(camera.fx, camera.fy));
      }
    }
    if (best < angle_rad) return false;
  }
  return true;
}

}  // namespace ridgeline
