#include "core/state/motion_checks.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/bus/canaerospace.hpp"
#include "core/state/counting.hpp"
#include "core/state/plausibility.hpp"

namespace ridgeline {
namespace {

using P = BusParameter;
constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

constexpr ConfirmRule motion_confirm{limits::attitude_disagree_ns, limits::agree_again_ns};
constexpr ConfirmRule receiver_confirm{limits::position_disagree_ns, limits::agree_again_ns};
constexpr DriftRule reckoned_rule{limits::reckoned_limit_m, limits::reckoned_forgiven_mps,
                                  limits::reckoned_forgiven_of_speed, false, motion_confirm};
constexpr DriftRule climbed_rule{limits::climbed_limit_m, limits::climbed_forgiven_mps,
                                 limits::climbed_forgiven_of_rate, false, motion_confirm};
constexpr DriftRule barometer_rule{limits::barometer_limit_m, limits::barometer_forgiven_mps,
                                   limits::barometer_forgiven_of_rate, true, receiver_confirm};
constexpr DriftRule receivers_rule{limits::receivers_limit_m, limits::receivers_forgiven_mps, 0.0,
                                   true, receiver_confirm};
constexpr DriftRule receiver_heights_rule{
    limits::receiver_heights_limit_m, limits::barometer_forgiven_mps,
    limits::barometer_forgiven_of_rate, true, receiver_confirm};

/// A valid value at a time, NaN where there is none.
double value_at(const OwnshipState& state, P parameter, std::int64_t time_ns) {
  const bool valid =
      own_validity_at(state, parameter, time_ns, icd_row(parameter).timeout_ns) == Validity::valid;
  return valid ? state[parameter].value : nothing;
}

double first_of(double a, double b) {
  return std::isnan(a) ? b : a;
}

/// Through the air where that is known, else over the ground; NaN below least_speed_mps.
double speed_at(const OwnshipState& state, std::int64_t time_ns) {
  const double ground_mps = first_of(value_at(state, P::gps_ground_speed, time_ns),
                                     value_at(state, P::ins_ground_speed, time_ns));
  const double speed_mps = first_of(value_at(state, P::true_airspeed, time_ns), ground_mps);
  return speed_mps >= limits::least_speed_mps ? speed_mps : nothing;
}

double some_heading_at(const OwnshipState& state, std::int64_t time_ns) {
  return first_of(value_at(state, P::true_heading, time_ns),
                  first_of(value_at(state, P::heading, time_ns),
                           value_at(state, P::magnetic_heading, time_ns)));
}

double track_at(const OwnshipState& state, std::int64_t time_ns) {
  return first_of(value_at(state, P::gps_true_track, time_ns),
                  value_at(state, P::ins_true_track, time_ns));
}

FreezeWatch& freeze_of(OwnshipState& state, Compared what) {
  return state.integrity.freezes[static_cast<std::size_t>(what)];
}

/// One more sample for a freeze watch; `moved` may be NaN: nobody says that it moves.
void note_sample(OwnshipState& state, Compared what, double value, double second,
                 std::int64_t time_ns, double moved, const FreezeRule& rule) {
  FreezeWatch& watch = freeze_of(state, what);
  const bool before = watch.raised;
  watch = stood_still(watch, value, second, time_ns, std::isnan(moved) ? 0.0 : moved, rule);
  if (watch.raised && !before) bump(state.counters.freezes);
}

double elapsed_s(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

/// Moves a drift watch on and counts when it begins to contradict.
void move_on(OwnshipState& state, DriftWatch& watch, const std::array<double, 2>& more_m,
             std::int64_t time_ns, double rate_mps, const DriftRule& rule) {
  const bool before = watch.contradiction.raised;
  watch = drifted(watch, more_m[0], more_m[1], time_ns, rate_mps, rule);
  if (watch.contradiction.raised && !before) bump(state.counters.disagreements);
}

void compare_pair(OwnshipState& state, Confirmation& pair, std::int64_t& pair_time_ns, double a_deg,
                  double b_deg, std::int64_t time_ns) {
  if (std::isnan(a_deg) || std::isnan(b_deg)) return;
  const bool before = pair.raised;
  const bool apart = std::abs(wrapped_deg(a_deg - b_deg)) > limits::heading_kinds_disagree_deg;
  pair = confirmed(pair, apart, time_ns, motion_confirm);
  pair_time_ns = time_ns;
  if (pair.raised && !before) bump(state.counters.disagreements);
}

/// East and north of b from a, m.
std::array<double, 2> from_to_m(double latitude_a_deg, double longitude_a_deg,
                                double latitude_b_deg, double longitude_b_deg) {
  const double north_m = std::copysign(rough_distance_m(latitude_a_deg, 0.0, latitude_b_deg, 0.0),
                                       latitude_b_deg - latitude_a_deg);
  const double middle_deg = 0.5 * (latitude_a_deg + latitude_b_deg);
  const double turn_deg = wrapped_deg(longitude_b_deg - longitude_a_deg);
  const double east_m = std::copysign(rough_distance_m(0.0, 0.0, 0.0, turn_deg), turn_deg) *
                        std::cos(middle_deg * rad_per_deg);
  return {east_m, north_m};
}

struct ReceiverParameters {
  P latitude, longitude, height, speed, track;
};
constexpr std::array<ReceiverParameters, 2> receivers = {{
    {P::gps_latitude, P::gps_longitude, P::gps_height, P::gps_ground_speed, P::gps_true_track},
    {P::ins_latitude, P::ins_longitude, P::ins_height, P::ins_ground_speed, P::ins_true_track},
}};

/// GPS from INS, the INS fix carried on to the time of the GPS one.
void compare_fixes(OwnshipState& state, std::int64_t time_ns) {
  ReceiverPair& pair = state.integrity.receivers;
  const FixTrack& gps = state.integrity.fixes[0];
  const FixTrack& ins = state.integrity.fixes[1];
  const Sample& latitude = state[P::ins_latitude];
  if (!ins.started || latitude.validity != Validity::valid ||
      std::abs(time_ns - ins.time_ns) > limits::second_ns) {
    return;
  }
  std::array<double, 2> apart_m =
      from_to_m(ins.latitude_deg, ins.longitude_deg, gps.latitude_deg, gps.longitude_deg);
  const double late_s = elapsed_s(ins.time_ns, time_ns);
  if (ins.moves) {
    apart_m[0] -= ins.east_mps * late_s;
    apart_m[1] -= ins.north_mps * late_s;
  }
  const std::array<double, 2> more_m = {pair.apart_known ? apart_m[0] - pair.apart_east_m : 0.0,
                                        pair.apart_known ? apart_m[1] - pair.apart_north_m : 0.0};
  pair.apart_known = true;
  pair.apart_east_m = apart_m[0];
  pair.apart_north_m = apart_m[1];
  move_on(state, pair.fixes, more_m, time_ns, 0.0, receivers_rule);
}

void compare_heights(OwnshipState& state, std::int64_t time_ns, double climb_mps) {
  ReceiverPair& pair = state.integrity.receivers;
  const Sample& ins = state[P::ins_height];
  if (ins.validity != Validity::valid || std::abs(time_ns - ins.time_ns) > limits::second_ns) {
    return;
  }
  const double rate_mps = std::isnan(climb_mps) ? 0.0 : climb_mps;
  const double carried_m = ins.value + rate_mps * elapsed_s(ins.time_ns, time_ns);
  const double apart_m = state[P::gps_height].value - carried_m;
  const double more_m = pair.height_known ? apart_m - pair.apart_m : 0.0;
  pair.height_known = true;
  pair.apart_m = apart_m;
  move_on(state, pair.heights, {more_m, 0.0}, time_ns, rate_mps, receiver_heights_rule);
}

}  // namespace

void watch_roll(OwnshipState& state) {
  const Sample& roll = state[P::roll];
  FreezeWatch& watch = freeze_of(state, Compared::roll);
  const double heading_deg = some_heading_at(state, roll.time_ns);
  const double pitch_deg = value_at(state, P::pitch, roll.time_ns);
  const double speed_mps = speed_at(state, roll.time_ns);
  double moved_deg = nothing;
  if (std::abs(pitch_deg) < limits::steep_deg && std::abs(roll.value) < limits::steep_deg) {
    constexpr double g_mps2 = 9.80665;
    const double turn_dps = g_mps2 * std::tan(roll.value * rad_per_deg) / speed_mps / rad_per_deg;
    moved_deg =
        wrapped_deg(heading_deg - watch.other) - turn_dps * elapsed_s(watch.time_ns, roll.time_ns);
  }
  note_sample(state, Compared::roll, roll.value, 0.0, roll.time_ns, moved_deg,
              {limits::roll_freeze_deg, limits::attitude_freeze_ns});
  watch.other = heading_deg;
}

void watch_pitch(OwnshipState& state) {
  const Sample& pitch = state[P::pitch];
  FreezeWatch& watch = freeze_of(state, Compared::pitch);
  const double climb_mps = value_at(state, P::altitude_rate, pitch.time_ns);
  const double steep_or_not_deg =
      std::atan2(climb_mps, speed_at(state, pitch.time_ns)) / rad_per_deg;
  const bool steep = std::abs(steep_or_not_deg) > limits::steep_path_deg;
  const double path_deg = steep ? nothing : steep_or_not_deg;
  note_sample(state, Compared::pitch, pitch.value, 0.0, pitch.time_ns, path_deg - watch.other,
              {limits::pitch_freeze_deg, limits::pitch_freeze_ns});
  watch.other = path_deg;
}

void watch_heading(OwnshipState& state, BusParameter parameter) {
  const Sample& heading = state[parameter];
  const Compared what = parameter == P::heading        ? Compared::heading
                        : parameter == P::true_heading ? Compared::true_heading
                                                       : Compared::magnetic_heading;
  FreezeWatch& watch = freeze_of(state, what);
  const bool flies = !std::isnan(speed_at(state, heading.time_ns));
  const double track_deg = flies ? track_at(state, heading.time_ns) : nothing;
  note_sample(state, what, heading.value, 0.0, heading.time_ns,
              wrapped_deg(track_deg - watch.other),
              {limits::heading_freeze_deg, limits::attitude_freeze_ns});
  watch.other = track_deg;
}

void compare_headings(OwnshipState& state, std::int64_t time_ns, const BusProfile& profile) {
  const double pitch_deg = value_at(state, P::pitch, time_ns);
  if (std::abs(pitch_deg) > limits::vertical_pitch_deg) return;
  const double given_deg = value_at(state, P::magnetic_variation, time_ns);
  const double signed_deg = profile.variation_east_positive ? given_deg : -given_deg;
  const double variation_deg = first_of(signed_deg, profile.fixed_variation_deg.value_or(nothing));
  const double raw_deg = value_at(state, P::heading, time_ns);
  const double heading_deg = profile.heading_reference == HeadingReference::true_north ? raw_deg
                             : profile.heading_reference == HeadingReference::magnetic_north
                                 ? raw_deg + variation_deg
                                 : nothing;
  const double true_deg = value_at(state, P::true_heading, time_ns);
  const double magnetic_deg = value_at(state, P::magnetic_heading, time_ns) + variation_deg;
  HeadingPairs& pairs = state.integrity.headings;
  compare_pair(state, pairs.true_heading, pairs.time_ns[0], true_deg, heading_deg, time_ns);
  compare_pair(state, pairs.true_magnetic, pairs.time_ns[1], true_deg, magnetic_deg, time_ns);
  compare_pair(state, pairs.heading_magnetic, pairs.time_ns[2], heading_deg, magnetic_deg, time_ns);
}

void watch_fix(OwnshipState& state, bool is_gps) {
  const ReceiverParameters& parameters = receivers[is_gps ? 0 : 1];
  FixTrack& track = state.integrity.fixes[is_gps ? 0 : 1];
  const Sample& latitude = state[parameters.latitude];
  const Sample& longitude = state[parameters.longitude];
  const FixTrack before = track;
  const std::int64_t time_ns = latitude.time_ns;
  const double speed_mps = value_at(state, parameters.speed, time_ns);
  const double track_deg = value_at(state, parameters.track, time_ns);
  track = FixTrack{true, latitude.source, latitude.value, longitude.value, time_ns, false, 0.0,
                   0.0,  before.reckoned};
  track.moves = !std::isnan(speed_mps) && !std::isnan(track_deg);
  if (track.moves) {
    track.east_mps = speed_mps * std::sin(track_deg * rad_per_deg);
    track.north_mps = speed_mps * std::cos(track_deg * rad_per_deg);
  }
  const bool same = before.started && before.source == latitude.source;
  if (!same) {
    // Another receiver is not where this one was, by what receivers differ.
    track.reckoned = DriftWatch{};
    state.integrity.receivers.apart_known = false;
    state.integrity.receivers.fixes = DriftWatch{};
  }
  const double since_s = elapsed_s(before.time_ns, time_ns);
  note_sample(state, is_gps ? Compared::gps_fix : Compared::ins_fix, latitude.value,
              longitude.value, time_ns, speed_mps * since_s,
              {limits::fix_freeze_m, limits::position_freeze_ns});
  if (same && before.moves && track.moves) {
    std::array<double, 2> more_m = from_to_m(before.latitude_deg, before.longitude_deg,
                                             track.latitude_deg, track.longitude_deg);
    more_m[0] -= 0.5 * (before.east_mps + track.east_mps) * since_s;
    more_m[1] -= 0.5 * (before.north_mps + track.north_mps) * since_s;
    move_on(state, track.reckoned, more_m, time_ns, speed_mps, reckoned_rule);
  } else {
    track.reckoned.started = false;
  }
  if (is_gps) compare_fixes(state, time_ns);
}

void watch_height(OwnshipState& state, bool is_gps) {
  const P parameter = receivers[is_gps ? 0 : 1].height;
  const Sample& height = state[parameter];
  HeightTrack& track = state.integrity.heights[is_gps ? 0 : 1];
  const HeightTrack before = track;
  const std::int64_t time_ns = height.time_ns;
  const double climb_mps = value_at(state, P::altitude_rate, time_ns);
  const Sample& pressure = state[P::standard_altitude];
  track.started = true;
  track.source = height.source;
  track.height_m = height.value;
  track.time_ns = time_ns;
  track.climbs = !std::isnan(climb_mps);
  track.climb_mps = track.climbs ? climb_mps : 0.0;
  track.has_pressure = !std::isnan(value_at(state, P::standard_altitude, time_ns)) &&
                       time_ns - pressure.time_ns <= limits::compared_age_ns;
  track.pressure_m = pressure.value;
  const bool same = before.started && before.source == height.source;
  if (!same) {
    track.climbed = track.barometer = DriftWatch{};
    state.integrity.receivers.height_known = false;
    state.integrity.receivers.heights = DriftWatch{};
  }
  const double since_s = elapsed_s(before.time_ns, time_ns);
  const double rose_m = height.value - before.height_m;
  const bool both_pressures = same && before.has_pressure && track.has_pressure;
  const bool both_climbs = same && before.climbs && track.climbs;
  const double climbed_m = 0.5 * (before.climb_mps + track.climb_mps) * since_s;
  const double pressed_m = track.pressure_m - before.pressure_m;
  note_sample(state, is_gps ? Compared::gps_height : Compared::ins_height, height.value, 0.0,
              time_ns,
              both_climbs      ? climbed_m
              : both_pressures ? pressed_m
                               : nothing,
              {limits::height_freeze_m, limits::position_freeze_ns});
  if (both_climbs) {
    move_on(state, track.climbed, {rose_m - climbed_m, 0.0}, time_ns, climb_mps, climbed_rule);
  } else {
    track.climbed.started = false;
  }
  if (both_pressures) {
    move_on(state, track.barometer, {rose_m - pressed_m, 0.0}, time_ns, track.climb_mps,
            barometer_rule);
  }
  if (is_gps) compare_heights(state, time_ns, climb_mps);
}

}  // namespace ridgeline
