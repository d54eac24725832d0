#include "sim/bench/bench_run.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "sim/bench/bench_judge.hpp"
#include "sim/bench/bench_method.hpp"
#include "sim/bench/progress_bar.hpp"
#include "tests/oracle/input_error.hpp"

namespace ridgeline::sim {
namespace {

double now_ms() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(time).count();
}

/// What every method needs besides its own: the session's window, targets and tables.
struct Shared {
  std::size_t gpu_bytes = 0, heap_bytes = 0;
  double window_ms = 0;  ///< from raw tiles to a settled window
};

class Run {
 public:
  Run(const BenchOptions& options, Session& session, std::vector<BenchMethod> methods,
      const Shared& shared)
      : options_(options),
        session_(session),
        methods_(std::move(methods)),
        shared_(shared),
        base_(session.settings()),
        judge_(options.scene) {}

  [[nodiscard]] int steps_a_view() const {
    return static_cast<int>(methods_.size()) * (options_.repeats + 2);
  }
  /// The rows of one view, one a method; those of frames that were removed hold no frame.
  Outcome measure(const BenchView& view, ProgressBar& bar, std::vector<BenchRow>& rows);
  [[nodiscard]] std::size_t method_count() const { return methods_.size(); }

 private:
  void use(const BenchMethod& method) {
    session_.settings() = method.settings;
    session_.use(method.method, method.bearing.get());
  }
  [[nodiscard]] BenchRow row_of(const BenchMethod& method, const BenchView& view) const;
  Outcome time_frame(const BenchMethod& method, const BenchView& view, bool counted, BenchRow& row);
  Outcome count_steps(const BenchView& view, BenchRow& row);
  Outcome judge_view(const BenchView& view, ProgressBar& bar, std::vector<BenchRow>& rows);

  const BenchOptions& options_;
  Session& session_;
  std::vector<BenchMethod> methods_;
  Shared shared_;
  FrameSettings base_;
  BenchJudge judge_;
};

BenchRow Run::row_of(const BenchMethod& method, const BenchView& view) const {
  BenchRow row;
  row.method = method.spec.name;
  row.spec = method_text(method.spec);
  row.params = method.params();
  row.terrain = options_.scene.terrain_folder;
  row.view = view.name;
  if (method.method == nullptr) row.epsilon_px = method.settings.error_px;
  row.gpu_bytes = shared_.gpu_bytes;
  row.heap_bytes = shared_.heap_bytes;
  row.build_ms = shared_.window_ms;
  return row;
}

Outcome Run::time_frame(const BenchMethod& method, const BenchView& view, bool counted,
                        BenchRow& row) {
  use(method);
  if (Outcome prepared = session_.prepare(view.input); !prepared.ok()) return prepared;
  const Picture picture = session_.draw(view.input, false);
  if (!counted || picture.report.availability.mode == Mode::removed) return picture.problem;
  row.core_ms.push_back(picture.core_ms);
  row.frame_ms.push_back(picture.cpu_ms);
  row.range_m = picture.report.range_m;
  const auto& ms = picture.counts.pass_ms;
  if (const double gpu_ms = std::accumulate(ms.begin(), ms.end(), 0.0); gpu_ms > 0) {
    row.gpu_ms.push_back(gpu_ms);
  }
  const double bound_px = std::max(picture.report.bound_px, picture.method.bound_px);
  if (bound_px > 0) row.bound_px = std::max(row.bound_px.value_or(0.0), bound_px);
  const auto frames = static_cast<double>(row.frame_ms.size());
  row.ray_cast_share += (picture.counts.ray_cast_share - row.ray_cast_share) / frames;
  row.gpu_bytes = shared_.gpu_bytes + picture.method.gpu_bytes;
  row.heap_bytes = shared_.heap_bytes + picture.method.heap_bytes;
  row.build_ms = shared_.window_ms + session_.build_ms();
  row.params = method.params();
  return {};
}

Outcome Run::measure(const BenchView& view, ProgressBar& bar, std::vector<BenchRow>& rows) {
  rows.clear();
  for (const BenchMethod& method : methods_) rows.push_back(row_of(method, view));
  for (int k = 0; k <= options_.repeats; ++k) {
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      Outcome timed = time_frame(methods_[m], view, k > 0, rows[m]);
      if (!timed.ok()) return timed;
      bar.step(view.name + ", " + rows[m].spec);
    }
  }
  for (BenchRow& row : rows) row.removed_views = row.frame_ms.empty() ? 1 : 0;
  return judge_view(view, bar, rows);
}

Outcome Run::judge_view(const BenchView& view, ProgressBar& bar, std::vector<BenchRow>& rows) {
  // Depth jumps are those of a picture without known errors, where one can be had.
  session_.settings() = base_;
  session_.use(nullptr);
  const Picture reference = session_.draw(view.input, true);
  bool begun = !reference.range_m.empty();
  if (begun) judge_.begin_view(reference, options_.judged_pixels);
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    bar.step("judging " + view.name + ", " + rows[m].spec);
    use(methods_[m]);
    const Picture picture = session_.draw(view.input, true);
    if (!picture.problem.ok()) return picture.problem;
    if (picture.range_m.empty()) continue;
    if (!begun) judge_.begin_view(picture, options_.judged_pixels);
    begun = true;
    rows[m].error = judge_.error_of(picture);
    if (Outcome counted = count_steps(view, rows[m]); !counted.ok()) return counted;
  }
  return {};
}

Outcome Run::count_steps(const BenchView& view, BenchRow& row) {
  std::optional<StepCounts> counts;
  const Picture picture = session_.draw_counting(view.input, false, counts);
  if (!picture.problem.ok() || !counts) return picture.problem;
  const ImageGeometry& image = base_.image;
  const double share = 1.0 / (static_cast<double>(image.width_px) * image.height_px);
  row.steps.push_back({share * static_cast<double>(counts->nodes),
                       share * static_cast<double>(counts->cells),
                       share * static_cast<double>(counts->grid_nodes)});
  return {};
}

/// Opens the scene and measures what all methods share.
Outcome open_shared(const BenchOptions& options, const FrameInput& first, Session& session,
                    Shared& shared) {
  const double before_ms = now_ms();
  if (Outcome opened = session.open(options.scene, first.eye); !opened.ok()) return opened;
  session.draw(first, false);
  shared.window_ms = now_ms() - before_ms;
  shared.gpu_bytes = gl_bytes_allocated();
  shared.heap_bytes = mallinfo2().uordblks + mallinfo2().hblkhd;
  return {};
}

Outcome measure_all(const BenchOptions& options, const std::vector<BenchView>& views, bool tolerant,
                    BenchResult& result) {
  Session session;
  Shared shared;
  Outcome done = open_shared(options, views.front().input, session, shared);
  if (!done.ok()) return done;
  const std::vector<MethodSpec> specs =
      options.methods.empty() ? default_bench_methods() : options.methods;
  std::vector<BenchMethod> methods;
  done = make_bench_methods(specs, tolerant || options.methods.empty(), session, methods,
                            result.absent);
  if (!done.ok()) return done;
  result.driver = session.driver();
  result.terrain = options.scene.terrain_folder;
  result.width_px = options.scene.settings.image.width_px;
  result.height_px = options.scene.settings.image.height_px;
  Run run(options, session, std::move(methods), shared);
  ProgressBar bar(static_cast<int>(views.size()) * run.steps_a_view());
  std::vector<BenchRow> all(run.method_count()), rows;
  for (const BenchView& view : views) {
    done = run.measure(view, bar, rows);
    if (!done.ok()) return done;
    for (std::size_t m = 0; m < rows.size(); ++m) {
      if (all[m].spec.empty()) {
        all[m] = rows[m];
      } else {
        all[m].join(rows[m]);
      }
      if (!rows[m].frame_ms.empty()) result.rows.push_back(rows[m]);
    }
  }
  bar.end();
  for (BenchRow& row : all) {
    row.view = "all";
    result.rows.push_back(row);
  }
  return {};
}

}  // namespace

Outcome run_bench(const BenchOptions& options, const std::vector<BenchView>& views, bool tolerant,
                  BenchResult& result) {
  try {
    return measure_all(options, views, tolerant, result);
  } catch (const oracle::InputError& error) {
    return {Fault::file_unreadable, error.what()};
  }
}

}  // namespace ridgeline::sim
