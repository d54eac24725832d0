#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "core/base/fixed_vector.hpp"
#include "core/render/ray_tile.hpp"

namespace ridgeline {

inline constexpr int text_band_px = 32;
inline constexpr std::size_t most_text_bands = limits::max_image_px / text_band_px;

/// Where a text layer is written on: at most one rectangle a band of rows, from its first byte that
/// is not 0 to its last. Only `origin` and `size` of a record mean something.
/// Shape: layer of width x height bytes, row 0 at the top, neither above limits::max_image_px.
/// Cost:  O(width x height), the empty rows without branches; no allocation.
FixedVector<RayTile, most_text_bands> text_bands(std::span<const std::uint8_t> layer, int width_px,
                                                 int height_px);

}  // namespace ridgeline
