#include "core/render/text_bands.hpp"

#include <algorithm>

namespace ridgeline {

FixedVector<RayTile, most_text_bands> text_bands(std::span<const std::uint8_t> layer, int width_px,
                                                 int height_px) {
  FixedVector<RayTile, most_text_bands> bands;
  for (int y = 0; y < height_px; y += text_band_px) {
    const int rows = std::min(text_band_px, height_px - y);
    int left = width_px, right = 0;
    for (int row = y; row < y + rows; ++row) {
      const auto bytes = layer.subspan(static_cast<std::size_t>(row) * width_px, width_px);
      std::uint8_t any = 0;
      for (const std::uint8_t byte : bytes) any |= byte;  // without branches: most rows are empty
      if (any == 0) continue;
      const auto inked = [](std::uint8_t byte) { return byte != 0; };
      const auto first = std::find_if(bytes.begin(), bytes.end(), inked);
      const auto last = std::find_if(bytes.rbegin(), bytes.rend(), inked);
      left = std::min(left, static_cast<int>(first - bytes.begin()));
      right = std::max(right, static_cast<int>(bytes.rend() - last));
    }
    if (left >= right) continue;
    bands.push_back({RayTile::pair(left, y), 0, RayTile::pair(right - left, rows)});
  }
  return bands;
}

}  // namespace ridgeline
