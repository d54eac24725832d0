#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "core/frame/frame_report.hpp"

namespace ridgeline {

/// Writes one frame as `ridgeline --dump` does (docs/commands.md): 000000.json, 000000_color.png
/// and, unless `range_m` is empty, 000000_range.npy; so `ridgeline verify` judges what the flight
/// program drew. Makes the folder. Returns what is wrong, naming the file; empty: nothing.
/// Shape: range_m width x height, rgba four times as many bytes; row 0 at the top.
[[nodiscard]] std::string write_frame_dump(const std::string& folder, const FrameReport& report,
                                           const std::string& geoid_name,
                                           std::span<const float> range_m,
                                           std::span<const std::uint8_t> rgba);

/// An 8-bit RGB picture as a PNG file in memory, not compressed: the flight program has no zlib.
[[nodiscard]] std::string png_of(int width, int height, std::span<const std::uint8_t> rgb);

/// As zlib's crc32().
[[nodiscard]] std::uint32_t crc32_of_bytes(std::span<const std::uint8_t> bytes);

}  // namespace ridgeline
