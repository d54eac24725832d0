#include "core/frame/ray_witness.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ridgeline {

double steepest_for_block(const BlockPair& blocks, const glm::dvec2& way,
                          const WitnessLimits& limits) {
  constexpr double any = 1e3;
  constexpr double curved = 1.1;  // turns are small: what a second order adds
  const BlockShape &shape = blocks.own, &other = blocks.other;
  const double reach_px = limits.reach_px;
  const glm::dvec2 half(0.5 * (shape.width - 1), 0.5 * (shape.height - 1));
  const double other_width = 0.5 * (other.width - 1), other_height = 0.5 * (other.height - 1);
  const double other_up = other_width * std::abs(way.x) + other_height * std::abs(way.y);
  const double other_beside = other_width * std::abs(way.y) + other_height * std::abs(way.x);
  // `spread`: what of `above` was taken off, or turns the other way.
  const auto value = [&](double above, double beside, double spread) {
    const double up = above - limits.loss_px;
    if (up <= 0) return 0.0;
    const double swing = 1.0 + up * (limits.loss_px + spread) / (up * up + beside * beside);
    const double angle = std::atan2(up, beside) - curved * swing * limits.turn_rad;
    return angle > 0 ? std::min(any, std::tan(std::min(angle, std::atan(any)))) : 0.0;
  };
  const auto off_axis = [&](const glm::dvec2& v) { return std::abs(v.x * way.y - v.y * way.x); };
  const auto witness = [&](const glm::dvec2& pixel, const glm::dvec2& step, double sign) {
    // In its own tile another block stands where the lattice of blocks says; in the tile beside its
    // ray may be anywhere that its pixels allow.
    const glm::dvec2 to(pixel + step);
    const glm::dvec2 block(std::floor(to.x / shape.width), std::floor(to.y / shape.height));
    const glm::dvec2 ray = block * glm::dvec2(shape.width, shape.height) + half - pixel;
    const double same = value(sign * glm::dot(ray, way), off_axis(ray), 0.0);
    if (block == glm::dvec2(0.0)) return 0.0;
    if (blocks.one_lattice) return same;
    return std::min(same, value(sign * glm::dot(step, way) - other_up,
                                off_axis(step) + other_beside, 2.0 * other_up));
  };
  double steepest = any;
  for (int j = 0; j < shape.height; ++j) {
    for (int i = 0; i < shape.width; ++i) {
      const glm::dvec2 pixel(i, j), own = half - pixel;
      for (const double sign : {1.0, -1.0}) {
        double best = value(sign * glm::dot(own, way), off_axis(own), 0.0);
        for (int k = 1; k <= static_cast<int>(reach_px); ++k) {
          for (const int side : {-1, 0, 1}) {
            const bool upright = std::abs(way.x) < 0.7071;
            const glm::dvec2 step(std::round(sign * k * way.x) + (upright ? side : 0),
                                  std::round(sign * k * way.y) + (upright ? 0 : side));
            if (glm::length(step) <= reach_px) best = std::max(best, witness(pixel, step, sign));
          }
        }
        steepest = std::min(steepest, best);
      }
    }
  }
  return steepest;
}

}  // namespace ridgeline
