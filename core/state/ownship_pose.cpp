#include "core/state/ownship_pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bus/canaerospace.hpp"

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;

/// The parameters of one source of position.
struct PositionParameters {
  BusParameter latitude;
  BusParameter longitude;
  BusParameter height;
  BusParameter ground_speed;
  BusParameter true_track;
};
constexpr PositionParameters gps_parameters{
    BusParameter::gps_latitude, BusParameter::gps_longitude, BusParameter::gps_height,
    BusParameter::gps_ground_speed, BusParameter::gps_true_track};
constexpr PositionParameters ins_parameters{
    BusParameter::ins_latitude, BusParameter::ins_longitude, BusParameter::ins_height,
    BusParameter::ins_ground_speed, BusParameter::ins_true_track};

PoseValue pose_value(const OwnshipState& state, BusParameter parameter, std::int64_t now_ns,
                     std::int64_t timeout_ns) {
  const Sample& sample = state[parameter];
  if (sample.validity == Validity::missing) return {};
  return {sample.value, age_ns(sample, now_ns), validity_at(state, parameter, now_ns, timeout_ns)};
}

double heading_0_360(double angle_deg) {
  const double wrapped = wrapped_deg(angle_deg);
  return wrapped < 0.0 ? std::fmod(wrapped + 360.0, 360.0) : wrapped;
}

/// A magnetic heading made true by the variation, or `reference_unknown`.
PoseValue true_from_magnetic(const OwnshipState& state, PoseValue magnetic, std::int64_t now_ns,
                             const StateLimits& limits) {
  const PoseValue variation =
      pose_value(state, BusParameter::magnetic_variation, now_ns, limits.variation_timeout_ns);
  if (variation.validity == Validity::missing && limits.fixed_variation_deg) {
    magnetic.value += *limits.fixed_variation_deg;
    return magnetic;
  }
  if (variation.validity != Validity::valid) {
    magnetic.validity = Validity::reference_unknown;
    return magnetic;
  }
  magnetic.value += limits.variation_east_positive ? variation.value : -variation.value;
  return magnetic;
}

struct Heading {
  PoseValue value;
  HeadingSource source = HeadingSource::none;
};

/// The first heading that is valid, in the order of preference; else the most preferred one
/// received.
Heading best_heading(const OwnshipState& state, std::int64_t now_ns, const StateLimits& limits) {
  const auto value_of = [&](BusParameter parameter) {
    return pose_value(state, parameter, now_ns, limits.heading_timeout_ns);
  };
  const auto magnetic_of = [&](BusParameter parameter) {
    const PoseValue magnetic = value_of(parameter);
    if (magnetic.validity != Validity::valid) return magnetic;
    return true_from_magnetic(state, magnetic, now_ns, limits);
  };
  const auto heading_321 = [&] {
    PoseValue value = value_of(BusParameter::heading);
    if (limits.heading_reference == HeadingReference::magnetic_north) {
      return magnetic_of(BusParameter::heading);
    }
    const bool unknown = limits.heading_reference == HeadingReference::unknown;
    if (unknown && value.validity == Validity::valid) {
      value.validity = Validity::reference_unknown;
    }
    return value;
  }();
  const bool is_magnetic_321 = limits.heading_reference == HeadingReference::magnetic_north;
  const Heading id_1133{value_of(BusParameter::true_heading), HeadingSource::true_heading};
  const Heading id_1069{magnetic_of(BusParameter::magnetic_heading),
                        HeadingSource::magnetic_heading};
  const Heading id_321{heading_321,
                       is_magnetic_321 ? HeadingSource::heading_magnetic : HeadingSource::heading};
  const std::array<Heading, 3> order = is_magnetic_321
                                           ? std::array<Heading, 3>{id_1133, id_1069, id_321}
                                           : std::array<Heading, 3>{id_1133, id_321, id_1069};
  for (const Heading& heading : order) {
    if (heading.value.validity == Validity::valid) return heading;
  }
  for (const Heading& heading : order) {
    if (heading.value.validity != Validity::missing) return heading;
  }
  return {};
}

/// How long a value of this age may be carried on: all of its age, up to the limit.
std::int64_t extrapolation_ns(const PoseValue& value, const StateLimits& limits) {
  if (value.validity != Validity::valid) return 0;
  return std::min(value.age_ns, limits.extrapolation_limit_ns);
}

void extrapolate_position(OwnshipPose& pose, const OwnshipState& state,
                          const PositionParameters& parameters, std::int64_t now_ns,
                          const StateLimits& limits) {
  const PoseValue& speed = pose.ground_speed_mps;
  const PoseValue track =
      pose_value(state, parameters.true_track, now_ns, limits.velocity_timeout_ns);
  // Latitude and longitude share one fix; the older frame is nearer to its time.
  const std::int64_t duration_ns = std::max(extrapolation_ns(pose.latitude_deg, limits),
                                            extrapolation_ns(pose.longitude_deg, limits));
  const double latitude_deg = pose.latitude_deg.value;
  if (speed.validity != Validity::valid || track.validity != Validity::valid || duration_ns == 0 ||
      std::abs(latitude_deg) > limits::extrapolation_latitude_limit_deg) {
    return;
  }
  // Radii of curvature of WGS 84; the height adds 0.1 % of the step at most and is taken along.
  constexpr double a_m = 6378137.0;
  constexpr double e2 = 6.69437999014131705734e-3;
  const double sin_lat = std::sin(latitude_deg * rad_per_deg);
  const double w2 = 1.0 - e2 * sin_lat * sin_lat;
  const double prime_vertical_m = a_m / std::sqrt(w2);
  const double meridian_m = prime_vertical_m * (1.0 - e2) / w2;
  const double height_m = pose.height_m.validity == Validity::valid ? pose.height_m.value : 0.0;
  const double distance_m = speed.value * static_cast<double>(duration_ns) * 1e-9;
  const double north_rad =
      distance_m * std::cos(track.value * rad_per_deg) / (meridian_m + height_m);
  const double east_rad = distance_m * std::sin(track.value * rad_per_deg) /
                          ((prime_vertical_m + height_m) * std::cos(latitude_deg * rad_per_deg));
  pose.latitude_deg.value += north_rad / rad_per_deg;
  pose.longitude_deg.value = wrapped_deg(pose.longitude_deg.value + east_rad / rad_per_deg);
  pose.extrapolated_ns = duration_ns;
}

void extrapolate_height(OwnshipPose& pose, const OwnshipState& state, std::int64_t now_ns,
                        const StateLimits& limits) {
  const PoseValue rate =
      pose_value(state, BusParameter::altitude_rate, now_ns, limits.velocity_timeout_ns);
  if (rate.validity != Validity::valid) return;
  pose.height_m.value +=
      rate.value * static_cast<double>(extrapolation_ns(pose.height_m, limits)) * 1e-9;
}

void place(OwnshipPose& pose, const OwnshipState& state, std::int64_t now_ns,
           const StateLimits& limits) {
  const auto validity_of = [&](const PositionParameters& parameters) {
    return validity_at(state, parameters.latitude, now_ns, limits.position_timeout_ns);
  };
  const Validity gps = validity_of(gps_parameters);
  const Validity ins = validity_of(ins_parameters);
  const bool use_ins =
      gps != Validity::valid && (ins == Validity::valid || gps == Validity::missing);
  if (use_ins && ins == Validity::missing) return;
  const PositionParameters& parameters = use_ins ? ins_parameters : gps_parameters;
  pose.position_source = use_ins ? PositionSource::ins : PositionSource::gps;
  pose.latitude_deg = pose_value(state, parameters.latitude, now_ns, limits.position_timeout_ns);
  pose.longitude_deg = pose_value(state, parameters.longitude, now_ns, limits.position_timeout_ns);
  pose.height_m = pose_value(state, parameters.height, now_ns, limits.height_timeout_ns);
  pose.ground_speed_mps =
      pose_value(state, parameters.ground_speed, now_ns, limits.velocity_timeout_ns);
  extrapolate_position(pose, state, parameters, now_ns, limits);
  extrapolate_height(pose, state, now_ns, limits);
}

BusParameter parameter_of(HeadingSource source) {
  switch (source) {
    case HeadingSource::heading:
    case HeadingSource::heading_magnetic:
      return BusParameter::heading;
    case HeadingSource::magnetic_heading:
      return BusParameter::magnetic_heading;
    default:
      return BusParameter::true_heading;
  }
}

/// What integrity monitoring says besides the validity of each value.
void note_doubts(OwnshipPose& pose, const OwnshipState& state, std::int64_t now_ns) {
  const PositionParameters& position =
      pose.position_source == PositionSource::ins ? ins_parameters : gps_parameters;
  for (const BusParameter parameter : {position.latitude, position.height, BusParameter::roll,
                                       BusParameter::pitch, parameter_of(pose.heading_source)}) {
    if (doubt_at(state, parameter, now_ns) == Doubt::excluded) pose.source_excluded = true;
  }
  for (const BusParameter parameter :
       {position.ground_speed, position.true_track, BusParameter::altitude_rate}) {
    const Validity validity = validity_at(state, parameter, now_ns, icd_row(parameter).timeout_ns);
    if (validity == Validity::implausible || validity == Validity::disagrees) {
      pose.velocity_doubted = true;
    }
  }
  pose.events = recent_events(state, now_ns);
}

}  // namespace

StateLimits state_limits(const BusProfile& profile) {
  StateLimits limits;
  limits.heading_reference = profile.heading_reference;
  limits.variation_east_positive = profile.variation_east_positive;
  limits.fixed_variation_deg = profile.fixed_variation_deg;
  return limits;
}

OwnshipPose ownship_pose(const OwnshipState& state, std::int64_t now_ns,
                         const StateLimits& limits) {
  OwnshipPose pose;
  place(pose, state, now_ns, limits);
  pose.roll_deg = pose_value(state, BusParameter::roll, now_ns, limits.attitude_timeout_ns);
  pose.pitch_deg = pose_value(state, BusParameter::pitch, now_ns, limits.attitude_timeout_ns);
  const Heading heading = best_heading(state, now_ns, limits);
  pose.heading_deg = heading.value;
  pose.heading_deg.value = heading_0_360(heading.value.value);
  pose.heading_source = heading.source;
  pose.radio_height_m =
      pose_value(state, BusParameter::radio_height, now_ns, limits::radio_height_timeout_ns);
  note_doubts(pose, state, now_ns);
  return pose;
}

}  // namespace ridgeline
