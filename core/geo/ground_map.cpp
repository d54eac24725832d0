#include "core/geo/ground_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double largest_map_error_rad = 1e-4;
// Check points of error_rad: in a half disc (the map is even or odd in E) at the zeros of a
// Chebyshev polynomial along every azimuth, signed. docs/error_bound.md, section 2, derives the
// margin.
constexpr int check_azimuths = 30, check_radii = 14;
constexpr double check_disc = 1.001;  ///< in ranges; below sea level the ground is shorter
constexpr double map_margin = 1.5;
constexpr double least_ranges_to_pole = 4.0;       ///< of an eye in the geographic chart
constexpr double least_polar_latitude_deg = 79.0;  ///< of an eye in a polar chart

/// A ground point with its exact place.
struct Sample {
  double e = 0, n = 0;  ///< E and N over the range
  ChartPoint offset;    ///< from the eye
  double swell_m = 0;   ///< of the ellipsoid over the circle
};

double osculating_radius_m(const LocalFrame& frame, double alpha) {
  const double c = std::cos(alpha), s = std::sin(alpha);
  return 1.0 / (c * c / frame.meridian_radius_m + s * s / frame.prime_vertical_radius_m);
}

/// The ellipsoid point on the radial line of (alpha, g): radial Newton steps on the height.
Sample exact_sample(const LocalFrame& frame, Chart chart, double range_m, double alpha,
                    double g_m) {
  const double radius = osculating_radius_m(frame, alpha);
  const double theta = g_m / radius;
  const glm::dvec3 horizontal(std::sin(alpha), std::cos(alpha), 0.0);
  double rho = radius;
  GeodeticPosition place;
  for (int step = 0; step < 3; ++step) {
    Vec3<Enu> point{rho * std::sin(theta) * horizontal};
    point.xyz.z = rho * std::cos(theta) - radius - frame.eye.height_m;
    place = geodetic_from_ecef(frame.eye_ecef + frame.ecef_from_enu * point);
    rho -= place.height_m;
  }
  return {g_m * std::sin(alpha) / range_m, g_m * std::cos(alpha) / range_m,
          chart_offset(chart, frame.eye, {place.latitude_deg, place.longitude_deg}), rho - radius};
}

constexpr std::array<std::array<int, 2>, 11> north_terms{
    {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {2, 0}, {2, 1}, {2, 2}, {2, 3}, {4, 0}, {4, 1}}};
constexpr std::array<std::array<int, 2>, 9> east_terms{
    {{1, 0}, {1, 1}, {1, 2}, {1, 3}, {1, 4}, {3, 0}, {3, 1}, {3, 2}, {5, 0}}};
constexpr std::array<std::array<int, 2>, 2> swell_terms{{{0, 3}, {2, 1}}};

double power(double x, int n) {
  double p = 1;
  for (int i = 0; i < n; ++i) p *= x;
  return p;
}

/// Weighted least squares by normal equations in double; 11 well-scaled unknowns at most.
template <std::size_t Count>
class Fit {
 public:
  explicit Fit(const std::array<std::array<int, 2>, Count>& terms) : terms_(terms) {}

  void add(double e, double n, double value, double weight) {
    std::array<double, Count> row{};
    for (std::size_t k = 0; k < Count; ++k) {
      row[k] = weight * power(e, terms_[k][0]) * power(n, terms_[k][1]);
    }
    for (std::size_t i = 0; i < Count; ++i) {
      for (std::size_t j = 0; j < Count; ++j) matrix_[i][j] += row[i] * row[j];
      right_[i] += row[i] * weight * value;
    }
  }

  std::array<double, Count> solve() {
    for (std::size_t pivot = 0; pivot < Count; ++pivot) {  // Gauss, partial pivoting
      std::size_t best = pivot;
      for (std::size_t i = pivot + 1; i < Count; ++i) {
        if (std::abs(matrix_[i][pivot]) > std::abs(matrix_[best][pivot])) best = i;
      }
      std::swap(matrix_[pivot], matrix_[best]);
      std::swap(right_[pivot], right_[best]);
      for (std::size_t i = pivot + 1; i < Count; ++i) {
        const double factor = matrix_[i][pivot] / matrix_[pivot][pivot];
        for (std::size_t j = pivot; j < Count; ++j) matrix_[i][j] -= factor * matrix_[pivot][j];
        right_[i] -= factor * right_[pivot];
      }
    }
    std::array<double, Count> solution{};
    for (std::size_t i = Count; i-- > 0;) {
      double sum = right_[i];
      for (std::size_t j = i + 1; j < Count; ++j) sum -= matrix_[i][j] * solution[j];
      solution[i] = sum / matrix_[i][i];
    }
    return solution;
  }

 private:
  const std::array<std::array<int, 2>, Count>& terms_;
  std::array<std::array<double, Count>, Count> matrix_{};
  std::array<double, Count> right_{};
};

/// Largest misplacement over ground distance at one (alpha, g), at both ends of the heights: the
/// misplacement is linear in the height, so between them it is no larger.
double misplacement_rad(const LocalFrame& frame, const GroundMap& map, const HeightSpan& heights,
                        double alpha, double g_m) {
  const double radius = osculating_radius_m(frame, alpha);
  const double theta = g_m / radius;
  const double e = g_m * std::sin(alpha) / map.range_m, n = g_m * std::cos(alpha) / map.range_m;
  const GroundPlace place = place_at(map.chart, frame.eye, map.offset(e, n));
  const double swell_m = map.swell_at_m(e, n);
  double worst_m = 0;
  for (const double height_m : {heights.lowest_m, heights.highest_m}) {
    const Vec3<Ecef> exact =
        ecef_from_geodetic({place.latitude_deg, place.longitude_deg, height_m});
    const Vec3<Enu> exact_enu = frame.ecef_from_enu.inverse() * (exact - frame.eye_ecef);
    const double rho = radius + swell_m + height_m;
    const double x = rho * std::sin(theta);
    const double y = rho * std::cos(theta) - radius - frame.eye.height_m;
    const glm::dvec3 model(x * std::sin(alpha), x * std::cos(alpha), y);
    worst_m = std::max(worst_m, glm::length(exact_enu.xyz - model));
  }
  return worst_m / g_m;
}

}  // namespace

ChartPoint GroundMap::offset(double e, double n) const {
  const auto& a = north_deg;
  const auto& b = east_deg;
  const double e2 = e * e;
  const double north = n * (a[0] + n * (a[1] + n * (a[2] + n * (a[3] + n * a[4])))) +
                       e2 * (a[5] + n * (a[6] + n * (a[7] + n * a[8])) + e2 * (a[9] + n * a[10]));
  const double east = e * (b[0] + n * (b[1] + n * (b[2] + n * (b[3] + n * b[4]))) +
                           e2 * (b[5] + n * (b[6] + n * b[7]) + e2 * b[8]));
  return {east, north};
}

Result<GroundMap> ground_map(const LocalFrame& frame, double range_m, Chart chart,
                             const HeightSpan& heights) {
  if (!(range_m >= limits::min_range_m && range_m <= limits::max_range_m)) {
    return Fault::range_out_of_range;
  }
  const double ranges =
      std::cos(frame.eye.latitude_deg * pi / 180.0) * frame.prime_vertical_radius_m / range_m;
  if (chart == Chart::geographic && ranges < least_ranges_to_pole) return Fault::no_error_bound;
  if (chart != Chart::geographic && std::abs(frame.eye.latitude_deg) < least_polar_latitude_deg) {
    return Fault::no_error_bound;
  }
  GroundMap map;
  map.chart = chart;
  map.range_m = range_m;
  map.inverse_meridian_radius = 1.0 / frame.meridian_radius_m;
  map.inverse_prime_vertical_radius = 1.0 / frame.prime_vertical_radius_m;
  Fit<11> north_fit(north_terms);
  Fit<9> east_fit(east_terms);
  Fit<2> swell_fit(swell_terms);
  constexpr int azimuths = 13, radii = 7;
  for (int i = 0; i < azimuths; ++i) {  // the eastern half: the map is even or odd in E
    for (int k = 1; k <= radii; ++k) {
      const double g_m = 1.005 * range_m * 0.5 * (1.0 - std::cos(pi * k / radii));
      const Sample sample = exact_sample(frame, chart, range_m, pi * i / (azimuths - 1), g_m);
      const double weight = range_m / g_m;  // equal angles, not equal metres
      north_fit.add(sample.e, sample.n, sample.offset.north_deg, weight);
      east_fit.add(sample.e, sample.n, sample.offset.east_deg, weight);
      swell_fit.add(sample.e, sample.n, sample.swell_m, weight);
    }
  }
  map.north_deg = north_fit.solve();
  map.east_deg = east_fit.solve();
  map.swell_m = swell_fit.solve();
  double worst = 0;
  for (int i = 0; i <= check_azimuths; ++i) {
    for (int k = 1; k <= check_radii; ++k) {
      const double g_m = check_disc * range_m * std::cos(pi * (2 * k - 1) / (4 * check_radii));
      worst = std::max(worst, misplacement_rad(frame, map, heights, pi * i / check_azimuths, g_m));
    }
  }
  map.error_rad = map_margin * worst;
  if (!(map.error_rad <= largest_map_error_rad)) return Fault::no_error_bound;
  return map;
}

}  // namespace ridgeline
