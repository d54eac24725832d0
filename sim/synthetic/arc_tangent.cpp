#include "sim/synthetic/arc_tangent.hpp"

#include <cmath>

namespace ridgeline::sim {
namespace {

constexpr double degrees_per_radian = 57.295779513082320877;
constexpr double root_3 = 1.7320508075688772935;
constexpr double tangent_15_deg = 0.26794919243112270647;

/// For 0 <= t <= tan 15°, where 15 terms of the series leave less than 1e-18.
double series_rad(double t) {
  const double square = t * t;
  double sum = 0;
  for (int k = 14; k >= 0; --k) sum = 1.0 / (2 * k + 1) - square * sum;
  return t * sum;
}

/// For 0 <= t <= 1.
double first_octant_deg(double t) {
  if (t <= tangent_15_deg) return series_rad(t) * degrees_per_radian;
  const double rest = (root_3 * t - 1) / (root_3 + t);
  const double rest_deg = series_rad(std::fabs(rest)) * degrees_per_radian;
  return rest < 0 ? 30 - rest_deg : 30 + rest_deg;
}

}  // namespace

double arc_tangent_deg(double y, double x) {
  const double up = std::fabs(y);
  const double along = std::fabs(x);
  if (up == 0 && along == 0) return 0;
  double angle_deg = up <= along ? first_octant_deg(up / along) : 90 - first_octant_deg(along / up);
  if (x < 0) angle_deg = 180 - angle_deg;
  return y < 0 ? -angle_deg : angle_deg;
}

}  // namespace ridgeline::sim
