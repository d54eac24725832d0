#include "sim/import_igc/derived_flight.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bus/canaerospace.hpp"

namespace ridgeline {
namespace {

constexpr double deg_per_rad = 180.0 / std::numbers::pi;
constexpr double gravity_mps2 = 9.80665;
/// Below this airspeed no aircraft flies: a flight path is not steeper than the climb over it says.
constexpr double least_path_speed_mps = 5.0;
constexpr double least_correlation = 0.5;

std::array<double, 3> ecef_m(const IgcFix& fix, double height_m) {
  std::array<double, 3> p{};
  GeographicLib::Geocentric::WGS84().Forward(fix.latitude_deg, fix.longitude_deg, height_m, p[0],
                                             p[1], p[2]);
  return p;
}

std::array<double, 3> origin_of(std::span<const IgcFix> fixes, std::span<const double> heights_m) {
  return ecef_m(fixes.front(), heights_m.front());
}

SmoothingSpline spline_of(std::span<const IgcFix> fixes, std::span<const double> heights_m,
                          const std::array<double, 3>& origin_m, double smoothing_s3) {
  std::vector<double> times_s;
  std::vector<std::array<double, 3>> points;
  for (std::size_t index = 0; index < fixes.size(); ++index) {
    std::array<double, 3> p = ecef_m(fixes[index], heights_m[index]);
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] -= origin_m[axis];
    times_s.push_back(fixes[index].time_s);
    points.push_back(p);
  }
  return SmoothingSpline(times_s, points, smoothing_s3);
}

/// 0 below `low`, 1 above `high`, with a smooth middle.
double fade(double value, double low, double high) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Pearson correlation of the pairs seen.
struct Correlation {
  double count = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_yy = 0, sum_xy = 0;
  void add(double x, double y) {
    count += 1;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_yy += y * y;
    sum_xy += x * y;
  }
  [[nodiscard]] double value() const {
    const double xx = count * sum_xx - sum_x * sum_x;
    const double yy = count * sum_yy - sum_y * sum_y;
    if (xx <= 0.0 || yy <= 0.0) return 0.0;
    return (count * sum_xy - sum_x * sum_y) / std::sqrt(xx * yy);
  }
};

int sign_of(double correlation) {
  if (std::abs(correlation) < least_correlation) return 0;
  return correlation > 0.0 ? 1 : -1;
}

}  // namespace

DerivedFlight::DerivedFlight(std::span<const IgcFix> fixes, std::span<const double> heights_m,
                             const DerivationRules& rules)
    : rules_(rules),
      origin_m_(origin_of(fixes, heights_m)),
      spline_(spline_of(fixes, heights_m, origin_m_, rules.smoothing_s3)) {}

FlightPoint DerivedFlight::at(double time_s) const {
  const SplinePoint s = spline_.at(time_s);
  FlightPoint point;
  std::vector<double> m(9);  // columns: east, north, up in ECEF
  GeographicLib::Geocentric::WGS84().Reverse(
      s.position[0] + origin_m_[0], s.position[1] + origin_m_[1], s.position[2] + origin_m_[2],
      point.latitude_deg, point.longitude_deg, point.height_m, m);
  const auto along = [&](const std::array<double, 3>& v, std::size_t axis) {
    return v[0] * m[axis] + v[1] * m[3 + axis] + v[2] * m[6 + axis];
  };
  const double east = along(s.velocity, 0);
  const double north = along(s.velocity, 1);
  const double speed = std::hypot(east, north);
  point.ground_speed_mps = speed;
  point.track_deg = std::atan2(east, north) * deg_per_rad;
  point.climb_mps = along(s.velocity, 2);
  if (speed > rules_.heading_speed_mps) {
    const double across_mps2 =
        (along(s.acceleration, 0) * north - along(s.acceleration, 1) * east) / speed;
    const double roll_deg = std::atan(across_mps2 / gravity_mps2) * deg_per_rad *
                            fade(speed, rules_.heading_speed_mps, rules_.full_roll_speed_mps);
    point.roll_deg = std::clamp(roll_deg, -rules_.roll_limit_deg, rules_.roll_limit_deg);
  }
  const double path_deg =
      std::atan2(point.climb_mps, std::max(speed, least_path_speed_mps)) * deg_per_rad;
  point.pitch_deg = std::clamp(path_deg + rules_.angle_of_attack_deg, -rules_.pitch_limit_deg,
                               rules_.pitch_limit_deg);
  return point;
}

std::optional<double> recorded_angle(std::span<const IgcFix> fixes,
                                     std::optional<double> IgcFix::*angle, double time_s) {
  const auto above =
      std::upper_bound(fixes.begin(), fixes.end(), time_s,
                       [](double time, const IgcFix& fix) { return time < fix.time_s; });
  if (above == fixes.begin()) return std::nullopt;
  const IgcFix& before = *(above - 1);
  const IgcFix& after = above == fixes.end() ? before : *above;
  const std::optional<double>& a = before.*angle;
  const std::optional<double>& b = after.*angle;
  if (!a || !b) return std::nullopt;
  const double span_s = after.time_s - before.time_s;
  const double part = span_s > 0.0 ? (time_s - before.time_s) / span_s : 0.0;
  return wrapped_deg(*a + wrapped_deg(*b - *a) * part);
}

RecordedSigns recorded_signs(std::span<const IgcFix> fixes,
                             const std::vector<DerivedFlight>& flights) {
  constexpr double flying_mps = 8.0;  // on the ground a recorder lies as it likes
  Correlation roll;
  Correlation pitch;
  RecordedSigns signs;
  for (const DerivedFlight& flight : flights) {
    for (const IgcFix& fix : fixes) {
      if (fix.time_s < flight.first_time_s() || fix.time_s > flight.last_time_s()) continue;
      signs.heading = signs.heading || fix.heading_deg.has_value();
      if (!fix.roll_deg && !fix.pitch_deg) continue;
      const FlightPoint point = flight.at(fix.time_s);
      if (point.ground_speed_mps < flying_mps) continue;
      if (fix.roll_deg) roll.add(*fix.roll_deg, point.roll_deg);
      if (fix.pitch_deg) pitch.add(*fix.pitch_deg, point.pitch_deg);
    }
  }
  signs.roll_correlation = roll.value();
  signs.pitch_correlation = pitch.value();
  signs.roll = sign_of(signs.roll_correlation);
  signs.pitch = sign_of(signs.pitch_correlation);
  return signs;
}

double HeadingFollower::next(const FlightPoint& point, double step_s) {
  if (point.ground_speed_mps >= rules_.heading_speed_mps) {
    const double most = rules_.heading_rate_limit_dps * step_s;
    const double turn = wrapped_deg(point.track_deg - heading_deg_);
    heading_deg_ = wrapped_deg(heading_deg_ + std::clamp(turn, -most, most));
  }
  return heading_deg_;
}

double first_heading_deg(const DerivedFlight& flight, double time_s, const DerivationRules& rules) {
  for (double t = time_s; t <= flight.last_time_s(); t += 1.0) {
    const FlightPoint point = flight.at(t);
    if (point.ground_speed_mps >= rules.heading_speed_mps) return point.track_deg;
  }
  return 0.0;
}

}  // namespace ridgeline
