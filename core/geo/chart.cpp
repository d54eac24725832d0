#include "core/geo/chart.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double radius_m = 6'378'137.0;
// In display ranges from the pole: nearer than five the geographic ground map has no bound.
constexpr double enter_ranges = 5.2, leave_ranges = 5.6;

double colatitude_deg(Chart chart, double latitude_deg) {
  return chart == Chart::north_polar ? 90.0 - latitude_deg : 90.0 + latitude_deg;
}

}  // namespace

ChartPoint polar_point(Chart chart, const GroundPlace& place) {
  const double p = colatitude_deg(chart, place.latitude_deg);
  const double north = p * std::cos(place.longitude_deg * deg);
  return {p * std::sin(place.longitude_deg * deg), chart == Chart::north_polar ? -north : north};
}

GroundPlace polar_place(Chart chart, const ChartPoint& point) {
  const double p = std::hypot(point.east_deg, point.north_deg);
  if (chart == Chart::north_polar) {
    return {90.0 - p, std::atan2(point.east_deg, -point.north_deg) / deg};
  }
  return {p - 90.0, std::atan2(point.east_deg, point.north_deg) / deg};
}

ChartPoint chart_offset(Chart chart, const GeodeticPosition& eye, const GroundPlace& place) {
  const double east = std::remainder(place.longitude_deg - eye.longitude_deg, 360.0);
  if (chart == Chart::geographic) return {east, place.latitude_deg - eye.latitude_deg};
  const ChartPoint here = polar_point(chart, {eye.latitude_deg, 0.0});
  const ChartPoint there = polar_point(chart, {place.latitude_deg, east});
  return {there.east_deg, there.north_deg - here.north_deg};
}

GroundPlace place_at(Chart chart, const GeodeticPosition& eye, const ChartPoint& offset) {
  if (chart == Chart::geographic) {
    return {eye.latitude_deg + offset.north_deg, eye.longitude_deg + offset.east_deg};
  }
  const ChartPoint here = polar_point(chart, {eye.latitude_deg, 0.0});
  const GroundPlace place =
      polar_place(chart, {offset.east_deg, here.north_deg + offset.north_deg});
  return {place.latitude_deg, place.longitude_deg + eye.longitude_deg};
}

Turn turn_of(Chart chart, const GeodeticPosition& eye) {
  if (chart == Chart::geographic) return {};
  const double angle = eye.longitude_deg * deg;
  return {std::cos(angle), chart == Chart::north_polar ? std::sin(angle) : -std::sin(angle)};
}

Chart chart_for(Chart now, double latitude_deg, double range_m) {
  const Chart polar = latitude_deg > 0 ? Chart::north_polar : Chart::south_polar;
  const double ranges = std::cos(latitude_deg * deg) * radius_m / range_m;
  return ranges < (now == polar ? leave_ranges : enter_ranges) ? polar : Chart::geographic;
}

double polar_enter_deg(double range_m) {
  return std::asin(std::min(enter_ranges * range_m / radius_m, 1.0)) / deg;
}

double polar_leave_deg(double range_m) {
  return std::asin(std::min(leave_ranges * range_m / radius_m, 1.0)) / deg;
}

}  // namespace ridgeline
