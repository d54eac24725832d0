#pragma once
#include <string>
#include <vector>

namespace ridgeline::sim {

/// One setting of a method: what it costs and how wrong it is.
struct SpeedError {
  std::string label;  ///< of the setting; empty: not labelled
  double ms = 0, worst_px = 0, mean_px = 0;
  double bound_px = 0;  ///< promised; 0: nothing
};

/// One method, its settings in the order in which a line joins them.
struct SpeedErrorSeries {
  std::string name;
  std::vector<SpeedError> points;
};

/// Errors below this are drawn at it: the axis is logarithmic. px
inline constexpr double plot_floor_px = 1e-3;

/// A picture of speed against error, both logarithmic, as SVG: the worst error in one panel, the
/// mean in the other. A promised bound is a hollow mark in the first. Points that no other point
/// beats in both are ringed and joined by steps. Points without a positive time are left out.
[[nodiscard]] std::string speed_error_svg(const std::string& title,
                                          const std::vector<SpeedErrorSeries>& series);

/// Indices of the points that no other beats: none is both faster and less wrong, and of equals the
/// first stays. In order of time.
struct PlotPoint {
  double ms = 0, error_px = 0;
};
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points);

}  // namespace ridgeline::sim
