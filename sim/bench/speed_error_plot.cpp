#include "sim/bench/speed_error_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "sim/bench/svg_page.hpp"

namespace ridgeline::sim {
namespace {

constexpr double page_width = 1180, page_height = 600;
constexpr double panel_width = 430, panel_height = 430, panel_top = 80;
constexpr double marker_px = 4.5;
constexpr const char* grid_style = "stroke=\"#d8d8d8\" stroke-width=\"0.7\"";
constexpr const char* faint_style = "stroke=\"#eeeeee\" stroke-width=\"0.6\"";
constexpr const char* frame_style = "stroke=\"#404040\" stroke-width=\"1\"";
constexpr const char* tick_style = "font-size=\"11\" fill=\"#303030\"";
constexpr const char* title_style = "font-size=\"13\" fill=\"#000000\"";
constexpr const char* front_style =
    "stroke=\"#9a9a9a\" stroke-width=\"2\" stroke-dasharray=\"5 3\"";
constexpr const char* ring_style = "stroke=\"#000000\" stroke-width=\"1.3\"";

std::string colour_of(const std::string& name, std::size_t index) {
  constexpr const char* colours[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9",
                                     "#8c564b", "#6f6f6f", "#6a3d9a", "#b2a000", "#17becf"};
  if (name == "ridgeline") return "#d00000";
  return colours[index % std::size(colours)];
}

/// A logarithmic axis from a value to another on the page.
struct LogAxis {
  double low = 1, high = 10, from = 0, to = 1;

  [[nodiscard]] double at(double value) const {
    const double share = std::log(value / low) / std::log(high / low);
    return from + (to - from) * std::clamp(share, 0.0, 1.0);
  }
  [[nodiscard]] double decades() const { return std::log10(high / low); }
};

LogAxis axis_over(std::vector<double> values, double from, double to) {
  LogAxis axis{1, 10, from, to};
  if (values.empty()) return axis;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  constexpr double margin = 1.35;
  axis.low = *least / margin;
  axis.high = *most * margin;
  return axis;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Calls use(value, whether it is labelled) for 1, 2 and 5 times every power of ten of the axis,
/// and for more where it is short.
template <typename Use>
void over_ticks(const LogAxis& axis, const Use& use) {
  constexpr double few_decades = 2.5;
  for (int power = -6; power <= 6; ++power) {
    for (const double digit : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0}) {
      const double value = digit * std::pow(10.0, power);
      const bool coarse = digit == 1.0 || digit == 2.0 || digit == 5.0;
      if (value < axis.low || value > axis.high || (!coarse && axis.decades() > 1.0)) continue;
      use(value, digit == 1.0 || axis.decades() < few_decades);
    }
  }
}

void draw_axes(SvgPage& page, const LogAxis& x, const LogAxis& y, const std::string& title) {
  over_ticks(x, [&](double value, bool labelled) {
    page.line(x.at(value), y.from, x.at(value), y.to, labelled ? grid_style : faint_style);
    if (labelled) page.text(x.at(value), y.from + 16, short_number(value), "middle", tick_style);
  });
  over_ticks(y, [&](double value, bool labelled) {
    page.line(x.from, y.at(value), x.to, y.at(value), labelled ? grid_style : faint_style);
    if (labelled) page.text(x.from - 6, y.at(value) + 4, short_number(value), "end", tick_style);
  });
  page.polyline({{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}, {x.from, y.from}},
                frame_style);
  page.text(0.5 * (x.from + x.to), y.from + 36, "frame time, median, ms (left is faster)", "middle",
            title_style);
  page.text(0.5 * (x.from + x.to), y.to - 10, title, "middle", title_style);
}

void draw_front(SvgPage& page, const LogAxis& x, const LogAxis& y,
                const std::vector<PlotPoint>& points) {
  const std::vector<std::size_t> front = pareto_front(points);
  std::vector<std::pair<double, double>> steps;
  double before = y.to;
  for (const std::size_t k : front) {
    const double px = x.at(points[k].ms), py = y.at(points[k].error_px);
    steps.emplace_back(px, before);
    steps.emplace_back(px, py);
    before = py;
  }
  if (steps.empty()) return;
  steps.emplace_back(x.to, before);
  page.polyline(steps, front_style);
  for (const std::size_t k : front) {
    page.ring(x.at(points[k].ms), y.at(points[k].error_px), marker_px + 4, ring_style);
  }
}

/// One series in one panel: its points on the page, its line, its marks.
using Way = std::vector<std::pair<double, double>>;

void draw_series(SvgPage& page, const SpeedErrorSeries& series, std::size_t index, const Way& way) {
  const std::string colour = colour_of(series.name, index);
  const char* width = series.name == "ridgeline" ? "2.6" : "1.4";
  page.polyline(way, "stroke=\"" + colour + "\" stroke-width=\"" + width + "\"");
  for (const auto& [x, y] : way) page.marker(x, y, static_cast<int>(index), colour, marker_px);
}

void draw_labels(SvgPage& page, const SpeedErrorSeries& series, std::size_t index, const Way& way,
                 const Box& frame) {
  const std::string style =
      "font-size=\"9.5\" stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\" fill=\"" +
      colour_of(series.name, index) + "\"";
  for (std::size_t p = 0; p < way.size(); ++p) {
    const std::string& words = series.points[p].label;
    if (!words.empty()) page.label(way[p].first, way[p].second, words, frame, style);
  }
}

/// One panel; `error` picks which error of a point.
template <typename Error>
void draw_panel(SvgPage& page, double left, const std::string& title, bool with_bounds,
                const std::vector<SpeedErrorSeries>& series, const Error& error) {
  std::vector<double> times, errors;
  std::vector<PlotPoint> points;
  for (const SpeedErrorSeries& one : series) {
    for (const SpeedError& point : one.points) {
      points.push_back({point.ms, std::max(error(point), plot_floor_px)});
      times.push_back(points.back().ms);
      errors.push_back(points.back().error_px);
      if (with_bounds && point.bound_px > 0) errors.push_back(point.bound_px);
    }
  }
  const LogAxis x = axis_over(times, left, left + panel_width);
  const LogAxis y = axis_over(errors, panel_top + panel_height, panel_top);
  draw_axes(page, x, y, title);
  draw_front(page, x, y, points);
  std::vector<Way> ways;
  for (std::size_t s = 0, k = 0; s < series.size(); ++s) {
    ways.emplace_back();
    for (const SpeedError& point : series[s].points) {
      const double px = x.at(points[k].ms), py = y.at(points[k].error_px);
      ++k;
      ways.back().emplace_back(px, py);
      page.take({px - 7, py - 6, px + 7, py + 6});
      if (!with_bounds || !(point.bound_px > 0)) continue;
      const std::string colour = colour_of(series[s].name, s);
      const double bound_y = y.at(std::max(point.bound_px, plot_floor_px));
      page.line(px, py, px, bound_y, "stroke=\"" + colour + "\" stroke-dasharray=\"1 3\"");
      page.ring(px, bound_y, marker_px, "stroke=\"" + colour + "\" stroke-width=\"1.4\"");
      page.take({px - 6, bound_y - 6, px + 6, bound_y + 6});
    }
  }
  const Box frame{x.from + 2, y.to + 2, x.to - 2, y.from - 2};
  for (std::size_t s = 0; s < series.size(); ++s) draw_series(page, series[s], s, ways[s]);
  for (std::size_t s = 0; s < series.size(); ++s) draw_labels(page, series[s], s, ways[s], frame);
}

void draw_legend(SvgPage& page, double left, const std::vector<SpeedErrorSeries>& series) {
  double y = panel_top + 8;
  for (std::size_t s = 0; s < series.size(); ++s, y += 22) {
    const std::string colour = colour_of(series[s].name, s);
    page.line(left, y, left + 26, y, "stroke=\"" + colour + "\" stroke-width=\"2\"");
    page.marker(left + 13, y, static_cast<int>(s), colour, marker_px);
    page.text(left + 34, y + 4, series[s].name, "start", "font-size=\"12\"");
  }
  y += 10;
  page.ring(left + 13, y, marker_px, "stroke=\"#606060\" stroke-width=\"1.4\"");
  page.text(left + 34, y + 4, "promised bound", "start", "font-size=\"12\"");
  y += 24;
  page.ring(left + 13, y, marker_px + 4, ring_style);
  page.text(left + 34, y + 4, "no other is both", "start", "font-size=\"12\"");
  page.text(left + 34, y + 19, "faster and less wrong", "start", "font-size=\"12\"");
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].ms != points[b].ms ? points[a].ms < points[b].ms
                                        : points[a].error_px < points[b].error_px;
  });
  std::vector<std::size_t> front;
  for (const std::size_t k : order) {
    if (front.empty() || points[k].error_px < points[front.back()].error_px) front.push_back(k);
  }
  return front;
}

std::string speed_error_svg(const std::string& title, const std::vector<SpeedErrorSeries>& given) {
  std::vector<SpeedErrorSeries> series;
  for (SpeedErrorSeries one : given) {
    std::erase_if(one.points, [](const SpeedError& point) { return !(point.ms > 0); });
    if (!one.points.empty()) series.push_back(std::move(one));
  }
  SvgPage page(page_width, page_height);
  page.text(60, 32, title, "start", "font-size=\"15\" font-weight=\"bold\"");
  constexpr double first = 60, second = first + panel_width + 65;
  draw_panel(page, first, "largest error found, px", true, series,
             [](const SpeedError& point) { return point.worst_px; });
  draw_panel(page, second, "mean error, px", false, series,
             [](const SpeedError& point) { return point.mean_px; });
  draw_legend(page, second + panel_width + 22, series);
  page.text(60, page_height - 22,
            "Error: radius of the smallest disc that makes a pixel sound, by the oracle; " +
                short_number(plot_floor_px) + " px stands for that and less.",
            "start", tick_style);
  return page.finished();
}

}  // namespace ridgeline::sim
