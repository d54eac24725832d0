// The norming constant of the check points of error_rad, computed: how much larger than at the
// check points a polynomial of the counted degree can be between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/unit/bound/check_points.hpp"

namespace ridgeline::test {
namespace {

constexpr double pi = std::numbers::pi;
using Row = std::vector<double>;

/// (E, N) polynomials without a constant term, over the distance: all of 1 <= i + j <= degree.
Row basis_at(double r, double alpha) {
  Row row;
  const double e = std::sin(alpha), n = std::cos(alpha);
  for (int total = 1; total <= counted_degree; ++total) {
    for (int i = 0; i <= total; ++i) {
      row.push_back(std::pow(r, total - 1) * std::pow(e, i) * std::pow(n, total - i));
    }
  }
  return row;
}

/// Solves a symmetric positive definite system in place (Cholesky). A tiny pivot is left out.
Row solve(std::vector<Row> a, Row b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
    a[j][j] = std::sqrt(std::max(a[j][j], 1e-26));
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
      a[i][j] /= a[j][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

/// Weights w with sum w_k p(check point k) = p(there) for every p: then |p(there)| is at most
/// sum |w_k| times the largest at the check points. The sum is made small by reweighting.
double weights_sum(const std::vector<Row>& points, const Row& there) {
  const std::size_t n = there.size();
  Row weight(points.size(), 1.0), w(points.size());
  double best = 1e30;
  for (int round = 0; round < 26; ++round) {
    std::vector<Row> matrix(n, Row(n));
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          matrix[i][j] += weight[k] * points[k][i] * points[k][j];
        }
      }
    }
    const Row factor = solve(matrix, there);
    double sum = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      double value = 0;
      for (std::size_t i = 0; i < n; ++i) value += points[k][i] * factor[i];
      w[k] = weight[k] * value;
      sum += std::abs(w[k]);
    }
    double missed = 0;  // the weights must reproduce the polynomials, or they prove nothing
    for (std::size_t i = 0; i < n; ++i) {
      double value = -there[i];
      for (std::size_t k = 0; k < points.size(); ++k) value += w[k] * points[k][i];
      missed = std::max(missed, std::abs(value));
    }
    if (missed < 1e-7) best = std::min(best, sum);
    for (std::size_t k = 0; k < points.size(); ++k) weight[k] = std::abs(w[k]) + 1e-4;
  }
  return best;
}

TEST(MapError, check_points_norm_polynomials_of_degree_9) {
  std::vector<Row> points;
  for (int i = 0; i < 2 * check_azimuths; ++i) {  // the other half by symmetry
    for (int k = 1; k <= check_radii; ++k) {
      points.push_back(
          basis_at(std::cos(pi * (2 * k - 1) / (4 * check_radii)), pi * i / check_azimuths));
    }
  }
  double largest = 0;
  for (const double r : {0.02, 0.11, 0.5, 0.93, 0.97, 0.99, 1.0}) {
    for (const double alpha : {0.0, 0.25, 0.5, 1.0}) {
      largest = std::max(largest, weights_sum(points, basis_at(r, alpha * pi / check_azimuths)));
    }
  }
  std::printf("[ bound ] norming constant: at most %.3f computed, %.3f derived\n", largest,
              norming_constant());
  EXPECT_LE(largest, norming_constant());
  EXPECT_GE(largest, 1.0);
}

}  // namespace
}  // namespace ridgeline::test
