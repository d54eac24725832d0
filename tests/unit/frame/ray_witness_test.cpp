// What a block bears while the vertical points a little beside where it was asked for, against
// every pixel within reach.
#include "core/frame/ray_witness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace ridgeline {
namespace {

constexpr double any = 1e3;

/// Slope between a pixel and a ray, what rounding moves taken off.
double slope_to(double above, double beside, double loss_px) {
  return above <= loss_px ? 0.0 : std::min(any, (above - loss_px) / std::max(beside, 1e-9));
}

/// The same for a ray anywhere in a block round `to` that holds it.
double least_slope_to(const glm::dvec2& to, const BlockShape& block, const glm::dvec2& way,
                      double sign, double loss_px) {
  double least = any;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const glm::dvec2 ray(to.x + x * (block.width - 1), to.y + y * (block.height - 1));
      least = std::min(least, slope_to(sign * (ray.x * way.x + ray.y * way.y),
                                       std::abs(ray.x * way.y - ray.y * way.x), loss_px));
    }
  }
  return least;
}

/// What pixel i, j of a block finds at best, above or below it, where the vertical is `way`.
double best_of_pixel(const BlockPair& blocks, int i, int j, double sign, const glm::dvec2& way,
                     const WitnessLimits& limits) {
  const BlockShape& own = blocks.own;
  const glm::dvec2 half(0.5 * (own.width - 1), 0.5 * (own.height - 1));
  const int reach = static_cast<int>(limits.reach_px);
  double best = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (std::hypot(dx, dy) > limits.reach_px) continue;
      const double column = std::floor((i + dx) / static_cast<double>(own.width));
      const double row = std::floor((j + dy) / static_cast<double>(own.height));
      const glm::dvec2 ray(column * own.width + half.x - i, row * own.height + half.y - j);
      double slope = slope_to(sign * (ray.x * way.x + ray.y * way.y),
                              std::abs(ray.x * way.y - ray.y * way.x), limits.loss_px);
      const bool beside = column != 0 || row != 0;
      if (beside && !blocks.one_lattice) {
        slope = std::min(
            slope, least_slope_to(glm::dvec2(dx, dy), blocks.other, way, sign, limits.loss_px));
      }
      best = std::max(best, slope);
    }
  }
  return best;
}

double bears(const BlockPair& blocks, const glm::dvec2& way, const WitnessLimits& limits) {
  double least = any;
  for (int j = 0; j < blocks.own.height; ++j) {
    for (int i = 0; i < blocks.own.width; ++i) {
      for (const double sign : {1.0, -1.0}) {
        least = std::min(least, best_of_pixel(blocks, i, j, sign, way, limits));
      }
    }
  }
  return least;
}

struct WitnessCase {
  BlockPair blocks;
  double angle_rad = 0;
  WitnessLimits limits;
};

class Witnesses {
 public:
  explicit Witnesses(unsigned seed) : random_(seed) {}

  double unit() { return static_cast<double>(random_()) * 0x1p-32; }
  WitnessCase next() {
    constexpr BlockShape shapes[] = {{8, 8}, {6, 6}, {4, 4}, {3, 3},
                                     {2, 2}, {1, 2}, {2, 1}, {1, 1}};
    WitnessCase c;
    c.blocks.own = shapes[random_() % 7];
    c.blocks.other = random_() % 2 == 0 ? c.blocks.own : shapes[random_() % 8];
    const bool same =
        c.blocks.own.width == c.blocks.other.width && c.blocks.own.height == c.blocks.other.height;
    c.blocks.one_lattice = same && random_() % 2 == 0;
    c.angle_rad = std::numbers::pi * (random_() % 4 == 0 ? 0.25 * int(random_() % 8) : 2 * unit());
    c.limits.reach_px = std::min(10.0, 0.7071 + c.blocks.own.radius_px() + 2.5 * unit());
    c.limits.loss_px = random_() % 2 == 0 ? 0.0 : 0.25 * unit();
    c.limits.turn_rad = random_() % 2 == 0 ? std::numbers::pi / 1024 : 0.04 * unit();
    return c;
  }

 private:
  std::mt19937 random_;
};

TEST(SteepestForBlock, holds_for_every_vertical_within_the_turn) {
  Witnesses witnesses(1301);
  int some = 0;
  for (int k = 0; k < 4000 && !testing::Test::HasFailure(); ++k) {
    const WitnessCase c = witnesses.next();
    const glm::dvec2 way(std::cos(c.angle_rad), std::sin(c.angle_rad));
    const double promised = steepest_for_block(c.blocks, way, c.limits);
    some += promised > 0.05 ? 1 : 0;
    for (int turn = -8; turn <= 8; ++turn) {
      const double angle = c.angle_rad + c.limits.turn_rad * turn / 8;
      const double borne = bears(c.blocks, {std::cos(angle), std::sin(angle)}, c.limits);
      EXPECT_LE(promised, borne * (1 + 1e-9) + 1e-9)
          << "case " << k << ": " << c.blocks.own.width << 'x' << c.blocks.own.height << " beside "
          << c.blocks.other.width << 'x' << c.blocks.other.height << ", lattice "
          << c.blocks.one_lattice << ", angle " << c.angle_rad << ", reach " << c.limits.reach_px
          << ", loss " << c.limits.loss_px << ", turn " << c.limits.turn_rad * turn / 8 << " of "
          << c.limits.turn_rad;
    }
  }
  EXPECT_GT(some, 1000);
}

TEST(SteepestForBlock, without_its_turn_it_does_not_hold) {
  Witnesses witnesses(1302);
  int broken = 0;
  for (int k = 0; k < 1000; ++k) {
    WitnessCase c = witnesses.next();
    const double angle = c.angle_rad + c.limits.turn_rad;
    c.limits.turn_rad = 0;
    const double promised =
        steepest_for_block(c.blocks, {std::cos(c.angle_rad), std::sin(c.angle_rad)}, c.limits);
    const double borne = bears(c.blocks, {std::cos(angle), std::sin(angle)}, c.limits);
    broken += promised > borne * (1 + 1e-6) ? 1 : 0;
  }
  EXPECT_GT(broken, 100);
}

}  // namespace
}  // namespace ridgeline
