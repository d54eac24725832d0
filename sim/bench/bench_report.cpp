#include "sim/bench/bench_report.hpp"

#include <algorithm>

#include "sim/output/atomic_file.hpp"

namespace ridgeline::sim {
namespace {

/// What tells settings of one method apart: their values, or the first words of all.
std::string label_of(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos) return {};
  std::string label, settings = spec.substr(colon + 1);
  while (!settings.empty()) {
    const std::size_t end = std::min(settings.find(','), settings.size());
    const std::string setting = settings.substr(0, end);
    const std::string name = setting.substr(0, setting.find('='));
    const bool plain = name == "grid" || name == "error";
    label += (label.empty() ? "" : " ") + (plain ? setting.substr(name.size() + 1) : setting);
    settings.erase(0, end + 1);
  }
  return label;
}

}  // namespace

std::vector<SpeedErrorSeries> plot_series(const BenchResult& result) {
  std::vector<SpeedErrorSeries> series;
  for (const BenchRow& row : result.rows) {
    if (row.view != "all" || row.frame_ms.empty() || row.error.errors_px.empty()) continue;
    auto one = std::find_if(series.begin(), series.end(),
                            [&](const SpeedErrorSeries& s) { return s.name == row.method; });
    if (one == series.end()) one = series.insert(series.end(), {row.method, {}});
    one->points.push_back({label_of(row.spec), row.median_ms(), row.error.worst_px,
                           row.error.mean_px(), row.bound_px.value_or(0.0)});
  }
  return series;
}

Outcome write_bench_files(const BenchOptions& options, const BenchResult& result,
                          const std::string& table) {
  const auto write = [](const std::string& file, const std::string& text) {
    return file.empty() ? Outcome{} : write_file(file, text);
  };
  Outcome written = write(options.json_file, bench_json(result));
  if (!written.ok()) return written;
  written = write(options.markdown_file, table);
  if (!written.ok()) return written;
  const std::string title = "Speed against error, " + std::to_string(result.width_px) + " x " +
                            std::to_string(result.height_px) + " px";
  return write(options.svg_file, speed_error_svg(title, plot_series(result)));
}

}  // namespace ridgeline::sim
