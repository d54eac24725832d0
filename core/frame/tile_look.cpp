#include "core/frame/tile_look.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/frame/upright.hpp"

namespace ridgeline {
namespace {

constexpr double smallest_radius_m = 6'335'000.0;
constexpr double least_grip = 0.05;
constexpr double widest_turn_rad = 0.8;  ///< of the vertical within a tile

/// Between points of a tile that are looked at, tangents: a small wide picture has tiles so wide
/// that their corners say little of what is between.
constexpr double widest_step = 0.05;
constexpr int most_steps = 24;

/// Directions of the vertical within a tile, up to their sign.
struct Turn {
  double first = 0, least = 0, most = 0;
  bool any = false;

  void add(double angle) {
    if (!any) first = angle;
    any = true;
    const double turned = std::remainder(angle - first, std::numbers::pi);
    least = std::min(least, turned);
    most = std::max(most, turned);
  }
};

/// Takes one point of the tile in; false where the vertical is too near.
bool widen(const Camera& camera, const glm::dvec3& up, const glm::dvec2& point, TileLook& look,
           Turn& turn) {
  const double x = (point.x - camera.cx) / camera.fx;
  const double y = (point.y - camera.cy) / camera.fy;
  const Upright upright = upright_at(camera, x, y);
  if (!(upright.px_per_rad > 0)) return false;
  const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
  look.down_rad = std::max(look.down_rad, std::asin(std::clamp(-glm::dot(ray, up), -1.0, 1.0)));
  look.stretch = std::max(look.stretch, upright.px_per_rad / upright.beside_px_per_rad);
  look.skew = std::max(look.skew, std::abs(upright.skew));
  turn.add(std::atan2(upright.way.y, upright.way.x));
  return true;
}

int steps_over(double px, double px_per_tangent) {
  return std::min(1 + static_cast<int>(px / (px_per_tangent * widest_step)), most_steps);
}

}  // namespace

TileLook tile_look(const Camera& camera, const RayTile& tile, double grown_px, double range_m) {
  const glm::dvec3 up = glm::transpose(camera.enu_from_camera.columns) * glm::dvec3(0, 0, 1);
  const double east = tile.x() + tile.width(), south = tile.y() + tile.height();
  TileLook look;
  Turn turn;
  // The point nearest to where the vertical meets the picture, the corners and what is between.
  if (std::abs(up.z) > 1e-6) {
    const glm::dvec2 foot(camera.cx + camera.fx * up.x / up.z, camera.cy + camera.fy * up.y / up.z);
    if (foot.x > tile.x() - grown_px && foot.x < east + grown_px && foot.y > tile.y() - grown_px &&
        foot.y < south + grown_px) {
      return {};
    }
    const glm::dvec2 nearest(std::clamp(foot.x, 1.0 * tile.x(), east),
                             std::clamp(foot.y, 1.0 * tile.y(), south));
    if (!widen(camera, up, nearest, look, turn)) return {};
  }
  const int across = steps_over(tile.width(), camera.fx);
  const int down = steps_over(tile.height(), camera.fy);
  for (int j = 0; j <= down; ++j) {
    for (int i = 0; i <= across; ++i) {
      const glm::dvec2 point(tile.x() + i * tile.width() / static_cast<double>(across),
                             tile.y() + j * tile.height() / static_cast<double>(down));
      if (!widen(camera, up, point, look, turn)) return {};
    }
  }
  const double turned = turn.most - turn.least;
  if (turned > widest_turn_rad) return {};
  look.known = true;
  look.more = 1.005 + 0.08 * turned * turned;
  look.down_rad += range_m / smallest_radius_m;
  const auto bin = [](double angle) { return static_cast<int>(std::floor(angle / way_bin_rad)); };
  look.first_bin = bin(turn.first + turn.least);
  look.last_bin = bin(turn.first + turn.most);
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
