#pragma once
#include <cstdint>

#include "config/bus_icd.hpp"
#include "config/limits_bus.hpp"

namespace ridgeline {

/// How far a value may move: rate_per_s x elapsed time + slack; 0 persist_count means no such rule.
struct JumpRule {
  double rate_per_s = 0.0;
  double slack = 0.0;
  std::uint8_t persist_count = 0;
};

/// The jump rule of a parameter that is checked alone; positions are checked as pairs.
[[nodiscard]] JumpRule jump_rule(BusParameter parameter);

/// The rule for pairs of latitude and longitude, in metres.
inline constexpr JumpRule position_jump_rule{limits::position_speed_limit_mps,
                                             limits::position_jump_slack_m,
                                             limits::position_persist_count};

/// Whether a move over `distance` within `elapsed_ns` obeys the rule. Elapsed time may not be
/// negative.
[[nodiscard]] bool is_plausible_move(const JumpRule& rule, double distance,
                                     std::int64_t elapsed_ns);

/// Distance between two values of a parameter; the shorter way round for wrapped angles.
[[nodiscard]] double value_distance(BusParameter parameter, double a, double b);

/// Distance in metres between two positions, for plausibility only.
/// Error:  below 1 % (a sphere of mean radius stands for the ellipsoid).
[[nodiscard]] double rough_distance_m(double latitude_a_deg, double longitude_a_deg,
                                      double latitude_b_deg, double longitude_b_deg);

}  // namespace ridgeline
