#include <cstdlib>

#include "platform/screen_output.hpp"

namespace ridgeline {

void draw_failure_picture(std::uint32_t* pixels, std::size_t stride, int width_px, int height_px) {
  const double reach = failure_line_px(width_px) / 2.0;
  for (int y = 0; y < height_px; ++y) {
    const double falling = (y + 0.5) * width_px / height_px;
    for (int x = 0; x < width_px; ++x) {
      const bool line =
          std::abs(x + 0.5 - falling) <= reach || std::abs(width_px - x - 0.5 - falling) <= reach;
      pixels[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] =
          line ? failure_colour : 0;
    }
  }
}

}  // namespace ridgeline
