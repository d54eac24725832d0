#pragma once
#include "sim/bench/bench.hpp"
#include "sim/bench/bench_row.hpp"
#include "sim/bench/speed_error_plot.hpp"

namespace ridgeline::sim {

/// The rows over all views as lines of a plot: one a method, in the order of its settings.
[[nodiscard]] std::vector<SpeedErrorSeries> plot_series(const BenchResult& result);

/// Writes the files that were asked for; `table` is the Markdown one.
/// Outcome: the message names the file.
Outcome write_bench_files(const BenchOptions& options, const BenchResult& result,
                          const std::string& table);

}  // namespace ridgeline::sim
