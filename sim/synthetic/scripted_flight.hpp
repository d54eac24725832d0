#pragma once
#include <vector>

#include "sim/synthetic/tile_writer.hpp"

namespace ridgeline::sim {

/// One instant of the scripted flight.
/// Frame:  WGS 84; height above the ellipsoid; heading and track from true north, clockwise,
/// -180..180.
struct FlightSample {
  double time_s = 0;  ///< since the start of the flight
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
  double roll_deg = 0;   ///< right wing down is positive
  double pitch_deg = 0;  ///< nose up is positive
  double heading_deg = 0;
  double track_deg = 0;
  double ground_speed_mps = 0;
  double climb_mps = 0;
};

constexpr int flight_ticks_per_second = 80;
constexpr int flight_duration_s = 90;
constexpr double flight_clearance_m = 60;  ///< the flight is never lower than this above the ground

/// The demo flight, one sample per 1/80 s: past the airfield, up a valley, over a ridge, out to
/// sea. The path is a smooth curve flown at constant ground speed; roll is that of a coordinated
/// turn, pitch the flight path plus an angle of attack, heading the track corrected for a steady
/// wind. `ground_m` is asked along the path and 120 m to either side; the height stays at least
/// flight_clearance_m above the highest answer, by construction (a smoothed running maximum).
/// Domain: `ground_m` gives numbers (not NaN) along the path, else RL_ASSERT.
/// Error:  the same bits on every machine with IEEE-754 doubles, if ground_m is.
[[nodiscard]] std::vector<FlightSample> scripted_flight(const HeightFunction& ground_m);

}  // namespace ridgeline::sim
