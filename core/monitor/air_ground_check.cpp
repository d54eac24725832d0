#include "core/monitor/air_ground_check.hpp"

#include "config/limits_bus.hpp"

namespace ridgeline {
namespace {

/// NaN is neither: comparisons with it are false.
bool flies(const AirGroundFacts& facts) {
  return facts.ground_speed_mps.value > limits::flight_speed_mps &&
         facts.over_ground_m > limits::flight_height_m;
}

bool stands(const AirGroundFacts& facts) {
  return facts.ground_speed_mps.value < limits::standing_speed_mps &&
         facts.over_ground_m < limits::standing_height_m;
}

}  // namespace

AirGroundCheck air_ground_check(const AirGroundCheck& previous, const AirGroundFacts& facts,
                                std::int64_t time_ns) {
  const bool comparable = facts.ground_speed_mps.validity == Validity::valid;
  const bool on_ground = facts.said == AirGround::ground;
  const bool in_air = facts.said == AirGround::air && !facts.can_hover;
  const bool apart = comparable && ((on_ground && flies(facts)) || (in_air && stands(facts)));
  AirGroundCheck next = previous;
  const std::int64_t raise_ns = on_ground ? limits::flight_ns : limits::standing_ns;
  next.contradiction =
      confirmed(previous.contradiction, apart, time_ns, {raise_ns, limits::agree_again_ns});
  if (next.contradiction.raised && !previous.contradiction.raised) ++next.disagreements;
  return next;
}

}  // namespace ridgeline
