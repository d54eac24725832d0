#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ridgeline::sim {

/// Errors of one or more pictures against the oracle's truth. Units: px.
struct BenchError {
  std::vector<double> errors_px;  ///< of pixels spread evenly over the pictures
  double worst_px = 0;            ///< of those and of the pixels at depth jumps
  bool worst_is_larger = false;   ///< at least that: the search ended there
  int wrong_class = 0;            ///< of the even ones: sky, ground or unknown where it cannot be

  void join(const BenchError& other);
  [[nodiscard]] double mean_px() const;
  [[nodiscard]] double percent_over_px(double limit_px) const;
};

/// Steps of the marches of one frame, by its pixels.
struct PixelSteps {
  double nodes = 0, cells = 0;  ///< of rays
  double grid_nodes = 0;        ///< of the planes of a projected grid

  [[nodiscard]] double all() const { return nodes + cells + grid_nodes; }
};

/// One method at one view, or over all of them.
struct BenchRow {
  std::string method;  ///< name alone
  std::string spec;    ///< as --methods takes it
  std::string params;  ///< as the method tells them
  std::string terrain;
  std::string view;  ///< `all` in the row that sums a method up
  std::optional<double> epsilon_px, bound_px;
  std::vector<double> frame_ms, core_ms, gpu_ms;  ///< of each counted frame
  std::vector<PixelSteps> steps;                  ///< of each view; none: not counted
  double ray_cast_share = 0;                      ///< mean over the counted frames
  BenchError error;
  std::size_t gpu_bytes = 0, heap_bytes = 0;
  double build_ms = 0;
  double range_m = 0;     ///< shortest display range drawn; 0: nothing was drawn
  int removed_views = 0;  ///< in which nothing was drawn because no bound could be given

  /// Takes in what another row of the same method measured.
  void join(const BenchRow& other);
  [[nodiscard]] double median_ms() const;
  [[nodiscard]] double median_core_ms() const;
  [[nodiscard]] std::optional<double> median_gpu_ms() const;
  [[nodiscard]] std::optional<PixelSteps> mean_steps() const;
};

/// A method that was asked for and could not be drawn.
struct AbsentMethod {
  std::string spec, why;
};

struct BenchResult {
  std::string driver, terrain;
  int width_px = 0, height_px = 0;
  std::vector<BenchRow> rows;  ///< of each view, then those over all
  std::vector<AbsentMethod> absent;
};

/// Steps a pixel of a row: nodes of both sorts + cells; a word where nobody counted them.
[[nodiscard]] std::string steps_text(const BenchRow& row);

/// The rows as JSON, contract section 4; `absent` stands beside them.
[[nodiscard]] std::string bench_json(const BenchResult& result);

/// The rows as a Markdown table, those over all views first.
[[nodiscard]] std::string bench_markdown(const BenchResult& result);

}  // namespace ridgeline::sim
