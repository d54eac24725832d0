#pragma once
#include <cstdint>

#include "core/state/ownship_pose.hpp"
#include "core/state/watches.hpp"

namespace ridgeline {

/// The radio height against the height of the eye over the ground that is drawn. The radio height
/// places nothing: it can only say that something does not fit.
struct GroundCheck {
  Confirmation contradiction;
  std::uint32_t disagreements = 0;  ///< times it began to contradict
};

/// Takes in what one frame showed. `over_ground_m`: height of its eye over the drawn ground, NaN
/// where there is none or it is unknown; `radio_height`: of the pose that the frame was drawn from.
/// Without either of them, or above what a radio altimeter measures, nothing contradicts.
[[nodiscard]] GroundCheck ground_check(const GroundCheck& previous, const PoseValue& radio_height,
                                       double over_ground_m, std::int64_t time_ns);

}  // namespace ridgeline
