#include "sim/synthetic/scripted_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/assert.hpp"
#include "sim/synthetic/arc_tangent.hpp"
#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::sim {
namespace {

struct Point {
  double east_m;
  double north_m;
};

// Metres from this origin; the scale is that of WGS 84 at 48.43 degrees south, good to 1e-4 over
// the flight.
constexpr double origin_latitude_deg = -48.43;
constexpr double origin_longitude_deg = -123.70;
constexpr double metres_per_latitude_degree = 111'198.7;
constexpr double metres_per_longitude_degree = 74'003.1;

constexpr double ground_speed_mps = 125;
constexpr double gravity_mps2 = 9.80665;
constexpr double wind_east_mps = 6;
constexpr double wind_north_mps = 2.5;
constexpr int ticks = flight_duration_s * flight_ticks_per_second + 1;
constexpr double tick_s = 1.0 / flight_ticks_per_second;

// Control points of a uniform cubic B-spline: it comes near them and its curvature has no jumps.
constexpr std::array<Point, 12> control = {{{1550, -2690},
                                            {740, -1190},
                                            {70, -50},
                                            {-870, 1030},
                                            {-2490, 1570},
                                            {-3510, 2390},
                                            {-4180, 3610},
                                            {-4160, 4960},
                                            {-3430, 6180},
                                            {-2090, 6730},
                                            {-340, 6730},
                                            {1550, 6590}}};

/// Position and the first two derivatives by the curve parameter.
struct CurvePoint {
  Point place;
  Point first;
  Point second;
};

CurvePoint curve_at(double parameter) {
  const int last = static_cast<int>(control.size()) - 4;
  const int segment = std::clamp(static_cast<int>(parameter), 0, last);
  const double t = parameter - segment;
  const double s = 1 - t;
  const auto blend = [&](double a, double b, double c, double d) {
    const Point& p0 = control[static_cast<std::size_t>(segment)];
    const Point& p1 = control[static_cast<std::size_t>(segment) + 1];
    const Point& p2 = control[static_cast<std::size_t>(segment) + 2];
    const Point& p3 = control[static_cast<std::size_t>(segment) + 3];
    return Point{a * p0.east_m + b * p1.east_m + c * p2.east_m + d * p3.east_m,
                 a * p0.north_m + b * p1.north_m + c * p2.north_m + d * p3.north_m};
  };
  return {blend(s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6),
          blend(-s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * t * t + 2 * t + 1) / 2, t * t / 2),
          blend(s, 3 * t - 2, 1 - 3 * t, t)};
}

double length(Point vector) {
  return std::sqrt(vector.east_m * vector.east_m + vector.north_m * vector.north_m);
}

/// One curve point per tick at constant speed along the curve.
std::vector<CurvePoint> flown_curve() {
  std::vector<CurvePoint> points;
  points.reserve(ticks);
  double parameter = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    points.push_back(curve_at(parameter));
    const double step_m = ground_speed_mps * tick_s;
    const double half = parameter + 0.5 * step_m / length(points.back().first);
    parameter += step_m / length(curve_at(half).first);
  }
  RL_ASSERT(parameter <= static_cast<double>(control.size() - 3));
  return points;
}

double latitude_deg(Point place) {
  return origin_latitude_deg + place.north_m / metres_per_latitude_degree;
}
double longitude_deg(Point place) {
  return origin_longitude_deg + place.east_m / metres_per_longitude_degree;
}

/// The highest ground under the path and to either side of it.
double swath_m(const CurvePoint& point, const HeightFunction& ground_m) {
  constexpr double reach_m = 120;
  const double speed = length(point.first);
  double highest_m = -1e9;
  for (int side = -1; side <= 1; ++side) {
    const Point place = {point.place.east_m + side * reach_m * point.first.north_m / speed,
                         point.place.north_m - side * reach_m * point.first.east_m / speed};
    const double height_m = ground_m(latitude_deg(place), longitude_deg(place));
    RL_ASSERT(!std::isnan(height_m));
    highest_m = std::max(highest_m, height_m);
  }
  return highest_m;
}

/// The largest value within `reach` ticks of each tick.
std::vector<double> running_maximum(const std::vector<double>& values, int reach) {
  std::vector<double> result(values.size());
  const int last = static_cast<int>(values.size()) - 1;
  for (int k = 0; k <= last; ++k) {
    const auto from = values.begin() + std::max(0, k - reach);
    const auto to = values.begin() + std::min(last, k + reach) + 1;
    result[static_cast<std::size_t>(k)] = *std::max_element(from, to);
  }
  return result;
}

/// The mean within `reach` ticks of each tick; ticks beyond an end count as the end.
std::vector<double> running_mean(const std::vector<double>& values, int reach) {
  const int last = static_cast<int>(values.size()) - 1;
  const auto value = [&](int k) {
    return values[static_cast<std::size_t>(std::clamp(k, 0, last))];
  };
  std::vector<double> result(values.size());
  for (int k = 0; k <= last; ++k) {
    double sum = 0;
    for (int offset = -reach; offset <= reach; ++offset) sum += value(k + offset);
    result[static_cast<std::size_t>(k)] = sum / (2 * reach + 1);
  }
  return result;
}

/// Heights that never come closer to the ground than the clearance. Every mean below runs over
/// ticks whose running maximum includes the ground at the middle tick, because the reaches of the
/// means add up to that of the maximum: so no mean can fall below that ground.
std::vector<double> flown_heights_m(const std::vector<CurvePoint>& points,
                                    const HeightFunction& ground_m) {
  constexpr int mean_reach = 5 * flight_ticks_per_second;
  constexpr double margin_m = 55;  // more than the posts between two samples of the swath can hide
  std::vector<double> floor_m;
  floor_m.reserve(points.size());
  for (const CurvePoint& point : points) floor_m.push_back(swath_m(point, ground_m));
  std::vector<double> height_m = running_maximum(floor_m, 3 * mean_reach);
  for (int pass = 0; pass < 3; ++pass) height_m = running_mean(height_m, mean_reach);
  for (double& height : height_m) height += flight_clearance_m + margin_m;
  return height_m;
}

/// Light chop: what the air does to the attitude, zero on average.
double chop_deg(double time_s, double amplitude_deg, std::uint64_t seed) {
  return amplitude_deg * fractal_noise(1.3 * time_s, 0.5, 3, seed);
}

}  // namespace

std::vector<FlightSample> scripted_flight(const HeightFunction& ground_m) {
  const std::vector<CurvePoint> points = flown_curve();
  const std::vector<double> heights_m = flown_heights_m(points, ground_m);
  std::vector<FlightSample> flight;
  flight.reserve(points.size());
  for (std::size_t tick = 0; tick < points.size(); ++tick) {
    const CurvePoint& point = points[tick];
    const double speed = length(point.first);
    // Clockwise turn is positive, as roll to the right is.
    const double curvature_per_m =
        (point.first.north_m * point.second.east_m - point.first.east_m * point.second.north_m) /
        (speed * speed * speed);
    const double turn_mps2 = ground_speed_mps * ground_speed_mps * curvature_per_m;
    const std::size_t before = tick == 0 ? 0 : tick - 1;
    const std::size_t after = std::min(tick + 1, points.size() - 1);
    const double east_mps = ground_speed_mps * point.first.east_m / speed;
    const double north_mps = ground_speed_mps * point.first.north_m / speed;
    const double load = std::sqrt(1 + turn_mps2 * turn_mps2 / (gravity_mps2 * gravity_mps2));
    FlightSample sample;
    sample.time_s = static_cast<double>(tick) / flight_ticks_per_second;
    sample.latitude_deg = latitude_deg(point.place);
    sample.longitude_deg = longitude_deg(point.place);
    sample.height_m = heights_m[tick];
    sample.climb_mps =
        (heights_m[after] - heights_m[before]) / (static_cast<double>(after - before) * tick_s);
    sample.roll_deg = arc_tangent_deg(turn_mps2, gravity_mps2) + chop_deg(sample.time_s, 1.2, 700);
    sample.pitch_deg = arc_tangent_deg(sample.climb_mps, ground_speed_mps) + 1.8 * load +
                       chop_deg(sample.time_s, 0.5, 710);
    sample.heading_deg = arc_tangent_deg(east_mps - wind_east_mps, north_mps - wind_north_mps);
    sample.track_deg = arc_tangent_deg(east_mps, north_mps);
    sample.ground_speed_mps = ground_speed_mps;
    flight.push_back(sample);
  }
  return flight;
}

}  // namespace ridgeline::sim
