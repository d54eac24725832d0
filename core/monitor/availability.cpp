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
};
constexpr ValueReasons attitude_reasons{Reason::attitude_missing, Reason::attitude_stale,
                                        Reason::attitude_implausible, Reason::attitude_invalid};
constexpr ValueReasons heading_reasons{Reason::heading_missing, Reason::heading_stale,
                                       Reason::heading_implausible, Reason::heading_invalid};
constexpr ValueReasons position_reasons{Reason::position_missing, Reason::position_stale,
                                        Reason::position_implausible, Reason::position_invalid};
constexpr ValueReasons height_reasons{Reason::height_missing, Reason::height_stale,
                                      Reason::height_implausible, Reason::height_invalid};

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
  return result;
}

Availability availability(const OwnshipState& state, std::int64_t now_ns,
                          const StateLimits& limits) {
  return availability(ownship_pose(state, now_ns, limits));
}

}  // namespace ridgeline
