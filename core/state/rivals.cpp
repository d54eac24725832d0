#include "core/state/rivals.hpp"

#include <array>
#include <cmath>

#include "core/state/counting.hpp"
#include "core/state/plausibility.hpp"

namespace ridgeline {
namespace {

/// How far two senders may differ, and how much more for each second between their samples.
struct RivalRule {
  BusParameter parameter;  ///< the latitude, for positions
  BusParameter second;     ///< the longitude; else the same
  double limit;
  double per_s;
  ConfirmRule confirm;
};

constexpr ConfirmRule angle_confirm{limits::attitude_disagree_ns, limits::agree_again_ns};
constexpr ConfirmRule place_confirm{limits::position_disagree_ns, limits::agree_again_ns};

using P = BusParameter;
// In the order of Compared.
constexpr std::array<RivalRule, compared_count> rules = {{
    {P::roll, P::roll, limits::roll_disagree_deg, limits::roll_disagree_dps, angle_confirm},
    {P::pitch, P::pitch, limits::pitch_disagree_deg, limits::pitch_disagree_dps, angle_confirm},
    {P::heading, P::heading, limits::heading_disagree_deg, limits::heading_disagree_dps,
     angle_confirm},
    {P::true_heading, P::true_heading, limits::heading_disagree_deg, limits::heading_disagree_dps,
     angle_confirm},
    {P::magnetic_heading, P::magnetic_heading, limits::heading_disagree_deg,
     limits::heading_disagree_dps, angle_confirm},
    {P::gps_latitude, P::gps_longitude, limits::fix_disagree_m, limits::fix_disagree_mps,
     place_confirm},
    {P::ins_latitude, P::ins_longitude, limits::fix_disagree_m, limits::fix_disagree_mps,
     place_confirm},
    {P::gps_height, P::gps_height, limits::height_disagree_m, limits::height_disagree_mps,
     place_confirm},
    {P::ins_height, P::ins_height, limits::height_disagree_m, limits::height_disagree_mps,
     place_confirm},
}};

const RivalRule& rule_of(Compared what) {
  return rules[static_cast<std::size_t>(what)];
}
std::array<Rival, rival_count>& rivals_of(OwnshipState& state, Compared what) {
  return state.integrity.rivals[static_cast<std::size_t>(what)];
}

bool is_fix(const RivalRule& rule) {
  return rule.parameter != rule.second;
}

struct Place {
  double value, second;
  std::int64_t time_ns;
};

bool apart(const RivalRule& rule, const Place& a, const Place& b) {
  const double between_s = std::abs(static_cast<double>(a.time_ns - b.time_ns)) * 1e-9;
  const double distance = is_fix(rule) ? rough_distance_m(a.value, a.second, b.value, b.second)
                                       : value_distance(rule.parameter, a.value, b.value);
  return distance > rule.limit + rule.per_s * between_s;
}

Place place_of(const Rival& rival) {
  return {rival.value, rival.second, rival.time_ns};
}

bool is_fresh(const Rival& rival, const RivalRule& rule, std::int64_t now_ns) {
  return rival.used && rival.valued && now_ns - rival.time_ns <= icd_row(rule.parameter).timeout_ns;
}

/// The place of a sender: its own, a free one, or that of one that has long been silent.
Rival* slot_for(std::array<Rival, rival_count>& rivals, const Source& source,
                std::int64_t time_ns) {
  for (Rival& rival : rivals) {
    if (rival.used && rival.source == source) return &rival;
  }
  for (Rival& rival : rivals) {
    if (rival.used && time_ns - rival.time_ns <= limits::contradiction_memory_ns) continue;
    rival = Rival{};
    rival.used = true;
    rival.source = source;
    rival.time_ns = time_ns;
    return &rival;
  }
  return nullptr;
}

/// Joins the coordinates of a rival's fix; whether it is whole.
bool fix_is_whole(Rival& rival, const RivalRule& rule, const BusValue& value,
                  const BusProfile& profile) {
  const bool is_latitude = value.parameter == rule.parameter;
  PendingCoordinate& mine = is_latitude ? rival.pairing.latitude : rival.pairing.longitude;
  PendingCoordinate& other = is_latitude ? rival.pairing.longitude : rival.pairing.latitude;
  mine = {true, value.value, value.time_ns, value.source};
  if (!other.pending) return false;
  other.pending = false;
  if (std::abs(mine.time_ns - other.time_ns) > profile.fix_pair_limit_ns) return false;
  mine.pending = false;
  rival.value = rival.pairing.latitude.value_deg;
  rival.second = rival.pairing.longitude.value_deg;
  return true;
}

/// Two that agree with each other against the held one: the first of them becomes the held one.
void vote(OwnshipState& state, Compared what, std::int64_t time_ns) {
  const RivalRule& rule = rule_of(what);
  auto& rivals = rivals_of(state, what);
  for (const Rival& rival : rivals) {
    if (!is_fresh(rival, rule, time_ns) || !rival.contradiction.raised) return;
  }
  if (apart(rule, place_of(rivals[0]), place_of(rivals[1]))) return;
  const Rival winner = rivals[0];
  const auto take = [&](BusParameter parameter, double value) {
    const auto index = static_cast<std::size_t>(parameter);
    state.samples[index] = Sample{value, winner.time_ns, Validity::valid, winner.source};
    state.candidates[index] = JumpCandidate{};
    bump(state.counters.source_changes);
  };
  take(rule.parameter, winner.value);
  if (is_fix(rule)) take(rule.second, winner.second);
  state.decoder = DecoderMemory{};
  bump(state.counters.outvoted);
  rivals[0] = Rival{};
  rivals[1].contradiction = Confirmation{};
}

}  // namespace

std::optional<Compared> compared_as(BusParameter parameter) {
  for (std::size_t index = 0; index < rules.size(); ++index) {
    if (rules[index].parameter == parameter || rules[index].second == parameter) {
      return static_cast<Compared>(index);
    }
  }
  return std::nullopt;
}

Votes rival_votes(const OwnshipState& state, Compared what, std::int64_t now_ns) {
  Votes votes;
  for (const Rival& rival : state.integrity.rivals[static_cast<std::size_t>(what)]) {
    const bool against = rival.used && rival.valued && rival.contradiction.raised &&
                         now_ns - rival.time_ns <= limits::contradiction_memory_ns;
    if (!against && !is_fresh(rival, rule_of(what), now_ns)) continue;
    ++votes.present;
    votes.against += against ? 1 : 0;
  }
  return votes;
}

void take_rival(OwnshipState& state, const BusFrame& frame, const FrameTopic& topic,
                const BusProfile& profile) {
  const std::optional<Compared> what = compared_as(topic.parameter);
  if (!what) return;
  const RivalRule& rule = rule_of(*what);
  Rival* rival = slot_for(rivals_of(state, *what), topic.source, frame.time_ns);
  if (rival == nullptr || frame.time_ns < rival->time_ns) return;
  const DecodeStep step = decoded_frame(rival->decoder, frame, profile);
  rival->decoder = step.memory;
  if (!step.value) {
    // A sender that says that it has no value contradicts nobody.
    if (disowns_value(step.fault)) rival->valued = false;
    return;
  }
  if (is_fix(rule) ? !fix_is_whole(*rival, rule, *step.value, profile) : false) return;
  if (!is_fix(rule)) rival->value = step.value->value;
  if (is_fix(rule) && rival->value == 0.0 && rival->second == 0.0) return;  // no fix
  rival->time_ns = frame.time_ns;
  rival->valued = true;
  const Sample& held = state[rule.parameter];
  if (held.validity != Validity::valid) return;
  const Place place{held.value, state[rule.second].value, held.time_ns};
  const bool before = rival->contradiction.raised;
  rival->contradiction = confirmed(rival->contradiction, apart(rule, place, place_of(*rival)),
                                   frame.time_ns, rule.confirm);
  if (rival->contradiction.raised && !before) bump(state.counters.disagreements);
  vote(state, *what, frame.time_ns);
}

void forget_rival(OwnshipState& state, BusParameter parameter, const Source& held) {
  const std::optional<Compared> what = compared_as(parameter);
  if (!what) return;
  for (Rival& rival : rivals_of(state, *what)) {
    // What was said against the one before is not said against this one.
    if (rival.used && rival.source == held) rival = Rival{};
    rival.contradiction = Confirmation{};
  }
}

}  // namespace ridgeline
