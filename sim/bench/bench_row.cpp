#include "sim/bench/bench_row.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "sim/output/formatted.hpp"
#include "sim/output/percentile.hpp"

namespace ridgeline::sim {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <typename T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

Json row_json(const BenchRow& row) {
  Json json;
  json["method"] = row.method;
  json["params"] = row.params;
  json["terrain"] = row.terrain;
  json["view"] = row.view;
  json["epsilon_px"] = or_null(row.epsilon_px);
  json["bound_px"] = or_null(row.bound_px);
  json["frame_ms_median"] = row.median_ms();
  json["frame_ms_p99"] = percentile(row.frame_ms, 0.99);
  json["frame_ms_max"] = percentile(row.frame_ms, 1.0);
  json["core_ms"] = row.median_core_ms();
  json["gpu_ms"] = or_null(row.median_gpu_ms());
  json["error_px_max"] = row.error.worst_px;
  json["error_px_max_is_larger"] = row.error.worst_is_larger;
  json["error_px_mean"] = row.error.mean_px();
  json["error_px_p99"] = percentile(row.error.errors_px, 0.99);
  json["percent_over_1px"] = row.error.percent_over_px(1.0);
  json["wrong_class_pixels"] = row.error.wrong_class;
  json["judged_pixels"] = row.error.errors_px.size();
  json["ray_cast_share"] = row.ray_cast_share;
  const std::optional<PixelSteps> steps = row.mean_steps();
  const auto part = [&](double PixelSteps::*of) { return steps ? Json((*steps).*of) : Json(); };
  json["steps_per_pixel"] = steps ? Json(steps->all()) : Json();
  json["nodes_per_pixel"] = part(&PixelSteps::nodes);
  json["cells_per_pixel"] = part(&PixelSteps::cells);
  json["grid_nodes_per_pixel"] = part(&PixelSteps::grid_nodes);
  json["gpu_bytes"] = row.gpu_bytes;
  json["heap_bytes"] = row.heap_bytes;
  json["build_ms"] = row.build_ms;
  json["frames"] = row.frame_ms.size();
  json["range_m"] = row.range_m;
  json["removed_views"] = row.removed_views;
  json["spec"] = row.spec;
  return json;
}

void add_row(std::string& text, const BenchRow& row, double fastest_ms) {
  constexpr double mib = 1.0 / (1024.0 * 1024.0);
  const auto number = [](const std::optional<double>& value, const char* format) {
    char word[32] = "–";
    if (value) std::snprintf(word, sizeof word, format, *value);
    return std::string(word);
  };
  text +=
      formatted("| %s | %s | %.1f | %.1f | %.1f | %.2f | %.1f | %s |", row.spec.c_str(),
                row.view.c_str(), row.median_ms(), percentile(row.frame_ms, 0.99),
                percentile(row.frame_ms, 1.0), fastest_ms > 0 ? row.median_ms() / fastest_ms : 0.0,
                row.median_core_ms(), number(row.median_gpu_ms(), "%.1f").c_str());
  text +=
      formatted(" %s | %s%.3f | %.3f | %.4f | %.2f | %d | %.0f | %s | %.1f | %.1f | %.0f |\n",
                number(row.bound_px, "%.3f").c_str(), row.error.worst_is_larger ? "> " : "",
                row.error.worst_px, percentile(row.error.errors_px, 0.99), row.error.mean_px(),
                row.error.percent_over_px(1.0), row.error.wrong_class, 100.0 * row.ray_cast_share,
                steps_text(row).c_str(), static_cast<double>(row.gpu_bytes) * mib,
                static_cast<double>(row.heap_bytes) * mib, row.build_ms);
}

void add_table(std::string& text, const BenchResult& result, bool of_all) {
  text +=
      "| method | view | median ms | p99 ms | max ms | times fastest | core ms | GPU ms | bound px "
      "| error max px | p99 px | mean px | % over 1 px | wrong class | % ray cast | steps a px, "
      "nodes + cells | "
      "GPU MiB | heap MiB | build ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const BenchRow& row : result.rows) {
    if ((row.view == "all") != of_all) continue;
    double fastest_ms = row.median_ms();
    for (const BenchRow& other : result.rows) {
      if (other.view == row.view) fastest_ms = std::min(fastest_ms, other.median_ms());
    }
    add_row(text, row, fastest_ms);
  }
  for (const AbsentMethod& absent : result.absent) {
    text += formatted("| %s | absent: %s |", absent.spec.c_str(), absent.why.c_str());
    for (int column = 2; column < 19; ++column) text += " – |";
    text += "\n";
  }
}

/// What the figures of some methods leave out: views without a picture, shorter ranges.
void add_notes(std::string& text, const BenchResult& result) {
  double longest_m = 0;
  for (const BenchRow& row : result.rows) longest_m = std::max(longest_m, row.range_m);
  for (const BenchRow& row : result.rows) {
    if (row.view != "all") continue;
    if (row.removed_views > 0) {
      text += formatted("\n%s drew nothing in %d views: it could give no bound there.\n",
                        row.spec.c_str(), row.removed_views);
    }
    if (row.range_m > 0 && row.range_m < longest_m) {
      text += formatted("\n%s drew no farther than %.1f km in some view, others %.1f km.\n",
                        row.spec.c_str(), row.range_m * 1e-3, longest_m * 1e-3);
    }
  }
}

}  // namespace

void BenchError::join(const BenchError& other) {
  append(errors_px, other.errors_px);
  worst_px = std::max(worst_px, other.worst_px);
  worst_is_larger = worst_is_larger || other.worst_is_larger;
  wrong_class += other.wrong_class;
}

double BenchError::mean_px() const {
  if (errors_px.empty()) return 0;
  return std::accumulate(errors_px.begin(), errors_px.end(), 0.0) /
         static_cast<double>(errors_px.size());
}

double BenchError::percent_over_px(double limit_px) const {
  if (errors_px.empty()) return 0;
  const auto over = std::count_if(errors_px.begin(), errors_px.end(),
                                  [&](double error_px) { return error_px > limit_px; });
  return 100.0 * static_cast<double>(over) / static_cast<double>(errors_px.size());
}

void BenchRow::join(const BenchRow& other) {
  const auto before = static_cast<double>(frame_ms.size());
  const auto more = static_cast<double>(other.frame_ms.size());
  if (before + more > 0) {
    ray_cast_share = (ray_cast_share * before + other.ray_cast_share * more) / (before + more);
  }
  append(frame_ms, other.frame_ms);
  append(core_ms, other.core_ms);
  append(gpu_ms, other.gpu_ms);
  append(steps, other.steps);
  error.join(other.error);
  if (other.bound_px) bound_px = std::max(bound_px.value_or(0.0), *other.bound_px);
  gpu_bytes = std::max(gpu_bytes, other.gpu_bytes);
  heap_bytes = std::max(heap_bytes, other.heap_bytes);
  build_ms = std::max(build_ms, other.build_ms);
  removed_views += other.removed_views;
  if (other.range_m > 0 && (range_m == 0 || other.range_m < range_m)) range_m = other.range_m;
}

double BenchRow::median_ms() const {
  return percentile(frame_ms, 0.5);
}

double BenchRow::median_core_ms() const {
  return percentile(core_ms, 0.5);
}

std::optional<double> BenchRow::median_gpu_ms() const {
  const double median = percentile(gpu_ms, 0.5);
  return median > 0 ? std::optional(median) : std::nullopt;
}

std::optional<PixelSteps> BenchRow::mean_steps() const {
  if (steps.empty()) return std::nullopt;
  PixelSteps mean;
  const double share = 1.0 / static_cast<double>(steps.size());
  for (const PixelSteps& one : steps) {
    mean.nodes += share * one.nodes;
    mean.cells += share * one.cells;
    mean.grid_nodes += share * one.grid_nodes;
  }
  return mean;
}

std::string steps_text(const BenchRow& row) {
  const std::optional<PixelSteps> steps = row.mean_steps();
  if (!steps) return row.frame_ms.empty() ? "–" : "not counted";
  if (steps->all() == 0) return "0";
  char text[48];
  std::snprintf(text, sizeof text, "%.2f + %.2f", steps->nodes + steps->grid_nodes, steps->cells);
  return text;
}

std::string bench_json(const BenchResult& result) {
  Json rows = Json::array(), absent = Json::array();
  for (const BenchRow& row : result.rows) rows.push_back(row_json(row));
  for (const AbsentMethod& one : result.absent) {
    absent.push_back({{"spec", one.spec}, {"why", one.why}});
  }
  const Json json{{"driver", result.driver},
                  {"width", result.width_px},
                  {"height", result.height_px},
                  {"rows", rows},
                  {"absent", absent}};
  return json.dump(1) + "\n";
}

std::string bench_markdown(const BenchResult& result) {
  std::string text;
  text += formatted("%s, %d x %d, terrain %s\n\nOver all views:\n\n", result.driver.c_str(),
                    result.width_px, result.height_px, result.terrain.c_str());
  add_table(text, result, true);
  add_notes(text, result);
  text += "\nView by view:\n\n";
  add_table(text, result, false);
  return text;
}

}  // namespace ridgeline::sim
