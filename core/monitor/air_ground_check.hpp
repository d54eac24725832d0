#pragma once
#include <cstdint>

#include "core/monitor/discretes.hpp"
#include "core/state/ownship_pose.hpp"
#include "core/state/watches.hpp"

namespace ridgeline {

/// The air/ground switch against ground speed and height over the ground that is drawn. It takes no
/// picture away: it says that switch, speed, height or terrain is wrong.
struct AirGroundCheck {
  Confirmation contradiction;
  std::uint32_t disagreements = 0;  ///< times it began to contradict
};

/// What is held against each other.
struct AirGroundFacts {
  AirGround said = AirGround::unknown;
  PoseValue ground_speed_mps;  ///< of the pose that the frame was drawn from
  double over_ground_m = 0.0;  ///< of its eye; NaN where there is none or it is unknown
  /// A helicopter: low and slow is no contradiction of being in the air.
  bool can_hover = false;
};

/// Takes in what one frame showed.
/// Rules: - `ground` contradicts when speed and height both say flight (limits::flight_speed_mps,
///          limits::flight_height_m) for limits::flight_ns.
///        - `air` contradicts when both say that the aircraft stands (limits::standing_*) for
///          limits::standing_ns, unless it can hover.
///        - Without one of the three nothing contradicts.
[[nodiscard]] AirGroundCheck air_ground_check(const AirGroundCheck& previous,
                                              const AirGroundFacts& facts, std::int64_t time_ns);

}  // namespace ridgeline
