#pragma once
#include <initializer_list>
#include <vector>

#include "core/state/ownship_pose.hpp"
#include "core/state/ownship_update.hpp"
#include "tests/unit/bus/frames.hpp"

namespace ridgeline::testing {

inline std::int64_t at_ms(double time_ms) {
  return start_ns + static_cast<std::int64_t>(time_ms * 1e6);
}

/// An ownship that is fed frames and asked at times in milliseconds after the start.
struct Ownship {
  BusProfile profile;
  OwnshipState state;

  void feed(const std::vector<BusFrame>& frames, double now_ms) {
    state = update_ownship(state, frames, at_ms(now_ms), profile);
  }
  /// Feeds one frame at its own time.
  void feed(const BusFrame& frame) {
    state = update_ownship(state, {&frame, 1}, frame.time_ns, profile);
  }

  [[nodiscard]] OwnshipPose pose(double now_ms) const {
    return ownship_pose(state, at_ms(now_ms), state_limits(profile));
  }
  [[nodiscard]] Validity validity(BusParameter parameter, double now_ms) const {
    return validity_at(state, parameter, at_ms(now_ms), icd_row(parameter).timeout_ns);
  }
  void feed_fix(double latitude_deg, double longitude_deg, double time_ms) {
    feed(long_of(BusParameter::gps_latitude, latitude_deg, time_ms));
    feed(long_of(BusParameter::gps_longitude, longitude_deg, time_ms + 1.0));
  }
};

}  // namespace ridgeline::testing
