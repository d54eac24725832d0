#include "core/state/ownship_update.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/bus/bus_decoder.hpp"
#include "core/state/counting.hpp"
#include "core/state/integrity.hpp"
#include "core/state/plausibility.hpp"
#include "core/state/rivals.hpp"

namespace ridgeline {
namespace {

std::size_t index_of(BusParameter parameter) {
  return static_cast<std::size_t>(parameter);
}

/// A coordinate and the one it makes a fix with, or itself where it makes none.
struct FixCoordinates {
  BusParameter latitude;
  BusParameter longitude;
};
constexpr FixCoordinates gps_fix{BusParameter::gps_latitude, BusParameter::gps_longitude};
constexpr FixCoordinates ins_fix{BusParameter::ins_latitude, BusParameter::ins_longitude};

bool is_of(const FixCoordinates& fix, BusParameter parameter) {
  return parameter == fix.latitude || parameter == fix.longitude;
}

void count_fault(UpdateCounters& counters, Fault fault) {
  switch (fault) {
    case Fault::bus_not_data:
    case Fault::bus_not_classic:
      return bump(counters.not_data);
    case Fault::bus_length:
      return bump(counters.bad_length);
    case Fault::bus_type_reserved:
    case Fault::bus_type_mismatch:
    case Fault::bus_resolution:
    case Fault::bus_datum_unknown:
      return bump(counters.type_mismatch);
    case Fault::bus_value_not_finite:
      return bump(counters.not_finite);
    case Fault::bus_value_out_of_range:
      return bump(counters.out_of_range);
    case Fault::bus_parity:
      return bump(counters.bad_parity);
    case Fault::bus_no_computed_data:
      return bump(counters.no_computed_data);
    case Fault::bus_functional_test:
      return bump(counters.functional_test);
    case Fault::bus_failure_warning:
      return bump(counters.failure_warning);
    case Fault::bus_quality:
    case Fault::bus_digit:
      return bump(counters.suspect);
    case Fault::bus_unpaired:
      return bump(counters.unpaired_words);
    default:
      return bump(counters.ignored);
  }
}

/// The newest value of a parameter was refused; the last good one stays, with its own age.
void refuse(OwnshipState& state, BusParameter parameter, Validity why, std::int64_t time_ns) {
  Sample& sample = state.samples[index_of(parameter)];
  // A parameter that never had a good value stays missing: there is nothing to doubt.
  if (sample.validity != Validity::missing) sample.validity = why;
  state.refused_time_ns[index_of(parameter)] = time_ns;
}

/// A position is good or bad as a whole.
void refuse_value(OwnshipState& state, BusParameter parameter, Validity why, std::int64_t time_ns) {
  for (const FixCoordinates& fix : {gps_fix, ins_fix}) {
    if (!is_of(fix, parameter)) continue;
    PositionPairing& pairing = is_of(gps_fix, parameter) ? state.gps : state.ins;
    pairing.latitude.pending = false;
    pairing.longitude.pending = false;
    refuse(state, fix.latitude, why, time_ns);
    refuse(state, fix.longitude, why, time_ns);
    return;
  }
  refuse(state, parameter, why, time_ns);
}

void store(OwnshipState& state, BusParameter parameter, double value, std::int64_t time_ns,
           const Source& source) {
  Sample& sample = state.samples[index_of(parameter)];
  if (sample.validity != Validity::missing && sample.source != source) {
    bump(state.counters.source_changes);
    forget_rival(state, parameter, source);
  }
  sample = Sample{value, time_ns, Validity::valid, source};
  state.candidates[index_of(parameter)] = JumpCandidate{};
}

/// Whether another sender than the held one may be heard: only once the held value is stale.
bool source_is_accepted(const OwnshipState& state, BusParameter parameter, const Source& source,
                        std::int64_t time_ns) {
  const Sample& held = state[parameter];
  if (held.validity == Validity::missing || held.source == source) return true;
  return time_ns - held.time_ns > icd_row(parameter).timeout_ns;
}

/// Near the vertical, roll and heading may flip by half a turn between two samples of a true
/// motion.
bool rule_is_suspended(const OwnshipState& state, BusParameter parameter) {
  const bool flips = parameter == BusParameter::roll || parameter == BusParameter::heading ||
                     parameter == BusParameter::true_heading ||
                     parameter == BusParameter::magnetic_heading;
  const Sample& pitch = state[BusParameter::pitch];
  return flips && pitch.validity == Validity::valid &&
         std::abs(pitch.value) > limits::vertical_pitch_deg;
}

/// Counts a refused jump; true when it has persisted long enough to be believed.
bool jump_persists(JumpCandidate& candidate, const JumpRule& rule, double distance, double value,
                   double second, std::int64_t time_ns) {
  const bool agrees = candidate.count > 0 && time_ns >= candidate.time_ns &&
                      is_plausible_move(rule, distance, time_ns - candidate.time_ns);
  const auto count = static_cast<std::uint8_t>(agrees ? candidate.count + 1 : 1);
  candidate = JumpCandidate{value, second, time_ns, count};
  return count >= rule.persist_count;
}

/// Takes a single value in, unless it jumps.
void take_value(OwnshipState& state, BusParameter parameter, double value, std::int64_t time_ns,
                const Source& source, const BusProfile& profile) {
  const Sample& held = state[parameter];
  const JumpRule rule = jump_rule(parameter);
  const bool checked = rule.persist_count > 0 && held.validity != Validity::missing &&
                       !rule_is_suspended(state, parameter);
  if (checked && !is_plausible_move(rule, value_distance(parameter, held.value, value),
                                    time_ns - held.time_ns)) {
    JumpCandidate& candidate = state.candidates[index_of(parameter)];
    const double distance = value_distance(parameter, candidate.value, value);
    if (!jump_persists(candidate, rule, distance, value, 0.0, time_ns)) {
      bump(state.counters.implausible);
      refuse(state, parameter, Validity::implausible, time_ns);
      return;
    }
    bump(state.counters.jumps_believed);
    note_jump(state, time_ns);
  }
  bump(state.counters.decoded);
  store(state, parameter, value, time_ns, source);
  note_value(state, parameter, profile);
}

/// Takes a complete fix in, unless it jumps. Raises the counter of the frame that completed it.
void take_fix(OwnshipState& state, const FixCoordinates& fix, const PendingCoordinate& latitude,
              const PendingCoordinate& longitude) {
  // Receivers without a fix send 0 / 0; nobody flies over that very centimetre.
  if (latitude.value_deg == 0.0 && longitude.value_deg == 0.0) {
    bump(state.counters.out_of_range);
    refuse(state, fix.latitude, Validity::invalid, longitude.time_ns);
    return refuse(state, fix.longitude, Validity::invalid, longitude.time_ns);
  }
  const Sample& held_lat = state[fix.latitude];
  const Sample& held_lon = state[fix.longitude];
  const std::int64_t time_ns =
      latitude.time_ns < longitude.time_ns ? latitude.time_ns : longitude.time_ns;
  const std::int64_t elapsed_ns = time_ns - held_lat.time_ns;
  const double distance_m =
      rough_distance_m(held_lat.value, held_lon.value, latitude.value_deg, longitude.value_deg);
  if (held_lat.validity != Validity::missing &&
      !is_plausible_move(position_jump_rule, distance_m, elapsed_ns)) {
    JumpCandidate& candidate = state.candidates[index_of(fix.latitude)];
    const double moved_m = rough_distance_m(candidate.value, candidate.second, latitude.value_deg,
                                            longitude.value_deg);
    if (!jump_persists(candidate, position_jump_rule, moved_m, latitude.value_deg,
                       longitude.value_deg, time_ns)) {
      bump(state.counters.implausible);
      refuse(state, fix.latitude, Validity::implausible, time_ns);
      refuse(state, fix.longitude, Validity::implausible, time_ns);
      return;
    }
    bump(state.counters.jumps_believed);
    note_jump(state, time_ns);
  }
  bump(state.counters.decoded);
  store(state, fix.latitude, latitude.value_deg, latitude.time_ns, latitude.source);
  store(state, fix.longitude, longitude.value_deg, longitude.time_ns, longitude.source);
  note_fix(state, fix.latitude == BusParameter::gps_latitude);
}

/// Takes one coordinate in; the fix follows when its partner is there as well.
void take_coordinate(OwnshipState& state, const FixCoordinates& fix, BusParameter parameter,
                     const PendingCoordinate& coordinate, const BusProfile& profile) {
  PositionPairing& pairing = is_of(gps_fix, parameter) ? state.gps : state.ins;
  const bool is_latitude = parameter == fix.latitude;
  PendingCoordinate& mine = is_latitude ? pairing.latitude : pairing.longitude;
  PendingCoordinate& other = is_latitude ? pairing.longitude : pairing.latitude;
  if (mine.pending) bump(state.counters.unpaired_fixes);
  mine = coordinate;
  mine.pending = true;
  if (other.pending) {
    const bool belongs = other.source == mine.source &&
                         std::abs(mine.time_ns - other.time_ns) <= profile.fix_pair_limit_ns;
    if (belongs) {
      mine.pending = false;
      other.pending = false;
      return take_fix(state, fix, pairing.latitude, pairing.longitude);
    }
    bump(state.counters.unpaired_fixes);
    other.pending = false;
  }
  bump(state.counters.decoded);
}

void take_decoded(OwnshipState& state, const BusValue& decoded, const BusProfile& profile) {
  for (const FixCoordinates& fix : {gps_fix, ins_fix}) {
    if (!is_of(fix, decoded.parameter)) continue;
    const PendingCoordinate coordinate{true, decoded.value, decoded.time_ns, decoded.source};
    return take_coordinate(state, fix, decoded.parameter, coordinate, profile);
  }
  take_value(state, decoded.parameter, decoded.value, decoded.time_ns, decoded.source, profile);
}

/// Whether the message code says that the frame is a new one; counts it where not. Only
/// CANaerospace has such a code.
bool is_new_message(OwnshipState& state, const FrameTopic& topic, const BusFrame& frame,
                    const BusProfile& profile) {
  constexpr std::size_t code_byte = 3;
  if (profile.protocol != BusProtocol::canaerospace || frame.length <= code_byte) return true;
  SequenceWatch& watch = state.integrity.sequences[index_of(topic.parameter)];
  const SequenceStep step = sequence_step(watch, topic.source, frame.data[code_byte]);
  watch = step.next;
  for (int lost = 0; lost < step.missing; ++lost) bump(state.counters.lost_in_sequence);
  if (step.verdict == Sequence::begun_anew) note_replay(state, frame.time_ns);
  if (step.verdict != Sequence::duplicate && step.verdict != Sequence::behind) return true;
  bump(step.verdict == Sequence::duplicate ? state.counters.duplicated : state.counters.replayed);
  note_replay(state, frame.time_ns);
  return false;
}

/// Whether the frame may be looked at; counts it where not.
bool topic_is_taken(OwnshipState& state, const FrameTopic& topic, const BusFrame& frame,
                    const BusProfile& profile) {
  UpdateCounters& counters = state.counters;
  const Sample& held = state[topic.parameter];
  const std::int64_t time_ns = frame.time_ns;
  if (!topic.is_read) {
    bump(counters.other_channel);
  } else if (time_ns > state.now_ns + limits::future_tolerance_ns) {
    bump(counters.from_future);
  } else if (!source_is_accepted(state, topic.parameter, topic.source, time_ns)) {
    bump(counters.other_source);
    take_rival(state, frame, topic, profile);
  } else if (held.validity != Validity::missing && time_ns < held.time_ns) {
    bump(counters.out_of_order);
    note_replay(state, state.now_ns);
  } else {
    return is_new_message(state, topic, frame, profile);
  }
  return false;
}

void take_frame(OwnshipState& state, const BusFrame& frame, const BusProfile& profile) {
  UpdateCounters& counters = state.counters;
  bump(counters.frames);
  const std::optional<FrameTopic> topic = frame_topic(frame, profile);
  if (topic && !topic_is_taken(state, *topic, frame, profile)) return;
  const DecodeStep step = decoded_frame(state.decoder, frame, profile);
  state.decoder = step.memory;
  if (step.unpaired) bump(counters.unpaired_halves);
  if (step.value) return take_decoded(state, *step.value, profile);
  if (step.fault == Fault::none) return bump(counters.decoded);
  count_fault(counters, step.fault);
  if (topic && disowns_value(step.fault)) {
    refuse_value(state, topic->parameter, Validity::invalid, frame.time_ns);
  }
}

}  // namespace

OwnshipState update_ownship(const OwnshipState& previous, std::span<const BusFrame> frames,
                            std::int64_t now_ns, const BusProfile& profile) {
  OwnshipState state = previous;
  if (now_ns + limits::future_tolerance_ns < previous.now_ns) {
    // Ages against a new clock mean nothing: better no data than data of unknown age.
    state = OwnshipState{};
    state.counters = previous.counters;
    bump(state.counters.clock_resets);
    note_clock_step(state, now_ns);
  }
  // A clock may stand a little back, but not creep back: many small steps would keep old data
  // young.
  state.now_ns = std::max(state.now_ns, now_ns);
  for (const BusFrame& frame : frames) take_frame(state, frame, profile);
  return state;
}

Validity own_validity_at(const OwnshipState& state, BusParameter parameter, std::int64_t now_ns,
                         std::int64_t timeout_ns) {
  const Sample& sample = state[parameter];
  if (sample.validity == Validity::missing) return Validity::missing;
  const std::int64_t refused_ns = state.refused_time_ns[static_cast<std::size_t>(parameter)];
  const bool refused = sample.validity != Validity::valid;
  const std::int64_t heard_ns = refused ? refused_ns : sample.time_ns;
  return now_ns - heard_ns > timeout_ns ? Validity::stale : sample.validity;
}

Validity validity_at(const OwnshipState& state, BusParameter parameter, std::int64_t now_ns,
                     std::int64_t timeout_ns) {
  const Validity own = own_validity_at(state, parameter, now_ns, timeout_ns);
  if (own != Validity::valid) return own;
  switch (doubt_at(state, parameter, now_ns)) {
    case Doubt::frozen:
      return Validity::frozen;
    case Doubt::disagrees:
      return Validity::disagrees;
    default:
      return own;
  }
}

}  // namespace ridgeline
