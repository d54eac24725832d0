#include "core/state/plausibility.hpp"

#include <cmath>
#include <numbers>

#include "core/bus/canaerospace.hpp"

namespace ridgeline {

JumpRule jump_rule(BusParameter parameter) {
  switch (parameter) {
    case BusParameter::roll:
      return {limits::roll_rate_limit_dps, limits::attitude_jump_slack_deg,
              limits::angle_persist_count};
    case BusParameter::pitch:
      return {limits::pitch_rate_limit_dps, limits::attitude_jump_slack_deg,
              limits::angle_persist_count};
    case BusParameter::heading:
    case BusParameter::true_heading:
    case BusParameter::magnetic_heading:
      return {limits::heading_rate_limit_dps, limits::attitude_jump_slack_deg,
              limits::angle_persist_count};
    case BusParameter::gps_height:
    case BusParameter::ins_height:
      return {limits::height_speed_limit_mps, limits::height_jump_slack_m,
              limits::position_persist_count};
    case BusParameter::gps_ground_speed:
    case BusParameter::ins_ground_speed:
      return {limits::ground_speed_rate_limit_mps2, limits::velocity_jump_slack_mps,
              limits::position_persist_count};
    case BusParameter::altitude_rate:
      return {limits::altitude_rate_rate_limit_mps2, limits::velocity_jump_slack_mps,
              limits::position_persist_count};
    default:
      return {};
  }
}

bool is_plausible_move(const JumpRule& rule, double distance, std::int64_t elapsed_ns) {
  const double elapsed_s = static_cast<double>(elapsed_ns) * 1e-9;
  return distance <= rule.rate_per_s * elapsed_s + rule.slack;
}

double value_distance(BusParameter parameter, double a, double b) {
  return std::abs(icd_row(parameter).quantity.wraps ? wrapped_deg(a - b) : a - b);
}

double rough_distance_m(double latitude_a_deg, double longitude_a_deg, double latitude_b_deg,
                        double longitude_b_deg) {
  constexpr double rad_per_deg = std::numbers::pi / 180.0;
  constexpr double mean_radius_m = 6371008.8;
  const double north_rad = (latitude_b_deg - latitude_a_deg) * rad_per_deg;
  const double east_rad = wrapped_deg(longitude_b_deg - longitude_a_deg) * rad_per_deg;
  // Half-angle form: exact on the sphere, also across a pole.
  const double s = std::sin(north_rad / 2.0);
  const double e = std::sin(east_rad / 2.0);
  const double c = std::cos(latitude_a_deg * rad_per_deg) * std::cos(latitude_b_deg * rad_per_deg);
  return 2.0 * mean_radius_m * std::asin(std::sqrt(std::fmin(1.0, s * s + c * e * e)));
}

}  // namespace ridgeline
