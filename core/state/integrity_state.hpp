#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "config/bus_icd.hpp"
#include "core/bus/bus_decoder.hpp"
#include "core/state/watches.hpp"

namespace ridgeline {

/// One coordinate that waits for the other one of its fix.
struct PendingCoordinate {
  bool pending = false;
  double value_deg = 0.0;
  std::int64_t time_ns = 0;
  Source source;
};

/// What is remembered between updates to make consistent fixes of one receiver.
struct PositionPairing {
  PendingCoordinate latitude;
  PendingCoordinate longitude;
};

/// A second sender of a parameter: heard, compared, not used while the first one is fresh.
struct Rival {
  bool used = false;
  Source source;
  bool valued = false;
  double value = 0.0;   ///< or the latitude
  double second = 0.0;  ///< the longitude, for positions
  std::int64_t time_ns = 0;
  Confirmation contradiction;  ///< of the held value by this one
  PositionPairing pairing;
  DecoderMemory decoder;
};

/// What parameters are compared between senders, latitude and longitude as one.
enum class Compared : std::uint8_t {
  roll,
  pitch,
  heading,
  true_heading,
  magnetic_heading,
  gps_fix,
  ins_fix,
  gps_height,
  ins_height,
};
inline constexpr std::size_t compared_count = 9;
/// Besides the held one: three senders of one parameter can outvote one of them.
inline constexpr std::size_t rival_count = 2;

/// Fixes of one receiver against its own speed and track.
struct FixTrack {
  bool started = false;
  Source source;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  std::int64_t time_ns = 0;
  bool moves = false;  ///< the velocity is known
  double east_mps = 0.0;
  double north_mps = 0.0;
  DriftWatch reckoned;
};

/// Heights of one receiver against the altitude rate and the barometer.
struct HeightTrack {
  bool started = false;
  Source source;
  double height_m = 0.0;
  std::int64_t time_ns = 0;
  bool climbs = false;  ///< the rate is known
  double climb_mps = 0.0;
  DriftWatch climbed;
  bool has_pressure = false;
  double pressure_m = 0.0;  ///< standard altitude
  DriftWatch barometer;
};

/// Two receivers against each other.
struct ReceiverPair {
  bool apart_known = false;
  double apart_east_m = 0.0;
  double apart_north_m = 0.0;
  bool height_known = false;
  double apart_m = 0.0;
  DriftWatch fixes;
  DriftWatch heights;
};

/// Three headings against each other.
struct HeadingPairs {
  Confirmation true_heading;  ///< 1133 and 321
  Confirmation true_magnetic;
  Confirmation heading_magnetic;
  std::array<std::int64_t, 3> time_ns{};  ///< of the last comparison, in this order
};

/// The clock of the bus against the times of reception.
struct ClockWatch {
  bool started = false;
  double ahead_s = 0.0;  ///< reception before UTC, within a day
  bool stepped = false;
  std::int64_t step_ns = 0;  ///< of the last step
};

/// Frames that were there before.
struct ReplayWatch {
  std::int64_t window_ns = 0;  ///< start of the window they are counted in
  std::uint8_t count = 0;
  bool flagged = false;
  std::int64_t flag_ns = 0;  ///< the last time there were too many
};

/// Everything source selection and integrity remember. Trivially copyable.
struct IntegrityState {
  std::array<std::array<Rival, rival_count>, compared_count> rivals{};
  std::array<SequenceWatch, bus_parameter_count> sequences{};
  std::array<FreezeWatch, compared_count> freezes{};
  std::array<FixTrack, 2> fixes{};  ///< GPS, INS
  std::array<HeightTrack, 2> heights{};
  ReceiverPair receivers;
  HeadingPairs headings;
  ClockWatch clock;
  ReplayWatch replay;
  bool jumped = false;
  std::int64_t jump_ns = 0;  ///< a jump was last believed
};

}  // namespace ridgeline
