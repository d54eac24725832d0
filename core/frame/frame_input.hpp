#pragma once
#include <cstdint>

#include "core/frame/frame_pipeline.hpp"
#include "core/state/ownship_pose.hpp"

namespace ridgeline {

/// Whether a pose value holds a number, good or not: it was received, and means one thing.
[[nodiscard]] constexpr bool has_value(const PoseValue& value) {
  return value.validity != Validity::missing && value.validity != Validity::reference_unknown;
}

/// What a frame at `time_ns` is drawn from: the pose, and what it, and radio height and air/ground
/// switch over the ground drawn last, allow. Reasons that the pose does not know (assumed
/// references, derived attitudes) are the caller's to add. Cost: O(1); no allocation.
[[nodiscard]] FrameInput frame_input(const OwnshipPose& pose, const GroundCheck& ground,
                                     const AirGroundCheck& air_ground, std::int64_t time_ns);

}  // namespace ridgeline
