#include <stdlib.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "sim/bench/bench.hpp"
#include "sim/bench/bench_report.hpp"
#include "sim/bench/bench_run.hpp"
#include "sim/bench/paper_table.hpp"
#include "sim/bench/puget_map.hpp"

namespace ridgeline::sim {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
// A circle over the foothills west of Mount Rainier, in shares of the map's side. Everything within
// the range of it is on the map.
constexpr double circle_column = 640.0 / 1024, circle_row = 560.0 / 1024,
                 circle_radius = 50.0 / 1024;
constexpr double over_ground_m = 600;
constexpr double pitch_deg = -6;

/// A folder that is gone with its contents when it is no longer needed.
class TemporaryTiles {
 public:
  TemporaryTiles() {
    std::string name = (std::filesystem::temp_directory_path() / "ridgeline-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryTiles() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryTiles(const TemporaryTiles&) = delete;
  TemporaryTiles& operator=(const TemporaryTiles&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The map as a terrain folder, for as long as it lives.
struct PlacedMap {
  PugetMap map;
  TemporaryTiles tiles;

  Outcome place(const std::string& puget_file);
};

Outcome PlacedMap::place(const std::string& puget_file) {
  if (Outcome read = read_puget(puget_file, map); !read.ok()) return read;
  if (tiles.path().empty()) return failed(Fault::file_unwritable, "temporary folder");
  return write_puget_tile(map, tiles.path());
}

}  // namespace

std::vector<BenchView> puget_views(const PugetMap& map, int count) {
  std::vector<BenchView> views;
  const double side = map.posts - 1;
  for (int k = 0; k < count; ++k) {
    const double heading_deg = 360.0 * k / count;
    // Flown clockwise: the centre is to the right.
    const double turn = (heading_deg - 90.0) * rad_per_deg;
    const int column =
        static_cast<int>(std::lround(side * (circle_column + circle_radius * std::sin(turn))));
    const int row =
        static_cast<int>(std::lround(side * (circle_row - circle_radius * std::cos(turn))));
    BenchView view;
    view.name = std::to_string(static_cast<int>(std::lround(heading_deg))) + " deg";
    view.input.eye = map.at(column, row);
    view.input.eye.height_m = map.highest_m(column, row, 2) + over_ground_m;
    view.input.attitude = {0, pitch_deg, heading_deg};
    views.push_back(view);
  }
  return views;
}

Outcome bench_paper(const BenchOptions& options, const std::string& name,
                    const std::string& puget_file) {
  const Paper* const paper = find_paper(name);
  if (paper == nullptr) return {Fault::file_malformed, "no paper is called '" + name + "'"};
  PlacedMap placed;
  if (Outcome done = placed.place(puget_file); !done.ok()) return done;
  BenchOptions of_paper = options;
  of_paper.scene.terrain_folder = placed.tiles.path();
  of_paper.scene.settings.range_m = puget_range_m;
  of_paper.scene.settings.image.width_px = paper->width_px;
  of_paper.scene.settings.image.height_px = paper->height_px;
  of_paper.methods.clear();
  for (const PaperRow& row : paper->rows) {
    MethodSpec spec;
    if (Outcome parsed = parse_method(row.spec, spec); !parsed.ok()) return parsed;
    of_paper.methods.push_back(std::move(spec));
  }
  BenchResult result;
  Outcome run = run_bench(of_paper, puget_views(placed.map, options.log_views), true, result);
  if (!run.ok()) return run;
  result.terrain = puget_file;
  for (BenchRow& row : result.rows) row.terrain = puget_file;
  const std::string table = paper_markdown(*paper, result);
  std::fputs(table.c_str(), stdout);
  return write_bench_files(options, result, table);
}

Outcome bench_puget(const BenchOptions& options, const std::string& puget_file) {
  PlacedMap placed;
  if (Outcome done = placed.place(puget_file); !done.ok()) return done;
  BenchOptions over_map = options;
  over_map.scene.terrain_folder = placed.tiles.path();
  return bench_at(over_map, puget_views(placed.map, options.log_views), puget_file);
}

}  // namespace ridgeline::sim
