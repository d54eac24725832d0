#include "tests/oracle/ray_path.hpp"

#include <algorithm>
#include <limits>

namespace ridgeline::oracle {
namespace {

constexpr std::size_t nodes = 5;

using Values = std::array<double, nodes>;

/// Chebyshev nodes, and what turns values there into the coefficients of the polynomial through
/// them: coefficient m is the sum over k of from_values[m][k] times value k.
struct Nodes {
  Values s{};
  std::array<Values, nodes> from_values{};
};

Nodes make_nodes() {
  Nodes result;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double angle = (2.0 * static_cast<double>(k) + 1) * pi / (2 * nodes);
    result.s[k] = std::cos(angle);
    Values a{};  // the share of value k in each Chebyshev coefficient
    for (std::size_t m = 0; m < nodes; ++m) {
      a[m] = (m == 0 ? 1.0 : 2.0) / nodes * std::cos(static_cast<double>(m) * angle);
    }
    const Values of_value{a[0] - a[2] + a[4], a[1] - 3 * a[3], 2 * a[2] - 8 * a[4], 4 * a[3],
                          8 * a[4]};
    for (std::size_t m = 0; m < nodes; ++m) result.from_values[m][k] = of_value[m];
  }
  return result;
}

const Nodes chebyshev = make_nodes();

Quartic through(const Values& values) {
  Quartic result;
  for (std::size_t m = 0; m < nodes; ++m) {
    for (std::size_t k = 0; k < nodes; ++k) {
      result.c[m] += chebyshev.from_values[m][k] * values[k];
    }
  }
  return result;
}

/// The one root of a function that changes sign between `from` and `to`.
template <class Function, class Slope>
double root(const Function& f, const Slope& slope, double from, double to) {
  const double at_from = f(from);
  const double at_to = f(to);
  const bool rising = at_to > 0;
  double s = from + (to - from) * at_from / (at_from - at_to);
  for (int round = 0; round < 80; ++round) {
    const double value = f(s);
    if (value == 0) return s;
    ((value > 0) == rising ? to : from) = s;
    const double step = -value / slope(s);
    const double next = s + step;
    if (std::isfinite(next) && next > from && next < to) {
      s = next;
      if (std::abs(step) < 1e-15) return s;
    } else {
      s = 0.5 * (from + to);
    }
    if (to - from < 1e-15) return s;
  }
  return s;
}

void append_monotone(const Quartic& polynomial, double value, double from, double to,
                     std::vector<double>& crossings) {
  const double at_from = polynomial.at(from) - value;
  const double at_to = polynomial.at(to) - value;
  if ((at_from > 0) == (at_to > 0)) return;
  crossings.push_back(root([&](double s) { return polynomial.at(s) - value; },
                           [&](double s) { return polynomial.slope(s); }, from, to));
}

}  // namespace

AxisPassage::AxisPassage(const Vec3& eye, const Vec3& direction) {
  const double across = std::hypot(direction.x, direction.y);
  if (!(across > 0)) {
    singular_m_ = std::numeric_limits<double>::infinity();
    return;
  }
  const double distance_m = std::abs(eye.x * direction.y - eye.y * direction.x) / across;
  nearest_m_ = -(eye.x * direction.x + eye.y * direction.y) / (across * across);
  singular_m_ = distance_m / across;
}

double AxisPassage::stretch_length_m(double from_m) const {
  // The interpolation error falls with the fifth power of length over distance from the
  // singularity; at this share of it the error is below 1e-12 of the distance.
  constexpr double share = 0.012;
  constexpr double longest_m = 16000;  // for the Earth's own curvature
  return std::min(share * std::hypot(singular_m_, from_m - nearest_m_), longest_m);
}

double AxisPassage::past_axis_m(double from_m) const {
  constexpr double through_m = 1e-3;
  if (singular_m_ > through_m || std::abs(from_m - nearest_m_) > through_m) return from_m;
  return nearest_m_ + through_m * (1 + 1e-6);
}

Stretch stretch(const Vec3& eye, const Vec3& direction, double from_m, double to_m,
                double near_lon_deg) {
  Stretch result;
  result.middle_m = 0.5 * (from_m + to_m);
  result.half_m = 0.5 * (to_m - from_m);
  Values lat{};
  Values lon{};
  Values height{};
  // The nodes run from the end to the beginning.
  for (std::size_t k = nodes; k-- > 0;) {
    const Geodetic g = geodetic_from_ecef(eye + result.distance_m(chebyshev.s[k]) * direction);
    lat[k] = g.lat_deg;
    lon[k] = g.lon_deg + 360.0 * std::round((near_lon_deg - g.lon_deg) / 360.0);
    near_lon_deg = lon[k];
    height[k] = g.height_m;
  }
  result.lat_deg = through(lat);
  result.lon_deg = through(lon);
  result.height_m = through(height);
  return result;
}

Quartic datum_height_m(const Stretch& stretch, const GeoidPatch& patch) {
  Values values{};
  for (std::size_t k = 0; k < nodes; ++k) {
    const double s = chebyshev.s[k];
    values[k] = patch.at(stretch.lat_deg.at(s), stretch.lon_deg.at(s));
  }
  const Quartic undulation = through(values);
  Quartic result = stretch.height_m;
  for (std::size_t i = 0; i < result.c.size(); ++i) result.c[i] -= undulation.c[i];
  return result;
}

void append_crossings(const Quartic& polynomial, double value, double from, double to,
                      std::vector<double>& crossings) {
  const double slope_from = polynomial.slope(from);
  const double slope_to = polynomial.slope(to);
  if ((slope_from > 0) == (slope_to > 0)) {
    append_monotone(polynomial, value, from, to, crossings);
    return;
  }
  const double turn =
      root([&](double s) { return polynomial.slope(s); },
           [&](double s) {
             return 2 * polynomial.c[2] + s * (6 * polynomial.c[3] + s * 12 * polynomial.c[4]);
           },
           from, to);
  append_monotone(polynomial, value, from, turn, crossings);
  append_monotone(polynomial, value, turn, to, crossings);
}

}  // namespace ridgeline::oracle
