#pragma once
#include <cstdint>
#include <span>

#include "core/frame/frame_report.hpp"
#include "core/terrain/terrain_levels.hpp"

namespace ridgeline {

/// Blocks of a picture without terrain: only the camera is meaningful.
FrameBlocks camera_blocks(const Camera& camera);

/// Colours, light, lines and legend of a frame. The ground grid lies on whole minutes of latitude
/// and longitude, whatever the lattice.
/// `geoid`: what tint, contours and sea are counted from; NaN (no data) counts as 0 m there.
shader::StyleBlock style_block(const FrameReport& report, const PostLattice& lattice,
                               const GeoidLookup& geoid, bool attitude_valid);

/// Writes the words of a frame into the text layer and returns it: NOT CERTIFIED always, the mode
/// and its reasons, the bound. Shape: width x height bytes, row 0 at the top; the bytes are the
/// text constants of shaders/frame_block.h.
std::span<const std::uint8_t> text_layer(const FrameReport& report, std::span<std::uint8_t> layer);

}  // namespace ridgeline
