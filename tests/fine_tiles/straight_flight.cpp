#include "tests/fine_tiles/straight_flight.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/limits.hpp"
#include "config/limits_bus.hpp"
#include "core/base/assert.hpp"
#include "sim/synthetic/bus_log_writer.hpp"

namespace ridgeline::fine {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180;
constexpr double gravity_mps2 = 9.80665;
constexpr double angle_of_attack_deg = 1.8;  // in level flight at one g
constexpr double longest_jump_m = 20e6;
constexpr double steepest_bank_deg = 60;
constexpr double tick_s = 1.0 / sim::flight_ticks_per_second;

bool within(double value, double low, double high) {
  return value >= low && value <= high;  // false for NaN
}

/// Radius of curvature of the ellipsoid at a latitude in the direction of an azimuth (m).
double radius_m(double latitude_deg, double azimuth_deg) {
  const auto& earth = GeographicLib::Geodesic::WGS84();
  const double f = earth.Flattening();
  const double e2 = f * (2 - f);
  const double sine = std::sin(latitude_deg * rad_per_deg);
  const double w2 = 1 - e2 * sine * sine;
  const double across_m = earth.EquatorialRadius() / std::sqrt(w2);
  const double along_m = across_m * (1 - e2) / w2;
  const double c = std::cos(azimuth_deg * rad_per_deg);
  return 1 / (c * c / along_m + (1 - c * c) / across_m);
}

double bank_deg(const std::optional<Turn>& turn, double time_s) {
  if (!turn) return 0;
  const double into_s = time_s - turn->at_s;
  const double left_s = turn->duration_s - into_s;
  const double roll_s = std::min(roll_time_s, turn->duration_s / 3);
  return turn->bank_deg * std::clamp(std::min(into_s, left_s) / roll_s, 0.0, 1.0);
}

/// Moves on along a geodesic; the track is then that of its end.
void move(sim::FlightSample& sample, double distance_m) {
  double track_deg = 0;
  GeographicLib::Geodesic::WGS84().Direct(sample.latitude_deg, sample.longitude_deg,
                                          sample.track_deg, distance_m, sample.latitude_deg,
                                          sample.longitude_deg, track_deg);
  sample.track_deg = track_deg;
}

}  // namespace

std::string wrong_with(const FlightPlan& plan) {
  if (!within(plan.latitude_deg, -90, 90)) return "latitude is not within -90..90";
  if (!within(plan.longitude_deg, -180, 180)) return "longitude is not within -180..180";
  if (!within(plan.heading_deg, -180, 360)) return "heading is not within -180..360";
  if (!within(plan.speed_mps, 1, limits::position_speed_limit_mps)) {
    return "speed is not within 1..400";
  }
  if (!within(plan.height_m, limits::min_eye_height_m, limits::max_eye_height_m)) {
    return "height is not within -600..20500";
  }
  if (!within(plan.duration_s, 1, longest_flight_s)) return "duration is not within 1..14400";
  if (plan.jump && !within(plan.jump->at_s, 0, plan.duration_s)) {
    return "the jump is not within the flight";
  }
  if (plan.jump && !within(plan.jump->along_m, -longest_jump_m, longest_jump_m)) {
    return "the jump is not within -20000..20000 km";
  }
  if (!plan.turn) return {};
  const Turn& turn = *plan.turn;
  if (!within(turn.at_s, 0, plan.duration_s) || !within(turn.duration_s, tick_s, plan.duration_s) ||
      turn.at_s + turn.duration_s > plan.duration_s) {
    return "the turn is not within the flight";
  }
  if (!within(std::fabs(turn.bank_deg), 1, steepest_bank_deg)) {
    return "bank is not within 1..60 to either side";
  }
  return {};
}

std::vector<sim::FlightSample> straight_flight(const FlightPlan& plan) {
  RL_ASSERT(wrong_with(plan).empty());
  const auto ticks = static_cast<int>(std::floor(plan.duration_s / tick_s + 1e-6));
  std::vector<sim::FlightSample> flight;
  flight.reserve(static_cast<std::size_t>(ticks) + 1);
  sim::FlightSample now;
  now.latitude_deg = plan.latitude_deg;
  now.longitude_deg = plan.longitude_deg;
  now.track_deg = plan.heading_deg > 180 ? plan.heading_deg - 360 : plan.heading_deg;
  now.height_m = plan.height_m;
  now.ground_speed_mps = plan.speed_mps;
  bool jumped = false;
  for (int tick = 0; tick <= ticks; ++tick) {
    now.time_s = static_cast<double>(tick) / sim::flight_ticks_per_second;
    if (plan.jump && !jumped && now.time_s >= plan.jump->at_s) {
      move(now, plan.jump->along_m);
      jumped = true;
    }
    now.roll_deg = bank_deg(plan.turn, now.time_s);
    now.pitch_deg = angle_of_attack_deg / std::cos(now.roll_deg * rad_per_deg);
    now.heading_deg = now.track_deg;
    flight.push_back(now);
    const double middle_bank_deg = bank_deg(plan.turn, now.time_s + 0.5 * tick_s);
    const double half_turn_deg = 0.5 * tick_s * gravity_mps2 *
                                 std::tan(middle_bank_deg * rad_per_deg) /
                                 (plan.speed_mps * rad_per_deg);
    now.track_deg += half_turn_deg;
    const double local_m = radius_m(now.latitude_deg, now.track_deg);
    move(now, plan.speed_mps * tick_s * local_m / (local_m + plan.height_m));
    now.track_deg = std::remainder(now.track_deg + half_turn_deg, 360.0);
  }
  return flight;
}

std::string flight_log(const FlightPlan& plan) {
  return sim::bus_log(straight_flight(plan), {},
                      "# ridgeline: SYNTHETIC flight, scripted for tests: level, constant speed\n"
                      "# CANaerospace 1.7 frames; heights are above the ellipsoid\n");
}

}  // namespace ridgeline::fine
