#pragma once
#include <cmath>

#include "sim/session/session.hpp"

namespace ridgeline::test {

/// Pixels of unknown ground, all round them too, that another picture shows as something else: what
/// is lost along the rim of unknown ground alone does not count.
inline int lost_inside(const sim::Picture& ours, const sim::Picture& other) {
  const int width = ours.report.camera.width_px, height = ours.report.camera.height_px;
  int lost = 0;
  for (int v = 1; v + 1 < height; ++v) {
    for (int u = 1; u + 1 < width; ++u) {
      bool inside = true;
      for (int k = 0; k < 9; ++k) {
        const int at = (v + k / 3 - 1) * width + u + k % 3 - 1;
        inside = inside && std::isnan(ours.range_m[static_cast<std::size_t>(at)]);
      }
      const auto here = static_cast<std::size_t>(v) * width + u;
      lost += inside && !std::isnan(other.range_m[here]) ? 1 : 0;
    }
  }
  return lost;
}

}  // namespace ridgeline::test
