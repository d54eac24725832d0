#include "core/state/watches.hpp"

#include <algorithm>
#include <cmath>

#include "config/limits_bus.hpp"

namespace ridgeline {

Confirmation confirmed(const Confirmation& previous, bool present, std::int64_t time_ns,
                       const ConfirmRule& rule) {
  Confirmation next = previous;
  if (present == previous.raised) {
    next.pending = false;
    return next;
  }
  if (!previous.pending) {
    next.pending = true;
    next.since_ns = time_ns;
  }
  if (time_ns - next.since_ns >= (present ? rule.raise_ns : rule.clear_ns)) {
    next.raised = present;
    next.pending = false;
  }
  return next;
}

DriftWatch drifted(const DriftWatch& previous, double east_m, double north_m, std::int64_t time_ns,
                   double rate_mps, const DriftRule& rule) {
  DriftWatch next = previous;
  const std::int64_t elapsed_ns = time_ns - previous.time_ns;
  next.time_ns = time_ns;
  next.started = true;
  if (!previous.started || elapsed_ns < 0 || elapsed_ns > limits::watch_restart_ns) {
    next.east_m = next.north_m = 0.0;
    return next;
  }
  next.east_m += east_m;
  next.north_m += north_m;
  double apart_m = std::hypot(next.east_m, next.north_m);
  const double cap_m = limits::drift_cap * rule.limit;
  if (apart_m > 0.0 && !(previous.contradiction.raised && rule.latches)) {
    const double forgiven_m = (rule.forgiven_per_s + rule.forgiven_of_rate * std::abs(rate_mps)) *
                              static_cast<double>(elapsed_ns) * 1e-9;
    const double kept_m = std::max(0.0, apart_m - forgiven_m);
    const double left = (rule.latches ? kept_m : std::min(kept_m, cap_m)) / apart_m;
    next.east_m *= left;
    next.north_m *= left;
    apart_m *= left;
  }
  // Half the limit ends it: two values at the limit shall not flicker.
  const double limit_m = previous.contradiction.raised ? 0.5 * rule.limit : rule.limit;
  next.contradiction = confirmed(previous.contradiction, apart_m > limit_m, time_ns, rule.confirm);
  return next;
}

bool is_present(const DriftWatch& watch, std::int64_t now_ns) {
  return watch.started && now_ns - watch.time_ns <= limits::watch_present_ns;
}

bool contradicts(const DriftWatch& watch, std::int64_t now_ns) {
  return watch.contradiction.raised && now_ns - watch.time_ns <= limits::contradiction_memory_ns;
}

FreezeWatch stood_still(const FreezeWatch& previous, double value, double second,
                        std::int64_t time_ns, double moved, const FreezeRule& rule) {
  FreezeWatch next = previous;
  next.value = value;
  next.second = second;
  next.time_ns = time_ns;
  const std::int64_t elapsed_ns = time_ns - previous.time_ns;
  const bool same = previous.started && value == previous.value && second == previous.second &&
                    elapsed_ns >= 0 && elapsed_ns <= limits::watch_restart_ns;
  if (!same) {
    next.since_ns = time_ns;
    next.moved = 0.0;
    next.started = true;
    next.raised = false;
    return next;
  }
  const double share =
      static_cast<double>(elapsed_ns) / static_cast<double>(limits::freeze_window_ns);
  next.moved = previous.moved * std::max(0.0, 1.0 - share) + moved;
  const bool long_enough = time_ns - next.since_ns >= rule.least_ns;
  next.raised = previous.raised || (long_enough && std::abs(next.moved) > rule.limit);
  return next;
}

namespace {

SequenceStep begun(const Source& source, std::uint8_t code, Sequence verdict) {
  SequenceStep step;
  step.next.source = source;
  step.next.code = code;
  step.next.started = true;
  step.verdict = verdict;
  return step;
}

}  // namespace

SequenceStep sequence_step(const SequenceWatch& previous, const Source& source, std::uint8_t code) {
  if (!previous.started || previous.source != source) {
    return begun(source, code, Sequence::in_order);
  }
  SequenceStep step{previous, Sequence::in_order, 0};
  SequenceWatch& next = step.next;
  const auto ahead = static_cast<std::uint8_t>(code - previous.code);
  if (previous.counted < limits::sequence_learn_count) {
    next.counted = static_cast<std::uint8_t>(ahead == 1 ? previous.counted + 1 : 0);
    next.code = code;
    return step;
  }
  if (ahead >= 1 && ahead < 128) {
    step.verdict = ahead == 1 ? Sequence::in_order : Sequence::gap;
    step.missing = static_cast<std::uint8_t>(ahead - 1);
    next.code = code;
    next.refused = 0;
    return step;
  }
  // Behind, or again. A sender that was switched off and on counts from 0: after a while of its
  // own order it is believed.
  step.verdict = ahead == 0 ? Sequence::duplicate : Sequence::behind;
  const auto on = static_cast<std::uint8_t>(code - previous.other_code);
  const bool goes_on = previous.refused > 0 && on <= 1;
  next.refused = static_cast<std::uint8_t>(goes_on ? previous.refused + 1 : 1);
  next.other_code = code;
  if (next.refused >= limits::sequence_restart_count) {
    return begun(source, code, Sequence::begun_anew);
  }
  return step;
}

}  // namespace ridgeline
