#pragma once
#include <cstdint>
#include <optional>

#include "config/limits_bus.hpp"
#include "core/bus/bus_profile.hpp"
#include "core/state/integrity.hpp"
#include "core/state/ownship_state.hpp"

namespace ridgeline {

/// Ages at which the pose is no longer good, and how far it is carried on meanwhile.
struct StateLimits {
  std::int64_t attitude_timeout_ns = limits::attitude_timeout_ns;
  std::int64_t heading_timeout_ns = limits::heading_timeout_ns;
  std::int64_t position_timeout_ns = limits::position_timeout_ns;
  std::int64_t height_timeout_ns = limits::height_timeout_ns;
  std::int64_t velocity_timeout_ns = limits::velocity_timeout_ns;
  std::int64_t variation_timeout_ns = limits::variation_timeout_ns;
  std::int64_t extrapolation_limit_ns = limits::extrapolation_limit_ns;
  /// What id 321 refers to and the sign of the variation, as in the BusProfile the state was made
  /// with.
  HeadingReference heading_reference = HeadingReference::unknown;
  bool variation_east_positive = true;
  std::optional<double> fixed_variation_deg;  ///< east positive; used while none was ever received
};

/// StateLimits with the defaults of config/limits_bus.hpp and the heading rules of a profile.
[[nodiscard]] StateLimits state_limits(const BusProfile& profile);

/// One value of the pose at the time it was asked for.
struct PoseValue {
  double value = 0.0;       ///< meaningful unless `missing` or `reference_unknown`
  std::int64_t age_ns = 0;  ///< of the bus value it comes from; 0 when missing
  Validity validity = Validity::missing;
};

enum class PositionSource : std::uint8_t { none, gps, ins };
enum class HeadingSource : std::uint8_t {
  none,
  true_heading,      ///< id 1133
  heading,           ///< id 321, configured as true
  magnetic_heading,  ///< id 1069 + variation
  heading_magnetic,  ///< id 321, configured as magnetic, + variation
};

/// Where the ownship is and how it is turned at one moment, each value with its own age and
/// validity.
struct OwnshipPose {
  PoseValue latitude_deg;   ///< WGS 84
  PoseValue longitude_deg;  ///< WGS 84, [-180, 180)
  PoseValue height_m;       ///< above the ellipsoid
  PoseValue roll_deg;       ///< right wing down positive, [-180, 180)
  PoseValue pitch_deg;      ///< nose up positive, [-90, 90]
  PoseValue heading_deg;    ///< true, [0, 360)
  PositionSource position_source = PositionSource::none;
  HeadingSource heading_source = HeadingSource::none;
  PoseValue radio_height_m;    ///< only compared, never used to place anything
  PoseValue ground_speed_mps;  ///< of the source of the position
  /// One of several sources of a value above contradicts the others; the value is that of the
  /// others.
  bool source_excluded = false;
  /// Speed, track or altitude rate jumped or does not fit the fixes: nothing is carried on by it.
  bool velocity_doubted = false;
  RecentEvents events;
  std::int64_t extrapolated_ns = 0;  ///< how long the position was carried on, 0 when it was not
};

/// The pose at `now_ns`.
/// Rules:  - Position: GPS, unless it is not valid and the INS position is. Height, speed and track
/// come from the same
///           source as the position: two datums are never mixed.
///         - Position and height are carried on from the time of the fix by ground speed and track,
///         and altitude rate,
///           as long as those are valid and younger than velocity_timeout_ns, at most
///           extrapolation_limit_ns, not within half a degree of the poles, and not for a fix that
///           is not valid.
///         - Heading: id 1133; else id 321 configured as true; else id 1069, else id 321 configured
///         as magnetic, each
///           + variation. A heading without a known reference, or magnetic without a valid
///           variation, is `reference_unknown`. Track is never used as heading: in wind it is wrong
///           by the drift angle.
/// Error:  extrapolation on the ellipsoid's local radii: below 1 cm in 1 s at 250 m/s for a
/// straight flight. Cost:   O(1); no allocation.
[[nodiscard]] OwnshipPose ownship_pose(const OwnshipState& state, std::int64_t now_ns,
                                       const StateLimits& limits);

}  // namespace ridgeline
