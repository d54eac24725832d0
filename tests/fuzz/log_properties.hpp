#pragma once
#include <string_view>

#include "core/bus/bus_frame.hpp"
#include "sim/log/line_parser.hpp"

namespace ridgeline::fuzz {

/// Reads a text as a log of a format, whole and in pieces, and checks what holds of every log: each
/// line is counted once, each bad one is told by its number, each frame is one that a CAN bus can
/// carry, classic data frames survive writing and reading again.
void check_log(std::string_view text, LogFormat format);

/// Whether two frames are the same in everything.
[[nodiscard]] bool is_same(const BusFrame& a, const BusFrame& b);

/// Checks that a bus can carry the frame and that the unused data bytes are 0.
void check_frame(const BusFrame& frame);

}  // namespace ridgeline::fuzz
