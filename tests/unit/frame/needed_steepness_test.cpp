// The lemma behind shared rays, against rays over ground made to break it: cones as steep as is
// allowed, whose tops stand where a ray passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "core/frame/tile_look.hpp"

namespace ridgeline {
namespace {

constexpr double longest_m = 20'000.0;

/// The highest of some cones, and of a plane: nowhere steeper than `steepness`.
struct Cones {
  double steepness = 0;
  glm::dvec3 plane{0.0};  ///< east, north, height of the plane at the eye
  std::vector<glm::dvec3> tops;

  [[nodiscard]] double height_m(const glm::dvec3& at) const {
    double highest = plane.z + plane.x * at.x + plane.y * at.y;
    for (const glm::dvec3& top : tops) {
      highest = std::max(highest, top.z - steepness * std::hypot(at.x - top.x, at.y - top.y));
    }
    return highest;
  }
};

/// A direction that looks down and to the side of north.
glm::dvec3 direction(double down_rad, double beside_rad) {
  return {std::cos(down_rad) * std::sin(beside_rad), std::cos(down_rad) * std::cos(beside_rad),
          -std::sin(down_rad)};
}

/// Distance of the first ground along a ray; longest_m where there is none. Never steps over any:
/// the ground comes nearer by no more than `closing` a metre.
double first_hit_m(const Cones& ground, const glm::dvec3& ray) {
  const double closing = -ray.z + ground.steepness * std::hypot(ray.x, ray.y) + 1e-9;
  double t = 1.0;
  while (t < longest_m) {
    const glm::dvec3 at = t * ray;
    const double gap = at.z - ground.height_m(at);
    if (gap <= 1e-7 * t) return t;
    t += std::max(gap / std::max(closing, 1e-6), 1e-7 * t);
  }
  return longest_m;
}

struct RayPair {
  double down_rad = 0, above_rad = 0, beside_rad = 0;
};

class LemmaCases {
 public:
  explicit LemmaCases(unsigned seed) : random_(seed) {}

  double unit() { return static_cast<double>(random_()) * 0x1p-32; }
  double either() { return 2 * unit() - 1; }

  /// Ground that the upper ray nearly meets before the lower one.
  Cones ground_for(const RayPair& rays, double steepness) {
    Cones ground{steepness, {0, 0, 0}, {}};
    const double slope = steepness * unit(), to_rad = 6.3 * unit();
    ground.plane = {slope * std::sin(to_rad), slope * std::cos(to_rad), -300 - 3000 * unit()};
    const glm::dvec3 upper = direction(rays.down_rad - rays.above_rad, rays.beside_rad);
    for (int k = 0; k < 10; ++k) {
      const double t = 500 + 9000 * unit();
      const double off_m = 3 * t * std::max(rays.above_rad, std::abs(rays.beside_rad));
      const double lift_m = 0.3 * t * rays.above_rad * either();
      ground.tops.push_back(
          t * upper + glm::dvec3(off_m * either() * unit(), off_m * either() * unit(), lift_m));
    }
    return ground;
  }

 private:
  std::mt19937 random_;
};

/// How often a ray above another met the ground first, the ratio of above and beside being `share`
/// of what the lemma asks for.
int early_hits(double share, unsigned seed) {
  LemmaCases cases(seed);
  int early = 0;
  for (int k = 0; k < 20'000; ++k) {
    RayPair rays;
    rays.down_rad = cases.unit() * 1.30 - 0.08;
    const double steepness = 0.02 + 3 * cases.unit() * cases.unit();
    TileLook look;
    look.known = true;
    look.down_rad = rays.down_rad;
    look.stretch = 1.0;
    const double needed = needed_steepness(look, steepness);
    if (std::isinf(needed)) continue;
    // Small angles, as between pixels; the bearing turns more than the ray does.
    rays.above_rad = 2e-4 + 4e-4 * cases.unit();
    const double beside = rays.above_rad / (share * needed);
    if (beside > 0.01) continue;
    rays.beside_rad =
        (cases.unit() < 0.5 ? -beside : beside) / std::cos(rays.down_rad - rays.above_rad);
    const Cones ground = cases.ground_for(rays, steepness);
    if (ground.height_m({0, 0, 0}) > -20) continue;
    const double lower_m = first_hit_m(ground, direction(rays.down_rad, 0));
    const double upper_m =
        first_hit_m(ground, direction(rays.down_rad - rays.above_rad, rays.beside_rad));
    // Second orders of the angles, and where the marches end.
    early += upper_m < lower_m * (1 - 2e-5) ? 1 : 0;
  }
  return early;
}

TEST(NeededSteepness, a_ray_above_another_never_meets_the_ground_first) {
  EXPECT_EQ(early_hits(1.01, 1201), 0);
}

TEST(NeededSteepness, less_than_is_needed_is_not_enough) {
  EXPECT_GT(early_hits(0.8, 1202), 0);
}

TEST(NeededSteepness, has_an_end_where_ground_faces_the_eye) {
  TileLook look;
  look.known = true;
  look.stretch = 1.0;
  look.down_rad = 1.0;
  EXPECT_TRUE(std::isinf(needed_steepness(look, 0.65)));
  EXPECT_FALSE(std::isinf(needed_steepness(look, 0.4)));
  look.down_rad = -0.5;  // looking up costs nothing
  EXPECT_DOUBLE_EQ(needed_steepness(look, 2.0), 2.0);
  look.stretch = 1.5;
  look.skew = 0.25;
  EXPECT_DOUBLE_EQ(needed_steepness(look, 2.0), 3.25);
  look.known = false;
  EXPECT_TRUE(std::isinf(needed_steepness(look, 0.05)));
}

}  // namespace
}  // namespace ridgeline
