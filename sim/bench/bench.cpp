#include "sim/bench/bench.hpp"

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "sim/bench/bench_judge.hpp"
#include "sim/output/atomic_file.hpp"
#include "sim/output/percentile.hpp"
#include "tests/oracle/input_error.hpp"

namespace ridgeline::sim {
namespace {

struct Method {
  std::string name, params;
  FrameSettings settings;
};

/// What was measured of one method, at one view or over all.
struct Measured {
  std::vector<double> frame_ms, core_ms, gpu_ms;
  std::vector<BenchError> errors;
  double bound_px = 0, share = 0;
  int shares = 0;
};

double process_cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

std::vector<Method> methods_of(const FrameSettings& base) {
  std::vector<Method> methods;
  Method plain{"raycast", "max pyramid, every pixel from the eye", base};
  plain.settings.cast_every_pixel = true;
  methods.push_back({"ridgeline",
                     "grid " + std::to_string(base.node_spacing.planes_px).substr(0, 3) + " x " +
                         std::to_string(base.node_spacing.rows_px).substr(0, 3) + " px",
                     base});
  methods.push_back(plain);
  return methods;
}

void measure(Session& session, const Method& method, const FrameInput& input, bool counted,
             Measured& measured) {
  session.settings() = method.settings;
  const double before_ms = process_cpu_ms();
  const Picture picture = session.draw(input, false);
  if (!counted) return;
  measured.core_ms.push_back(process_cpu_ms() - before_ms);
  measured.frame_ms.push_back(picture.cpu_ms);
  const auto& ms = picture.counts.pass_ms;
  measured.gpu_ms.push_back(std::accumulate(ms.begin(), ms.end(), 0.0));
  measured.bound_px = std::max(measured.bound_px, picture.report.bound_px);
  measured.share += picture.counts.ray_cast_share;
  ++measured.shares;
}

nlohmann::ordered_json row_json(const BenchOptions& options, const Method& method,
                                const std::string& view, const Measured& m) {
  BenchError worst;
  double means = 0;
  for (const BenchError& e : m.errors) {
    worst.max_px = std::max(worst.max_px, e.max_px);
    worst.p99_px = std::max(worst.p99_px, e.p99_px);
    worst.percent_over_1px += e.percent_over_1px / static_cast<double>(m.errors.size());
    worst.wrong_class_pixels += e.wrong_class_pixels;
    means += e.mean_px / static_cast<double>(m.errors.size());
  }
  nlohmann::ordered_json row;
  row["method"] = method.name;
  row["params"] = method.params;
  row["terrain"] = options.scene.terrain_folder;
  row["view"] = view;
  row["epsilon_px"] = method.settings.error_px;
  row["bound_px"] = m.bound_px;
  row["frame_ms_median"] = percentile(m.frame_ms, 0.5);
  row["frame_ms_p99"] = percentile(m.frame_ms, 0.99);
  row["frame_ms_max"] = percentile(m.frame_ms, 1.0);
  row["core_ms"] = percentile(m.core_ms, 0.5);
  const double gpu_ms = percentile(m.gpu_ms, 0.5);
  row["gpu_ms"] = gpu_ms > 0 ? nlohmann::ordered_json(gpu_ms) : nlohmann::ordered_json(nullptr);
  row["error_px_max"] = worst.max_px;
  row["error_px_mean"] = means;
  row["error_px_p99"] = worst.p99_px;
  row["percent_over_1px"] = worst.percent_over_1px;
  row["wrong_class_pixels"] = worst.wrong_class_pixels;
  row["ray_cast_share"] = m.shares > 0 ? m.share / m.shares : 0.0;
  row["steps_per_pixel"] = nullptr;  // not counted by this renderer
  row["gpu_bytes"] = gl_bytes_allocated();
  row["heap_bytes"] = mallinfo2().uordblks + mallinfo2().hblkhd;
  return row;
}

void append(Measured& all, const Measured& one) {
  all.frame_ms.insert(all.frame_ms.end(), one.frame_ms.begin(), one.frame_ms.end());
  all.core_ms.insert(all.core_ms.end(), one.core_ms.begin(), one.core_ms.end());
  all.gpu_ms.insert(all.gpu_ms.end(), one.gpu_ms.begin(), one.gpu_ms.end());
  all.errors.insert(all.errors.end(), one.errors.begin(), one.errors.end());
  all.bound_px = std::max(all.bound_px, one.bound_px);
  all.share += one.share;
  all.shares += one.shares;
}

void print_table(const nlohmann::ordered_json& rows) {
  std::printf(
      "| view | method | median ms | p99 ms | core ms | error max px | error mean px | "
      "wrong class | raycast / this |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& row : rows) {
    double plain_ms = 0;
    for (const auto& other : rows) {
      if (other["view"] == row["view"] && other["method"] == "raycast") {
        plain_ms = other["frame_ms_median"];
      }
    }
    const double ms = row["frame_ms_median"];
    std::printf("| %s | %s | %.1f | %.1f | %.1f | %.3f | %.4f | %d | %.2f |\n",
                row["view"].get<std::string>().c_str(), row["method"].get<std::string>().c_str(),
                ms, row["frame_ms_p99"].get<double>(), row["core_ms"].get<double>(),
                row["error_px_max"].get<double>(), row["error_px_mean"].get<double>(),
                row["wrong_class_pixels"].get<int>(), ms > 0 ? plain_ms / ms : 0.0);
  }
}

/// One view, every method in turn, `repeats` times after a frame each that is not counted.
std::vector<Measured> measure_view(Session& session, const std::vector<Method>& methods,
                                   const BenchView& view, const BenchJudge& judge,
                                   const BenchOptions& options) {
  std::vector<Measured> measured(methods.size());
  for (int k = 0; k <= options.repeats; ++k) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      measure(session, methods[m], view.input, k > 0, measured[m]);
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    session.settings() = methods[m].settings;
    const Picture picture = session.draw(view.input, true);
    if (picture.range_m.empty()) continue;
    measured[m].errors.push_back(judge.error_of(picture, options.judged_pixels));
  }
  return measured;
}

Outcome run(const BenchOptions& options, const std::vector<BenchView>& views) {
  Session session;
  const double before_ms = process_cpu_ms();
  if (Outcome opened = session.open(options.scene, views.front().input.eye); !opened.ok()) {
    return opened;
  }
  session.draw(views.front().input, false);
  const double build_ms = process_cpu_ms() - before_ms;
  const BenchJudge judge(options.scene);
  const std::vector<Method> methods = methods_of(options.scene.settings);
  std::vector<Measured> all(methods.size());
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::fprintf(stderr, "\rview %zu of %zu", v + 1, views.size());
    const auto measured = measure_view(session, methods, views[v], judge, options);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (measured[m].errors.empty()) continue;  // removed: nothing was drawn
      append(all[m], measured[m]);
      rows.push_back(row_json(options, methods[m], views[v].name, measured[m]));
    }
  }
  std::fprintf(stderr, "\n");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    rows.push_back(row_json(options, methods[m], "all", all[m]));
  }
  for (auto& row : rows) row["build_ms"] = build_ms;
  std::printf("%s, %d x %d, error bound %.2f px\n\n", session.driver(),
              options.scene.settings.image.width_px, options.scene.settings.image.height_px,
              options.scene.settings.error_px);
  print_table(rows);
  if (options.json_file.empty()) return {};
  const nlohmann::ordered_json json{{"rows", rows}};
  return write_file(options.json_file, json.dump(1) + "\n");
}

}  // namespace

Outcome bench(const BenchOptions& options) {
  BusProfile profile;
  profile.header_rule = HeaderRule::field;
  profile.heading_reference = HeadingReference::true_north;
  constexpr int views_of_log = 8;
  const std::vector<BenchView> views = options.log_file.empty()
                                           ? fixed_views(options.scene.terrain_folder)
                                           : log_views(options.log_file, profile, views_of_log);
  if (views.empty()) {
    const std::string& file =
        options.log_file.empty() ? options.scene.terrain_folder : options.log_file;
    return {Fault::file_malformed, file + ": holds no view to measure at"};
  }
  try {
    return run(options, views);
  } catch (const oracle::InputError& error) {
    return {Fault::file_unreadable, error.what()};
  }
}

}  // namespace ridgeline::sim
