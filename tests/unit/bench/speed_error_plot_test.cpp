// The plot of speed against error: which points are marked, and that the picture is well made.
#include "sim/bench/speed_error_plot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/bench/svg_page.hpp"

namespace ridgeline::sim {
namespace {

int count_of(const std::string& text, const std::string& word) {
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

/// Every element is closed, and no text holds a bare `<` or `&`.
void expect_well_formed(const std::string& svg) {
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  int open = 0;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string element = svg.substr(at, end - at + 1);
    EXPECT_EQ(element.find('<', 1), std::string::npos) << element;
    EXPECT_EQ(count_of(element, "\"") % 2, 0) << element;
    if (element[1] == '/') {
      --open;
    } else if (element[element.size() - 2] != '/') {
      ++open;
    }
    EXPECT_GE(open, 0);
  }
  EXPECT_EQ(open, 0);
}

TEST(ParetoFront, is_what_nothing_beats_in_both) {
  const std::vector<PlotPoint> points{{30, 1}, {10, 4},   {20, 4}, {40, 2},
                                      {10, 5}, {50, 0.5}, {30, 1}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 0, 5}));
  EXPECT_TRUE(pareto_front({}).empty());
}

std::vector<SpeedErrorSeries> two_series() {
  return {{"pgm <old> & plain", {{"512x256", 20, 18, 1.5, 0}, {"400x1600", 60, 9, 0.4, 0}}},
          {"ridgeline", {{"0.5", 30, 0.2, 0, 0.5}, {"4", 15, 3, 0.1, 4}, {"8", 0, 0, 0, 0}}}};
}

TEST(SpeedErrorPlot, is_well_formed_and_holds_every_name_and_label_that_fits) {
  const std::string svg = speed_error_svg("a < b & \"c\"", two_series());
  expect_well_formed(svg);
  EXPECT_EQ(count_of(svg, "pgm &lt;old&gt; &amp; plain"), 1);
  EXPECT_EQ(count_of(svg, ">ridgeline<"), 1);
  for (const char* label : {">512x256<", ">400x1600<"}) EXPECT_EQ(count_of(svg, label), 2) << label;
  EXPECT_EQ(count_of(svg, "median, ms"), 2);
  EXPECT_EQ(count_of(svg, "largest error found, px"), 1);
}

TEST(SpeedErrorPlot, a_point_without_a_time_is_left_out) {
  const std::string svg = speed_error_svg("title", two_series());
  EXPECT_EQ(count_of(svg, ">8<"), 0);
}

TEST(SpeedErrorPlot, no_measurement_at_all_is_an_empty_plot) {
  expect_well_formed(speed_error_svg("title", {}));
  expect_well_formed(speed_error_svg("title", {{"mesh", {{"", 5, 0, 0, 0}}}}));
}

TEST(SvgPage, labels_of_many_points_in_one_place_do_not_overlap) {
  SvgPage page(400, 400);
  page.take({193, 194, 207, 206});
  const Box frame{0, 0, 400, 400};
  for (int k = 0; k < 30; ++k) page.label(200, 200, "label", frame, "");
  const std::string svg = page.finished();
  std::vector<std::pair<double, double>> places;
  for (std::size_t at = svg.find("<text x=\""); at != std::string::npos;
       at = svg.find("<text x=\"", at + 1)) {
    const double x = std::atof(svg.c_str() + at + 9);
    const double y = std::atof(svg.c_str() + svg.find("y=\"", at) + 3);
    for (const auto& [other_x, other_y] : places) {
      EXPECT_TRUE(std::abs(x - other_x) >= 5 * 5.5 || std::abs(y - other_y) >= 10.9)
          << x << ' ' << y << " on " << other_x << ' ' << other_y;
    }
    places.emplace_back(x, y);
  }
  EXPECT_GE(places.size(), 3U);
  EXPECT_LT(places.size(), 30U);
}

}  // namespace
}  // namespace ridgeline::sim
