#include "core/monitor/availability.hpp"

#include <array>

namespace ridgeline {
namespace {

struct ReasonRow {
  std::string_view word;
  Mode mode;
  std::string_view text;
};

constexpr std::array<ReasonRow, reason_count> reason_rows = {{
#define RL_REASON(word, mode, text) {#word, Mode::mode, text},
#include "config/reasons.def"
#undef RL_REASON
}};

const ReasonRow& row_of(Reason reason) {
  return reason_rows[static_cast<std::size_t>(reason)];
}

/// What each failure of one value is called.
struct ValueReasons {
  Reason missing;
  Reason stale;
  Reason implausible;
  Reason invalid;
  Reason frozen;
  Reason disagrees;
};
constexpr ValueReasons attitude_reasons{Reason::attitude_missing,     Reason::attitude_stale,
                                        Reason::attitude_implausible, Reason::attitude_invalid,
                                        Reason::attitude_frozen,      Reason::attitude_disagrees};
constexpr ValueReasons heading_reasons{Reason::heading_missing,     Reason::heading_stale,
                                       Reason::heading_implausible, Reason::heading_invalid,
                                       Reason::heading_frozen,      Reason::heading_disagrees};
constexpr ValueReasons position_reasons{Reason::position_missing,     Reason::position_stale,
                                        Reason::position_implausible, Reason::position_invalid,
                                        Reason::position_frozen,      Reason::position_disagrees};
constexpr ValueReasons height_reasons{Reason::height_missing,     Reason::height_stale,
                                      Reason::height_implausible, Reason::height_invalid,
                                      Reason::height_frozen,      Reason::height_disagrees};

void judge(Availability& result, const PoseValue& value, const ValueReasons& reasons) {
  switch (value.validity) {
    case Validity::valid:
      return;
    case Validity::missing:
      return add_reason(result, reasons.missing);
    case Validity::stale:
      return add_reason(result, reasons.stale);
    case Validity::implausible:
      return add_reason(result, reasons.implausible);
    case Validity::invalid:
      return add_reason(result, reasons.invalid);
    case Validity::frozen:
      return add_reason(result, reasons.frozen);
    case Validity::disagrees:
      return add_reason(result, reasons.disagrees);
    case Validity::reference_unknown:
      return add_reason(result, Reason::heading_reference_unknown);
  }
}

}  // namespace

std::string_view reason_word(Reason reason) {
  return row_of(reason).word;
}
std::string_view reason_text(Reason reason) {
  return row_of(reason).text;
}
Mode reason_mode(Reason reason) {
  return row_of(reason).mode;
}

std::string_view mode_word(Mode mode) {
  constexpr std::array<std::string_view, 3> words = {"svs", "degraded", "removed"};
  return words[static_cast<std::size_t>(mode)];
}

void add_reason(Availability& availability, Reason reason) {
  for (const Reason present : availability.reasons) {
    if (present == reason) return;
  }
  availability.reasons.push_back(reason);
  const Mode demanded = reason_mode(reason);
  if (demanded > availability.mode) availability.mode = demanded;
}

Availability availability(const OwnshipPose& pose) {
  Availability result;
  judge(result, pose.roll_deg, attitude_reasons);
  judge(result, pose.pitch_deg, attitude_reasons);
  judge(result, pose.heading_deg, heading_reasons);
  judge(result, pose.latitude_deg, position_reasons);
  judge(result, pose.longitude_deg, position_reasons);
  judge(result, pose.height_m, height_reasons);
  if (pose.position_source == PositionSource::ins) add_reason(result, Reason::position_from_ins);
  if (pose.source_excluded) add_reason(result, Reason::source_excluded);
  if (pose.velocity_doubted) add_reason(result, Reason::velocity_doubted);
  if (pose.events.clock_stepped) add_reason(result, Reason::clock_stepped);
  if (pose.events.frames_replayed) add_reason(result, Reason::frames_replayed);
  if (pose.events.jump_believed) add_reason(result, Reason::jump_believed);
  return result;
}

Availability availability(const OwnshipPose& pose, const GroundCheck& ground,
                          const AirGroundCheck& air_ground) {
  Availability result = availability(pose);
  if (ground.contradiction.raised) add_reason(result, Reason::radio_height_disagrees);
  if (air_ground.contradiction.raised) add_reason(result, Reason::air_ground_disagrees);
  return result;
}

Availability availability(const OwnshipState& state, std::int64_t now_ns,
                          const StateLimits& limits) {
  return availability(ownship_pose(state, now_ns, limits));
}

}  // namespace ridgeline
