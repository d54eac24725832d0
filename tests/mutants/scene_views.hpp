#pragma once
#include <cmath>
#include <vector>

#include "tests/mutants/lands.hpp"
#include "tests/mutants/scenes.hpp"

namespace ridgeline::test {

inline constexpr double mebibyte = 1024.0 * 1024.0;

inline DesignedLand coarse(std::string_view name, const CellRange& cells,
                           sim::HeightFunction height_m) {
  return {name, [=](const std::string& folder) { write_coarse_cells(folder, cells, height_m); }};
}

inline DesignedLand fine(std::string_view name, sim::HeightFunction height_m) {
  return {name, [=](const std::string& folder) { write_fine_cell(folder, 46, 8, height_m); }};
}

/// Row and column of a 3" post, from 46 north 8 east.
struct FinePost {
  long long row, column;
};

inline FinePost fine_post(double latitude_deg, double longitude_deg) {
  return {std::llround((latitude_deg - 46) * 1200), std::llround((longitude_deg - 8) * 1200)};
}

struct View {
  ImageGeometry image{96, 72, 60};
  double range_km = 40;
  double error_px = 0.3;
  double gpu_mebibytes = 96;
  GridSpacing spacing{3.0, 1.5};
  sim::SceneOptions::Arrival arrival = sim::SceneOptions::Arrival::settled;
};

inline sim::SceneOptions options_of(const View& view) {
  sim::SceneOptions options;
  options.settings.image = view.image;
  options.settings.error_px = view.error_px;
  options.settings.range_m = 1000 * view.range_km;
  options.settings.node_spacing = view.spacing;
  options.terrain_gpu_bytes = view.gpu_mebibytes * mebibyte;
  options.arrival = view.arrival;
  return options;
}

/// As many pixels a radian as there can be: 0.3 px are 1.3e-5 rad. Rolled by 90 degrees it is a
/// profile from 5 degrees under the middle to 5 over it.
inline constexpr ImageGeometry strip{4096, 16, 10};

inline constexpr CellRange alps{45, 47, 8, 10};
/// Planes so far apart that wedges outgrow the overlap of nodes within the range.
inline constexpr GridSpacing wide_wedges{12.0, 0.1};
inline constexpr GridSpacing all_round{60.0, 1.0};
/// Rows so close that the row below a pixel is hardly lower than it.
inline constexpr GridSpacing fine_rows{3.0, 0.1};

/// Scenes whose picture has several levels of the window.
void add_level_scenes(std::vector<DesignedScene>& all);
/// Scenes in which pixels share rays.
void add_shared_scenes(std::vector<DesignedScene>& all);
/// Scenes in which whole tiles are sky, or nearly.
void add_sky_scenes(std::vector<DesignedScene>& all);
/// Scenes round a pole.
void add_polar_scenes(std::vector<DesignedScene>& all);
/// Scenes whose true error is a large share of the bound.
void add_sharp_scenes(std::vector<DesignedScene>& all);

}  // namespace ridgeline::test
