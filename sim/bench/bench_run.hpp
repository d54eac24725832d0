#pragma once
#include "sim/bench/bench.hpp"
#include "sim/bench/bench_row.hpp"

namespace ridgeline::sim {

/// Measures the methods at the views. Progress goes to standard error.
/// `tolerant`: methods that this build does not know are absent, not an error.
/// Outcome: the message names the file or the method and what is wrong with it.
Outcome run_bench(const BenchOptions& options, const std::vector<BenchView>& views, bool tolerant,
                  BenchResult& result);

}  // namespace ridgeline::sim
