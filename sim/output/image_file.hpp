#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// Writes an 8-bit RGB picture as PNG, the file whole or not at all.
/// Shape:  `rgb` is rows x columns x 3, row 0 at the top. Same pixels, same libpng: same bytes.
/// Domain: sides of at least one pixel and rgb.size() == 3 * width * height, else RL_ASSERT.
/// Error:  Fault::file_unwritable with the reason.
[[nodiscard]] Outcome write_png(const std::string& path, int width, int height,
                                std::span<const std::uint8_t> rgb);

/// The CRC-32 of PNG and zlib (polynomial 0xEDB88320, start and final value inverted) over the
/// bytes.
[[nodiscard]] std::uint32_t crc32_of(std::span<const std::uint8_t> bytes);

}  // namespace ridgeline::sim
