#include "core/terrain/ground_part.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

constexpr float nothing = -1e9F;

bool is_void(float post) {
  return post < void_threshold_m;
}

float at(const PostSquare& fine, int x, int y) {
  return fine.posts[static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.side) +
                    static_cast<std::size_t>(x)];
}

}  // namespace

float steepest_slope(const PostSquare& fine, const CellSquare& cells) {
  float steepest2 = 0;
  for (int y = cells.y0; y < cells.y0 + cells.side; ++y) {
    for (int x = cells.x0; x < cells.x0 + cells.side; ++x) {
      const float a = at(fine, x, y), b = at(fine, x + 1, y);
      const float c = at(fine, x, y + 1), d = at(fine, x + 1, y + 1);
      if (fine.with_voids && is_void(std::min({a, b, c, d}))) continue;
      // A bilinear surface is nowhere steeper, along either axis, than at its edges.
      const float east = fine.per_east * std::max(std::abs(b - a), std::abs(d - c));
      const float north = fine.per_north * std::max(std::abs(c - a), std::abs(d - b));
      steepest2 = std::max(steepest2, east * east + north * north);
    }
  }
  constexpr float rounded = 1.0001F;
  return rounded * std::sqrt(steepest2);
}

GroundPart ground_part(const PostSquare& fine, const CellSquare& cells) {
  GroundPart part{steepest_slope(fine, cells), -nothing, nothing};
  for (int y = cells.y0; y <= cells.y0 + cells.side; ++y) {
    for (int x = cells.x0; x <= cells.x0 + cells.side; ++x) {
      const float h = at(fine, x, y);
      if (fine.with_voids && is_void(h)) continue;
      part.lowest_m = std::min(part.lowest_m, h);
      part.highest_m = std::max(part.highest_m, h);
    }
  }
  return part;
}

}  // namespace ridgeline
