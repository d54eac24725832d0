#pragma once
#include <array>
#include <span>
#include <vector>

namespace ridgeline {

/// Three coordinates and their first two derivatives at one time.
struct SplinePoint {
  std::array<double, 3> position{};
  std::array<double, 3> velocity{};
  std::array<double, 3> acceleration{};
};

/// A natural cubic smoothing spline through points in space: among all curves it minimises
/// sum |p_i - s(t_i)|^2 + smoothing * integral |s''|^2 dt.
/// For samples every h seconds a motion of angular frequency w keeps the part 1 / (1 + smoothing h
/// w^4): with 1 s^3 at 1 Hz a 20 s circle keeps 99 % of its radius, and what is faster than 6 s is
/// halved or less. Source: Reinsch (1967), Numerische Mathematik 10; in the form of Green and
/// Silverman (1994), section 2.3.
class SmoothingSpline {
 public:
  /// Fits the spline. Domain: at least 3 ascending times, as many points, smoothing >= 0 (0
  /// interpolates). Cost:   O(n).
  SmoothingSpline(std::span<const double> times_s, std::span<const std::array<double, 3>> points,
                  double smoothing_s3);

  /// Point at a time; times outside the knots are moved to the nearest one.
  [[nodiscard]] SplinePoint at(double time_s) const;

  [[nodiscard]] double first_time_s() const { return times_s_.front(); }
  [[nodiscard]] double last_time_s() const { return times_s_.back(); }

 private:
  std::vector<double> times_s_;
  std::vector<std::array<double, 3>> values_;
  std::vector<std::array<double, 3>> second_;  ///< second derivatives at the knots
};

}  // namespace ridgeline
