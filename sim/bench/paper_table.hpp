#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/bench/bench_row.hpp"

namespace ridgeline::sim {

/// One setting of a paper: how we draw it, and what the paper says of it.
struct PaperRow {
  const char* spec;
  const char* setting;        ///< in the paper's words
  std::optional<double> fps;  ///< published, on the paper's machine
  const char* error;          ///< published; empty: none
};

/// One paper's table. Rows without `fps` are ours, for comparison.
struct Paper {
  std::string_view name;  ///< as --paper takes it
  const char* source;
  const char* machine;  ///< the paper's, and what it drew
  int width_px, height_px;
  std::vector<PaperRow> rows;  ///< the first is what ratios are taken to
  const char* remark;
};

/// The four papers behind the project.
[[nodiscard]] const std::vector<Paper>& papers();
/// Null where there is none of that name.
[[nodiscard]] const Paper* find_paper(std::string_view name);

/// The published rows beside ours, as Markdown. Speeds are compared as ratios to the first row: the
/// machines have nothing in common. `result` holds rows over all views, found by their spec.
[[nodiscard]] std::string paper_markdown(const Paper& paper, const BenchResult& result);

}  // namespace ridgeline::sim
