#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/synthetic/scripted_flight.hpp"

namespace ridgeline::fine {

/// The aircraft is somewhere else from one moment on, as after a position reset.
struct Jump {
  double at_s = 0;
  double along_m = 0;  ///< along the track; backwards when negative
};

/// A coordinated turn. The bank comes and goes over roll_time_s, or a third of the turn.
struct Turn {
  double at_s = 0;
  double bank_deg = 0;  ///< right wing down is positive and turns right
  double duration_s = 0;
};
inline constexpr double roll_time_s = 3;

/// A level flight at constant speed along a geodesic of WGS 84. Times count from its start.
struct FlightPlan {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double heading_deg = 0;  ///< true, at the start; no wind, so heading is track
  double speed_mps = 0;    ///< over the ground, at the height of the flight
  double height_m = 0;     ///< above the ellipsoid
  double duration_s = 0;
  std::optional<Jump> jump;
  std::optional<Turn> turn;
};

inline constexpr double longest_flight_s = 14'400;

/// What is wrong with a plan; empty where it is good: latitude -90..90, longitude -180..180,
/// heading -180..360, speed 1..400 m/s, height -600..20500 m, 1..longest_flight_s; a jump within
/// the flight, of at most 20000 km; a turn within the flight, bank -60..60 but not 0.
[[nodiscard]] std::string wrong_with(const FlightPlan& plan);

/// One sample per 1/80 s, the end included. Roll is the bank, pitch the angle of attack of the
/// demo flight; the turn rate is that of a coordinated turn, g tan(bank) / speed.
/// Domain: wrong_with(plan) empty, else RL_ASSERT.
/// Error:  each step is a geodesic of the local radius of curvature: below 1 mm in an hour
///         (test StraightFlight.follows_the_geodesic).
[[nodiscard]] std::vector<sim::FlightSample> straight_flight(const FlightPlan& plan);

/// The flight as text of a recorded bus (sim::bus_log without gaps), labelled as scripted.
[[nodiscard]] std::string flight_log(const FlightPlan& plan);

}  // namespace ridgeline::fine
