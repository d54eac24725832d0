#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgeline::test {

/// What is in a window, row by row from the top, as 0x??RRGGBB.
struct SeenPixels {
  int width_px = 0, height_px = 0;
  std::vector<std::uint32_t> rows;
  [[nodiscard]] std::uint32_t at(int x, int y) const {
    return rows[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                static_cast<std::size_t>(x)] &
           0xFFFFFF;
  }
};

}  // namespace ridgeline::test
