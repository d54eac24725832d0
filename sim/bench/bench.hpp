#pragma once
#include <string>
#include <vector>

#include "sim/session/session.hpp"

namespace ridgeline::sim {

struct BenchOptions {
  SceneOptions scene;
  std::vector<MethodSpec> methods;                 ///< empty: default_bench_methods()
  std::string log_file;                            ///< views from a flight; empty: fixed views
  int log_views = 8;                               ///< so many, spaced over the flight
  std::string json_file, markdown_file, svg_file;  ///< empty: not written
  int repeats = 7;          ///< frames a view and method, after one that is not counted
  int judged_pixels = 400;  ///< a view and method, judged by the oracle
};

/// One place to measure at.
struct BenchView {
  std::string name;
  FrameInput input;
};

/// The published methods and ours with settings that span their range, as `--methods` takes them.
[[nodiscard]] std::vector<MethodSpec> default_bench_methods();

/// Fixed views of a terrain folder: grazing low, valley, high, steep down, banked, wide horizon.
/// The valley is the lowest ground near the middle of the middle tile, the rest stands over that
/// middle. Empty when the folder holds no known post there.
std::vector<BenchView> fixed_views(const std::string& terrain_folder);

/// Evenly spaced moments of a recorded flight at which terrain can be drawn.
std::vector<BenchView> log_views(const std::string& log_file, const BusProfile& profile, int count);

/// Measures every method at every view, the methods interleaved frame by frame so that noise hits
/// all alike, and judges each with the oracle. Prints a Markdown table; writes the files asked for.
/// Outcome: the message names the file (or the method) and what is wrong with it.
Outcome bench(const BenchOptions& options);

/// The grids, settings and picture size of a paper over the height map of Puget Sound, its
/// published figures beside ours. Views: `log_views` of a circle of 8 km over the foothills west of
/// Mount Rainier, 600 m over the ground, 6 degrees down, display range 50 km. Outcome: the message
/// names the file or the word and what is wrong with it.
Outcome bench_paper(const BenchOptions& options, const std::string& paper,
                    const std::string& puget_file);

/// The same as bench() over that map and from those views.
Outcome bench_puget(const BenchOptions& options, const std::string& puget_file);

/// Display range of those views: everything within it is on the map. m
inline constexpr double puget_range_m = 50'000;

/// Measures at the views, prints the table and writes the files asked for. `terrain`: its name in
/// the report.
Outcome bench_at(const BenchOptions& options, const std::vector<BenchView>& views,
                 const std::string& terrain);

/// Frame times of a recorded flight against a deadline, each of `log_views` frames drawn with the
/// frame-budget monitor and without. Prints tables; writes `json_file` where it is asked for.
Outcome bench_monitor(const BenchOptions& options, double deadline_ms);

struct PugetMap;
/// Its views.
[[nodiscard]] std::vector<BenchView> puget_views(const PugetMap& map, int count);

}  // namespace ridgeline::sim
