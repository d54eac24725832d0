#include "core/frame/tile_look.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/frame/upright.hpp"

namespace ridgeline {
namespace {

constexpr double smallest_radius_m = 6'335'000.0;
constexpr double least_grip = 0.05;
constexpr double widest_turn_rad = 0.8;  ///< of the vertical within a tile

}  // namespace

TileLook tile_look(const Camera& camera, const RayTile& tile, double grown_px, double range_m) {
  const glm::dvec3 up = glm::transpose(camera.enu_from_camera.columns) * glm::dvec3(0, 0, 1);
  // The corners, and the point nearest to where the vertical meets the picture.
  const double east = tile.x() + tile.width(), south = tile.y() + tile.height();
  std::array<glm::dvec2, 5> points{glm::dvec2(tile.x(), tile.y()), glm::dvec2(east, tile.y()),
                                   glm::dvec2(tile.x(), south), glm::dvec2(east, south),
                                   glm::dvec2(tile.x(), tile.y())};
  if (std::abs(up.z) > 1e-6) {
    const glm::dvec2 foot(camera.cx + camera.fx * up.x / up.z, camera.cy + camera.fy * up.y / up.z);
    if (foot.x > tile.x() - grown_px && foot.x < east + grown_px && foot.y > tile.y() - grown_px &&
        foot.y < south + grown_px) {
      return {};
    }
    points[4] = {std::clamp(foot.x, 1.0 * tile.x(), east),
                 std::clamp(foot.y, 1.0 * tile.y(), south)};
  }
  TileLook look;
  double first = 0, least = 0, most = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = (points[k].x - camera.cx) / camera.fx;
    const double y = (points[k].y - camera.cy) / camera.fy;
    const Upright upright = upright_at(camera, x, y);
    if (!(upright.px_per_rad > 0)) return {};
    const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
    look.down_rad = std::max(look.down_rad, std::asin(std::clamp(-glm::dot(ray, up), -1.0, 1.0)));
    look.stretch = std::max(look.stretch, upright.px_per_rad / upright.beside_px_per_rad);
    look.skew = std::max(look.skew, std::abs(upright.skew));
    const double angle = std::atan2(upright.way.y, upright.way.x);
    if (k == 0) first = angle;
    const double turned = std::remainder(angle - first, std::numbers::pi);
    least = std::min(least, turned);
    most = std::max(most, turned);
  }
  if (most - least > widest_turn_rad) return {};
  look.known = true;
  const double turn = most - least;
  look.more = 1.005 + 0.08 * turn * turn;
  look.down_rad += range_m / smallest_radius_m;
  const auto bin = [](double angle) { return static_cast<int>(std::floor(angle / way_bin_rad)); };
  look.first_bin = bin(first + least);
  look.last_bin = bin(first + most);
  return look;
}

double needed_steepness(const TileLook& look, double steepness) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!look.known) return infinite;
  const double down_rad = std::max(look.down_rad, 0.0);
  const double sine = std::sin(down_rad), cosine = std::cos(down_rad);
  if (cosine - steepness * sine < least_grip) return infinite;
  const double across =
      steepness / std::sqrt(cosine * cosine - steepness * steepness * sine * sine);
  return look.more * (across * look.stretch + look.skew);
}

}  // namespace ridgeline
