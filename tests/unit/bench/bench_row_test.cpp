// Rows of the benchmark: what is added up, what the JSON and the table say.
#include "sim/bench/bench_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/bench/bench_report.hpp"

namespace ridgeline::sim {
namespace {

BenchRow row_of(const std::string& spec, const std::string& view, std::vector<double> frame_ms,
                std::vector<double> errors_px) {
  BenchRow row;
  row.method = spec.substr(0, spec.find(':'));
  row.spec = spec;
  row.params = "some";
  row.terrain = "tiles";
  row.view = view;
  row.core_ms = frame_ms;
  row.frame_ms = std::move(frame_ms);
  row.error.worst_px = *std::max_element(errors_px.begin(), errors_px.end());
  row.error.errors_px = std::move(errors_px);
  return row;
}

BenchResult result_of_two() {
  BenchResult result;
  result.driver = "some driver";
  result.width_px = 64;
  result.height_px = 48;
  result.rows.push_back(row_of("ridgeline:error=1", "low", {10, 11, 50}, {0, 0, 0.5, 2}));
  result.rows.push_back(row_of("mesh", "low", {30}, {0.25}));
  result.rows.push_back(row_of("ridgeline:error=1", "all", {10, 11, 50}, {0, 0, 0.5, 2}));
  result.rows.back().bound_px = 1.25;
  result.rows.back().epsilon_px = 1.0;
  result.rows.push_back(row_of("mesh", "all", {30}, {0.25}));
  result.rows.back().steps = {{1, 0.5, 0.25}, {2, 1.5, 0.75}};
  result.absent.push_back({"embree", "it is absent"});
  return result;
}

TEST(BenchRow, joining_two_views_keeps_every_frame_and_every_pixel) {
  BenchRow all = row_of("mesh", "low", {10, 20, 30}, {0, 1.5});
  all.ray_cast_share = 0.2;
  all.error.wrong_class = 3;
  BenchRow more = row_of("mesh", "high", {100}, {0.5, 0, 8});
  more.ray_cast_share = 1.0;
  more.bound_px = 2.0;
  more.error.wrong_class = 1;
  more.error.worst_is_larger = true;
  more.build_ms = 7;
  more.gpu_ms = {4};
  all.range_m = 100;
  more.range_m = 40;
  more.removed_views = 1;
  all.join(more);
  EXPECT_EQ(all.frame_ms.size(), 4U);
  EXPECT_EQ(all.median_ms(), 30);
  EXPECT_DOUBLE_EQ(all.ray_cast_share, 0.4);
  EXPECT_EQ(all.error.worst_px, 8);
  EXPECT_TRUE(all.error.worst_is_larger);
  EXPECT_EQ(all.error.wrong_class, 4);
  EXPECT_DOUBLE_EQ(all.error.mean_px(), 2.0);
  EXPECT_DOUBLE_EQ(all.error.percent_over_px(1.0), 40.0);
  EXPECT_EQ(all.bound_px, 2.0);
  EXPECT_EQ(all.median_gpu_ms(), 4.0);
  EXPECT_EQ(all.build_ms, 7);
  EXPECT_EQ(all.range_m, 40);
  EXPECT_EQ(all.removed_views, 1);
}

TEST(BenchRow, nothing_measured_is_nothing_and_not_a_division_by_zero) {
  const BenchRow row;
  EXPECT_EQ(row.median_ms(), 0);
  EXPECT_EQ(row.median_gpu_ms(), std::nullopt);
  EXPECT_FALSE(row.mean_steps().has_value());
  EXPECT_EQ(row.error.mean_px(), 0);
  EXPECT_EQ(row.error.percent_over_px(1.0), 0);
}

TEST(BenchJson, has_every_key_of_the_contract_in_every_row) {
  const auto json = nlohmann::json::parse(bench_json(result_of_two()));
  ASSERT_EQ(json["rows"].size(), 4U);
  for (const auto& row : json["rows"]) {
    for (const char* key : {"method",
                            "params",
                            "terrain",
                            "view",
                            "epsilon_px",
                            "bound_px",
                            "frame_ms_median",
                            "frame_ms_p99",
                            "frame_ms_max",
                            "core_ms",
                            "gpu_ms",
                            "error_px_max",
                            "error_px_mean",
                            "error_px_p99",
                            "percent_over_1px",
                            "wrong_class_pixels",
                            "steps_per_pixel",
                            "gpu_bytes",
                            "heap_bytes",
                            "build_ms",
                            "nodes_per_pixel",
                            "cells_per_pixel",
                            "grid_nodes_per_pixel"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
  }
  const auto& ours = json["rows"][2];
  EXPECT_EQ(ours["frame_ms_median"], 11.0);
  EXPECT_EQ(ours["frame_ms_max"], 50.0);
  EXPECT_EQ(ours["bound_px"], 1.25);
  EXPECT_EQ(ours["error_px_max"], 2.0);
  EXPECT_EQ(ours["percent_over_1px"], 25.0);
  EXPECT_TRUE(ours["gpu_ms"].is_null());
  EXPECT_TRUE(ours["steps_per_pixel"].is_null());
  const auto& mesh = json["rows"][3];
  EXPECT_TRUE(mesh["bound_px"].is_null());
  EXPECT_TRUE(mesh["epsilon_px"].is_null());
  EXPECT_EQ(mesh["steps_per_pixel"], 3.0);
  EXPECT_EQ(mesh["nodes_per_pixel"], 1.5);
  EXPECT_EQ(mesh["cells_per_pixel"], 1.0);
  EXPECT_EQ(mesh["grid_nodes_per_pixel"], 0.5);
  EXPECT_EQ(json["absent"][0]["spec"], "embree");
}

TEST(BenchTable, tells_steps_apart_from_none_and_from_those_nobody_counted) {
  BenchResult result = result_of_two();
  const auto has = [&](const std::string& words) {
    return bench_markdown(result).find(words) != std::string::npos;
  };
  EXPECT_TRUE(has("| 2.00 + 1.00 |"));
  EXPECT_TRUE(has("| not counted |"));
  EXPECT_FALSE(has("| 0 | 0.0 |"));
  result.rows.back().steps = {{}, {}};
  EXPECT_TRUE(has("| 0 | 0.0 |"));  // before GPU bytes
}

TEST(BenchTable, every_line_has_as_many_cells_as_its_head) {
  const std::string text = bench_markdown(result_of_two());
  std::size_t at = 0, head = 0;
  int lines = 0;
  while (at < text.size()) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line.empty() || line[0] != '|') {
      head = 0;
      continue;
    }
    const auto cells = static_cast<std::size_t>(std::count(line.begin(), line.end(), '|'));
    if (head == 0) head = cells;
    EXPECT_EQ(cells, head) << line;
    ++lines;
  }
  EXPECT_EQ(lines, 2 * (2 + 2 + 1));
  EXPECT_NE(text.find("absent"), std::string::npos);
}

TEST(BenchTable, says_which_method_drew_less_than_others) {
  BenchResult result = result_of_two();
  EXPECT_EQ(bench_markdown(result).find("drew"), std::string::npos);
  result.rows[2].range_m = 32'700;
  result.rows[2].removed_views = 2;
  result.rows[3].range_m = 100'000;
  const std::string text = bench_markdown(result);
  EXPECT_NE(text.find("ridgeline:error=1 drew nothing in 2 views"), std::string::npos) << text;
  EXPECT_NE(text.find("ridgeline:error=1 drew no farther than 32.7 km"), std::string::npos) << text;
  EXPECT_EQ(text.find("mesh drew"), std::string::npos) << text;
}

TEST(BenchPlot, has_one_line_a_method_over_the_rows_of_all_views) {
  BenchResult result = result_of_two();
  result.rows.push_back(row_of("ridgeline:error=4,planes=2", "all", {8}, {3}));
  const auto series = plot_series(result);
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[0].name, "ridgeline");
  ASSERT_EQ(series[0].points.size(), 2U);
  EXPECT_EQ(series[0].points[0].label, "1");
  EXPECT_EQ(series[0].points[0].bound_px, 1.25);
  EXPECT_EQ(series[0].points[1].label, "4 planes=2");
  EXPECT_EQ(series[1].points[0].label, "");
  EXPECT_EQ(series[1].points[0].ms, 30);
}

}  // namespace
}  // namespace ridgeline::sim
