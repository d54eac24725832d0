#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sim/synthetic/scripted_flight.hpp"

namespace ridgeline::sim {

/// Stretches of the flight in which the bus carries no such data (s since the start).
struct BusGaps {
  double position_from_s = 0;
  double position_to_s = 0;
  double attitude_from_s = 0;
  double attitude_to_s = 0;
};

/// The gaps of the demo log: 3 s without position, 1 s without attitude.
constexpr BusGaps demo_gaps = {38.0, 41.0, 62.0, 63.0};

/// The comment lines that the demo log begins with.
constexpr std::string_view demo_comments =
    "# ridgeline: SYNTHETIC terrain and flight, not a real place\n"
    "# CANaerospace 1.7 frames; heights are above the ellipsoid and the terrain has no geoid "
    "(--geoid none)\n";

/// The flight as a recorded bus: text as `candump -L` writes it, CANaerospace v1.7 frames of
/// node 1. Every sample carries pitch, roll and true heading (311, 312, 1133); every eighth one
/// latitude and longitude (1036, 1037, DOUBLEH then DOUBLEL), height above the ellipsoid, ground
/// speed, true track (1038, 1039, 1040) and altitude rate (314); every 80th the time of day (1200).
/// Shape:  `comments` (lines with `#`), then one frame a line in order of time, from 1700000000 s.
/// Error:  the same bytes on every machine with IEEE-754 doubles.
/// Source: CANaerospace interface specification 1.7, sections 2.2, 3.1, 5.1, 5.7 and 6.
[[nodiscard]] std::string bus_log(std::span<const FlightSample> flight, const BusGaps& gaps,
                                  std::string_view comments = demo_comments);

}  // namespace ridgeline::sim
