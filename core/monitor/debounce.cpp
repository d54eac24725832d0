#include "core/monitor/debounce.hpp"

namespace ridgeline {

Debounce debounced(const Debounce& previous, bool level, std::int64_t now_ns,
                   std::int64_t hold_ns) {
  Debounce next = previous;
  if (level != previous.candidate) {
    if (previous.candidate != previous.level) ++next.bounces;
    next.candidate = level;
    next.since_ns = now_ns;
  } else if (now_ns < previous.since_ns) {
    next.since_ns = now_ns;
  }
  if (next.candidate != next.level && now_ns - next.since_ns >= hold_ns) {
    next.level = next.candidate;
    ++next.changes;
  }
  return next;
}

}  // namespace ridgeline
