#include "core/monitor/ground_check.hpp"

#include <algorithm>
#include <cmath>

#include "config/limits_bus.hpp"

namespace ridgeline {

GroundCheck ground_check(const GroundCheck& previous, const PoseValue& radio_height,
                         double over_ground_m, std::int64_t time_ns) {
  GroundCheck next = previous;
  const double radio_m = radio_height.value;
  const bool comparable = radio_height.validity == Validity::valid && !std::isnan(over_ground_m);
  // Where one of them is beyond what is measured, the other one still must not be far below.
  const double higher_m = std::max(radio_m, over_ground_m);
  const double seen_m = std::min(higher_m, limits::radio_height_limit_m);
  const double limit_m = limits::radio_disagree_m + limits::radio_disagree_share * seen_m;
  const bool apart = comparable && seen_m - std::min(radio_m, over_ground_m) > limit_m;
  const bool before = previous.contradiction.raised;
  next.contradiction = confirmed(previous.contradiction, apart, time_ns,
                                 {limits::radio_disagree_ns, limits::agree_again_ns});
  if (next.contradiction.raised && !before) ++next.disagreements;
  return next;
}

}  // namespace ridgeline
