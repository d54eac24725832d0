#include "core/frame/frame_input.hpp"

namespace ridgeline {

FrameInput frame_input(const OwnshipPose& pose, const GroundCheck& ground,
                       const AirGroundCheck& air_ground, std::int64_t time_ns) {
  FrameInput input;
  input.time_ns = time_ns;
  input.availability = availability(pose, ground, air_ground);
  if (has_value(pose.latitude_deg)) {
    input.eye = {pose.latitude_deg.value, pose.longitude_deg.value, pose.height_m.value};
  }
  const bool level = has_value(pose.roll_deg) && has_value(pose.pitch_deg);
  input.attitude_valid =
      pose.roll_deg.validity == Validity::valid && pose.pitch_deg.validity == Validity::valid;
  if (level) input.attitude = {pose.roll_deg.value, pose.pitch_deg.value, 0.0};
  if (has_value(pose.heading_deg)) input.attitude.heading_deg = pose.heading_deg.value;
  return input;
}

}  // namespace ridgeline
