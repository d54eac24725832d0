#pragma once
#include <cstdint>
#include <span>

#include "core/frame/frame_report.hpp"

namespace ridgeline {

/// Blocks of a picture without terrain: only the camera is meaningful.
FrameBlocks camera_blocks(const Camera& camera);

/// Colours, light and legend of a frame.
shader::StyleBlock style_block(const FrameReport& report, const WindowGrid& window,
                               bool attitude_valid);

/// Writes the words of a frame into the text layer and returns it: NOT CERTIFIED always, the mode
/// and its reasons, the bound. Shape: width x height bytes, row 0 at the top, 255 ink, 0 nothing.
std::span<const std::uint8_t> text_layer(const FrameReport& report, std::span<std::uint8_t> layer);

}  // namespace ridgeline
