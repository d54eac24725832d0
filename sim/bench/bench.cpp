#include "sim/bench/bench.hpp"

#include <cstdio>

#include "sim/bench/bench_report.hpp"
#include "sim/bench/bench_run.hpp"

namespace ridgeline::sim {

Outcome bench(const BenchOptions& options) {
  BusProfile profile;
  profile.header_rule = HeaderRule::field;
  profile.heading_reference = HeadingReference::true_north;
  const std::vector<BenchView> views =
      options.log_file.empty() ? fixed_views(options.scene.terrain_folder)
                               : log_views(options.log_file, profile, options.log_views);
  if (views.empty()) {
    const std::string& file =
        options.log_file.empty() ? options.scene.terrain_folder : options.log_file;
    return {Fault::file_malformed, file + ": holds no view to measure at"};
  }
  return bench_at(options, views, options.scene.terrain_folder);
}

Outcome bench_at(const BenchOptions& options, const std::vector<BenchView>& views,
                 const std::string& terrain) {
  BenchResult result;
  if (Outcome run = run_bench(options, views, false, result); !run.ok()) return run;
  result.terrain = terrain;
  for (BenchRow& row : result.rows) row.terrain = terrain;
  const std::string table = bench_markdown(result);
  std::fputs(table.c_str(), stdout);
  return write_bench_files(options, result, table);
}

}  // namespace ridgeline::sim
