#pragma once
#include <cmath>
#include <cstddef>

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

/// A plain at 300 m in which some single posts are void.
inline double plain_with_specks_m(double latitude_deg, double longitude_deg) {
  const auto row = std::llround((latitude_deg - 46) * 1200);
  const auto column = std::llround((longitude_deg - 8) * 1200);
  return (row * 7 + column * 13) % 61 == 0 ? std::nan("") : 300.0;
}

/// Pixels that both pictures show as ground, at distances that differ by more than 2 %.
inline int elsewhere(const sim::Picture& ours, const sim::Picture& other) {
  int count = 0;
  for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
    const float a = ours.range_m[i], b = other.range_m[i];
    if (std::isfinite(a) && std::isfinite(b) && std::abs(a - b) > 0.02F * a) ++count;
  }
  return count;
}

}  // namespace ridgeline::test
