#include "sim/import_igc/smoothing_spline.hpp"

#include <algorithm>

#include "core/base/assert.hpp"

namespace ridgeline {
namespace {

/// The symmetric five-band matrix R + smoothing Q^T Q as L D L^T; row by row, from the top.
struct BandFactor {
  std::vector<double> diagonal;  ///< D
  std::vector<double> first;     ///< L, one below the diagonal
  std::vector<double> second;    ///< L, two below the diagonal
};

BandFactor factor(const std::vector<double>& h, double smoothing) {
  const std::size_t count = h.size() - 1;
  BandFactor f;
  f.diagonal.resize(count);
  f.first.resize(count);
  f.second.resize(count);
  const auto inverse = [&](std::size_t index) { return 1.0 / h[index]; };
  for (std::size_t i = 0; i < count; ++i) {
    // Column i of Q holds 1/h_i, -(1/h_i + 1/h_(i+1)), 1/h_(i+1) in rows i, i+1, i+2.
    const double middle = inverse(i) + inverse(i + 1);
    double d = (h[i] + h[i + 1]) / 3.0 + smoothing * (inverse(i) * inverse(i) + middle * middle +
                                                      inverse(i + 1) * inverse(i + 1));
    double e = 0.0;
    double g = 0.0;
    if (i + 1 < count) {
      const double next_middle = inverse(i + 1) + inverse(i + 2);
      e = h[i + 1] / 6.0 - smoothing * inverse(i + 1) * (middle + next_middle);
    }
    if (i + 2 < count) g = smoothing * inverse(i + 1) * inverse(i + 2);
    if (i >= 1) {
      d -= f.diagonal[i - 1] * f.first[i - 1] * f.first[i - 1];
      e -= f.diagonal[i - 1] * f.first[i - 1] * f.second[i - 1];
    }
    if (i >= 2) d -= f.diagonal[i - 2] * f.second[i - 2] * f.second[i - 2];
    f.diagonal[i] = d;
    f.first[i] = e / d;
    f.second[i] = g / d;
  }
  return f;
}

void solve(const BandFactor& f, std::vector<double>& x) {
  const std::size_t count = x.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i >= 1) x[i] -= f.first[i - 1] * x[i - 1];
    if (i >= 2) x[i] -= f.second[i - 2] * x[i - 2];
  }
  for (std::size_t i = 0; i < count; ++i) x[i] /= f.diagonal[i];
  for (std::size_t i = count; i-- > 0;) {
    if (i + 1 < count) x[i] -= f.first[i] * x[i + 1];
    if (i + 2 < count) x[i] -= f.second[i] * x[i + 2];
  }
}

}  // namespace

SmoothingSpline::SmoothingSpline(std::span<const double> times_s,
                                 std::span<const std::array<double, 3>> points, double smoothing_s3)
    : times_s_(times_s.begin(), times_s.end()),
      values_(points.begin(), points.end()),
      second_(points.size()) {
  const std::size_t count = times_s_.size();
  RL_ASSERT(count >= 3 && values_.size() == count);
  std::vector<double> h(count - 1);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    h[i] = times_s_[i + 1] - times_s_[i];
    RL_ASSERT(h[i] > 0.0);
  }
  const BandFactor f = factor(h, smoothing_s3);
  std::vector<double> gamma(count - 2);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < gamma.size(); ++i) {
      gamma[i] = (values_[i + 2][axis] - values_[i + 1][axis]) / h[i + 1] -
                 (values_[i + 1][axis] - values_[i][axis]) / h[i];
    }
    solve(f, gamma);
    for (std::size_t i = 0; i < gamma.size(); ++i) {
      second_[i + 1][axis] = gamma[i];
      const double step = smoothing_s3 * gamma[i];
      values_[i][axis] -= step / h[i];
      values_[i + 1][axis] += step * (1.0 / h[i] + 1.0 / h[i + 1]);
      values_[i + 2][axis] -= step / h[i + 1];
    }
  }
}

SplinePoint SmoothingSpline::at(double time_s) const {
  const double t = std::clamp(time_s, times_s_.front(), times_s_.back());
  const auto above = std::upper_bound(times_s_.begin() + 1, times_s_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - times_s_.begin()) - 1;
  const double h = times_s_[i + 1] - times_s_[i];
  const double b = (t - times_s_[i]) / h;
  const double a = 1.0 - b;
  SplinePoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double y0 = values_[i][axis];
    const double y1 = values_[i + 1][axis];
    const double m0 = second_[i][axis];
    const double m1 = second_[i + 1][axis];
    point.position[axis] =
        a * y0 + b * y1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0;
    point.velocity[axis] =
        (y1 - y0) / h + ((1.0 - 3.0 * a * a) * m0 + (3.0 * b * b - 1.0) * m1) * h / 6.0;
    point.acceleration[axis] = a * m0 + b * m1;
  }
  return point;
}

}  // namespace ridgeline
