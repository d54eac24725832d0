#include "sim/methods/loffler_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ridgeline::sim {
namespace {

constexpr double near_share = 0.8;  ///< of the first ground a border ray may meet
constexpr double nearest_m = 20.0;  ///< the grid begins no nearer to the eye
constexpr int most_steps = 2000;    ///< of one border ray
constexpr double rad_per_deg = std::numbers::pi / 180.0;

/// Follows rays over the relief on a sphere: enough to choose a field of view.
struct Walker {
  const RangeScene& scene;
  const ReliefPyramid& relief;
  double lowest_m;
  double post_m = 0;  ///< smaller side of a post
  Turn turn;

  Walker(const RangeScene& s, const ReliefPyramid& r, double lowest)
      : scene(s), relief(r), lowest_m(lowest), turn(turn_of(s.map.chart, s.report.local.eye)) {
    const PostLattice& lattice = s.view.lattice;
    const LocalFrame& local = s.report.local;
    const double shrink = lattice.polar() ? 1.0 : std::cos(local.eye.latitude_deg * rad_per_deg);
    post_m = rad_per_deg * local.meridian_radius_m *
             std::min(lattice.latitude_step_deg, lattice.longitude_step_deg * shrink);
  }

  /// Height of a ray over the ellipsoid at ground distance g. `rise`: its slope at the eye.
  [[nodiscard]] double height_m(double g, double rise) const {
    return scene.report.local.eye.height_m + g * rise +
           0.5 * g * g * scene.map.inverse_meridian_radius;
  }

  /// Highest terrain within one node of a level round a ground point.
  [[nodiscard]] double highest_m(int level, glm::dvec2 ground) const {
    const double scale = 1.0 / scene.map.range_m;
    const ChartPoint way = scene.map.offset(ground.x * scale, ground.y * scale);
    const double x = way.east_deg / scene.view.lattice.longitude_step_deg;
    const double y = way.north_deg / scene.view.lattice.latitude_step_deg;
    const double east = scene.view.eye_column + turn.cosine * x - turn.sine * y;
    const double north = scene.view.eye_row + turn.sine * x + turn.cosine * y;
    const auto column = static_cast<std::int32_t>(std::floor(east));
    const auto row = static_cast<std::int32_t>(std::floor(north));
    double highest = -1e9;
    const std::int32_t side = 1 << level;
    for (const std::int32_t r : {row - side, row, row + side}) {
      for (const std::int32_t c : {column - side, column, column + side}) {
        highest = std::max<double>(highest, relief.at(level, c, r).highest_m);
      }
    }
    return highest;
  }

  /// Ground distance up to which a ray meets nothing; the range where it meets nothing at all.
  [[nodiscard]] double clear_m(glm::dvec2 azimuth, double rise) const {
    const double range = scene.map.range_m;
    if (relief.levels.empty()) return range;
    const int top = static_cast<int>(relief.levels.size());
    double g = 0;
    int level = 1;
    for (int step = 0; step < most_steps && g < range; ++step) {
      const double length = post_m * (1 << level);
      const double lowest = std::min(height_m(g, rise), height_m(g + length, rise));
      if (lowest > highest_m(level, g * azimuth)) {
        g += length;
        level = std::min(level + 1, top);
      } else if (level > 1) {
        --level;
      } else {
        return g;
      }
    }
    return std::min(g, range);
  }

  /// Ground distance at which a ray has certainly met the ground.
  [[nodiscard]] double buried_m(double rise) const {
    const double range = scene.map.range_m, over = scene.report.local.eye.height_m - lowest_m;
    const double bend = 2.0 * over * scene.map.inverse_meridian_radius;
    const double root = rise * rise - bend;  // g rise + g² / 2R = -over
    if (rise >= 0 || root <= 0) return range;
    return std::min(range, 2.0 * over / (std::sqrt(root) - rise));
  }
};

}  // namespace

void Footprint::look(const RangeScene& scene, const ReliefPyramid& relief, double lowest_m) {
  const Camera& camera = scene.report.camera;
  const Walker walker(scene, relief, lowest_m);
  const double w = camera.width_px, h = camera.height_px;
  std::size_t out = 0;
  for (int side = 0; side < 4; ++side) {
    for (int k = 0; k < samples_a_side; ++k) {
      const double part = static_cast<double>(k) / samples_a_side;
      const glm::dvec2 pixel = side == 0   ? glm::dvec2{part * w, 0}
                               : side == 1 ? glm::dvec2{w, part * h}
                               : side == 2 ? glm::dvec2{(1 - part) * w, h}
                                           : glm::dvec2{0, (1 - part) * h};
      const glm::dvec3 ray = camera.ray(pixel.x, pixel.y).xyz;
      const double across = std::max(std::hypot(ray.x, ray.y), 1e-6 * glm::length(ray));
      const glm::dvec2 azimuth{ray.x / across, ray.y / across};
      const double rise = ray.z / across;
      const double far = walker.buried_m(rise);
      const double near =
          std::min(far, std::max(near_share * walker.clear_m(azimuth, rise), nearest_m));
      ground_[out++] = near * azimuth;
      ground_[out++] = far * azimuth;
    }
  }
}

}  // namespace ridgeline::sim
