#include "core/state/integrity.hpp"

#include <cmath>

#include "core/bus/canaerospace.hpp"
#include "core/state/counting.hpp"
#include "core/state/motion_checks.hpp"
#include "core/state/rivals.hpp"

namespace ridgeline {
namespace {

using P = BusParameter;

Votes sum(const Votes& a, const Votes& b) {
  return {a.present + b.present, a.against + b.against};
}

bool is_frozen(const OwnshipState& state, Compared what) {
  return state.integrity.freezes[static_cast<std::size_t>(what)].raised;
}

Votes vote_of(const DriftWatch& watch, std::int64_t now_ns) {
  const bool against = contradicts(watch, now_ns);
  return {against || is_present(watch, now_ns) ? 1 : 0, against ? 1 : 0};
}

Votes vote_of(const HeadingPairs& pairs, const Confirmation& pair, std::size_t index,
              std::int64_t now_ns) {
  const std::int64_t age_ns = now_ns - pairs.time_ns[index];
  const bool against = pair.raised && age_ns <= limits::contradiction_memory_ns;
  const bool present = pairs.time_ns[index] != 0 && age_ns <= limits::heading_timeout_ns;
  return {against || present ? 1 : 0, against ? 1 : 0};
}

/// `of_own` comes from the same receiver or is a rate of the value: it counts against only where
/// nobody else agrees with the value, and never for it.
Doubt weighed(const Votes& others, bool of_own_against) {
  const bool somebody_agrees = others.present > others.against;
  if (others.against > 0 && !somebody_agrees) return Doubt::disagrees;
  if (of_own_against && !somebody_agrees) return Doubt::disagrees;
  return others.against > 0 ? Doubt::excluded : Doubt::none;
}

Doubt fix_doubt(const OwnshipState& state, bool is_gps, std::int64_t now_ns) {
  const IntegrityState& integrity = state.integrity;
  const Votes rivals = rival_votes(state, is_gps ? Compared::gps_fix : Compared::ins_fix, now_ns);
  // One that stands still leaves the other one; it is no witness against it.
  const Votes receivers = is_frozen(state, is_gps ? Compared::ins_fix : Compared::gps_fix)
                              ? Votes{}
                              : vote_of(integrity.receivers.fixes, now_ns);
  return weighed(sum(rivals, receivers),
                 contradicts(integrity.fixes[is_gps ? 0 : 1].reckoned, now_ns));
}

Doubt height_doubt(const OwnshipState& state, bool is_gps, std::int64_t now_ns) {
  const IntegrityState& integrity = state.integrity;
  const HeightTrack& track = integrity.heights[is_gps ? 0 : 1];
  const Votes rivals =
      rival_votes(state, is_gps ? Compared::gps_height : Compared::ins_height, now_ns);
  const Votes receivers = is_frozen(state, is_gps ? Compared::ins_height : Compared::gps_height)
                              ? Votes{}
                              : vote_of(integrity.receivers.heights, now_ns);
  const Votes others = sum(receivers, vote_of(track.barometer, now_ns));
  return weighed(sum(rivals, others), contradicts(track.climbed, now_ns));
}

Doubt heading_doubt(const OwnshipState& state, BusParameter parameter, std::int64_t now_ns) {
  const HeadingPairs& pairs = state.integrity.headings;
  const Votes th = vote_of(pairs, pairs.true_heading, 0, now_ns);
  const Votes tm = vote_of(pairs, pairs.true_magnetic, 1, now_ns);
  const Votes hm = vote_of(pairs, pairs.heading_magnetic, 2, now_ns);
  const Votes rivals = rival_votes(state, *compared_as(parameter), now_ns);
  if (parameter == P::true_heading) return weighed(sum(rivals, sum(th, tm)), false);
  if (parameter == P::heading) return weighed(sum(rivals, sum(th, hm)), false);
  return weighed(sum(rivals, sum(tm, hm)), false);
}

/// A speed, track or altitude rate that contradicts the fixes or heights it goes with.
Doubt velocity_doubt(const DriftWatch& watch, std::int64_t now_ns) {
  return contradicts(watch, now_ns) ? Doubt::disagrees : Doubt::none;
}

Doubt contradiction_of(const OwnshipState& state, BusParameter parameter, std::int64_t now_ns) {
  const IntegrityState& integrity = state.integrity;
  switch (parameter) {
    case P::roll:
      return weighed(rival_votes(state, Compared::roll, now_ns), false);
    case P::pitch:
      return weighed(rival_votes(state, Compared::pitch, now_ns), false);
    case P::heading:
    case P::true_heading:
    case P::magnetic_heading:
      return heading_doubt(state, parameter, now_ns);
    case P::gps_latitude:
    case P::gps_longitude:
      return fix_doubt(state, true, now_ns);
    case P::ins_latitude:
    case P::ins_longitude:
      return fix_doubt(state, false, now_ns);
    case P::gps_height:
    case P::ins_height:
      return height_doubt(state, parameter == P::gps_height, now_ns);
    case P::gps_ground_speed:
    case P::gps_true_track:
      return velocity_doubt(integrity.fixes[0].reckoned, now_ns);
    case P::ins_ground_speed:
    case P::ins_true_track:
      return velocity_doubt(integrity.fixes[1].reckoned, now_ns);
    case P::altitude_rate: {
      const Doubt gps = velocity_doubt(integrity.heights[0].climbed, now_ns);
      return gps != Doubt::none ? gps : velocity_doubt(integrity.heights[1].climbed, now_ns);
    }
    default:
      return Doubt::none;
  }
}

/// UTC of the bus against the time of its frame: both run at one rate, or one of them stepped.
void note_utc(OwnshipState& state) {
  const Sample& utc = state[P::utc];
  constexpr double day_s = 86400.0;
  constexpr std::int64_t day_ns = 86400 * limits::second_ns;
  const double received_s = static_cast<double>(utc.time_ns % day_ns) * 1e-9;
  ClockWatch& clock = state.integrity.clock;
  const double ahead_s = std::remainder(received_s - utc.value, day_s);
  if (!clock.started) {
    clock.started = true;
    clock.ahead_s = ahead_s;
  }
  if (std::abs(std::remainder(ahead_s - clock.ahead_s, day_s)) <= limits::clock_step_s) return;
  clock.ahead_s = ahead_s;
  bump(state.counters.clock_steps);
  note_clock_step(state, utc.time_ns);
}

}  // namespace

void note_value(OwnshipState& state, BusParameter parameter, const BusProfile& profile) {
  switch (parameter) {
    case P::roll:
      return watch_roll(state);
    case P::pitch:
      return watch_pitch(state);
    case P::heading:
    case P::true_heading:
    case P::magnetic_heading:
      watch_heading(state, parameter);
      return compare_headings(state, state[parameter].time_ns, profile);
    case P::gps_height:
    case P::ins_height:
      return watch_height(state, parameter == P::gps_height);
    case P::utc:
      return note_utc(state);
    default:
      return;
  }
}

void note_fix(OwnshipState& state, bool is_gps) {
  watch_fix(state, is_gps);
}

void note_jump(OwnshipState& state, std::int64_t time_ns) {
  state.integrity.jumped = true;
  state.integrity.jump_ns = time_ns;
}

void note_replay(OwnshipState& state, std::int64_t time_ns) {
  ReplayWatch& replay = state.integrity.replay;
  const std::int64_t since_ns = time_ns - replay.window_ns;
  if (replay.count == 0 || since_ns < 0 || since_ns > limits::replay_window_ns) {
    replay.window_ns = time_ns;
    replay.count = 0;
  }
  if (replay.count < limits::replay_count) ++replay.count;
  if (replay.count < limits::replay_count) return;
  const bool is_new = !replay.flagged || time_ns - replay.flag_ns > limits::replay_hold_ns;
  if (is_new) bump(state.counters.replay_bursts);
  replay.flagged = true;
  replay.flag_ns = time_ns;
}

void note_clock_step(OwnshipState& state, std::int64_t time_ns) {
  state.integrity.clock.stepped = true;
  state.integrity.clock.step_ns = time_ns;
}

Doubt doubt_at(const OwnshipState& state, BusParameter parameter, std::int64_t now_ns) {
  const std::optional<Compared> what = compared_as(parameter);
  if (what && is_frozen(state, *what)) return Doubt::frozen;
  return contradiction_of(state, parameter, now_ns);
}

RecentEvents recent_events(const OwnshipState& state, std::int64_t now_ns) {
  const IntegrityState& integrity = state.integrity;
  const auto recent = [now_ns](bool was, std::int64_t at_ns, std::int64_t hold_ns) {
    return was && now_ns - at_ns <= hold_ns;
  };
  return {recent(integrity.clock.stepped, integrity.clock.step_ns, limits::clock_hold_ns),
          recent(integrity.replay.flagged, integrity.replay.flag_ns, limits::replay_hold_ns),
          recent(integrity.jumped, integrity.jump_ns, limits::jump_hold_ns)};
}

}  // namespace ridgeline
