// Scenes in which one ray stands for several pixels, over ground that hardly lets it.
#include <algorithm>
#include <cmath>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry large{224, 176, 60};
constexpr ImageGeometry narrow{224, 176, 12};
constexpr int every_pixel = large.width_px * large.height_px;

/// What one step between columns of 3" posts is long at 46.5 degrees north.
constexpr double column_m = 63.9;

/// Combs across the way north: bands of teeth one column wide whose flanks have one slope and no
/// other, since they rise and fall slowly along the way. Seen end on they are rows of triangles.
DesignedLand combs(std::string_view name, double slope) {
  return fine(name, [=](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    const auto along = static_cast<double>(at.row % 40);
    const double there = std::clamp(std::min(along, 24 - along) / 10, 0.0, 1.0);
    return 400 + (at.column % 2 == 1 ? slope * column_m * there : 0.0);
  });
}

void add_steep_scenes(std::vector<DesignedScene>& all) {
  const std::vector<ScenePose> low{{{46.5013, 8.5027, 520}, {0, -1, 30}},
                                   {{46.4771, 8.5034, 560}, {45, -2, 100}},
                                   {{46.5013, 8.4527, 540}, {20, -1, 200}},
                                   {{46.5213, 8.4927, 620}, {90, -5, 260}}};
  const DesignedLand blades = fine("blades", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    const bool there = at.row % 12 == 5 && lottery(latitude_deg, longitude_deg) < 0.3;
    return 400 + (there ? 150 + 150 * lottery(longitude_deg, latitude_deg) : 0.0);
  });
  all.push_back({"shared_blades", "spires and gaps of a pixel, where steepness allows no sharing",
                 blades, options_of({.image = large, .range_km = 12, .error_px = 2}), low,
                 every_pixel});
  const DesignedLand steep_combs = combs("combs", 3.5);
  // Level and at 1 px a pair of pixels one over the other bears any slope, four pixels bear 1.
  all.push_back({"shared_combs",
                 "slopes of 3.5 seen end on",
                 steep_combs,
                 options_of({.image = narrow, .range_km = 35, .error_px = 1}),
                 {{{46.3013, 8.5027, 1500}, {0, -1.5, 0}}, {{46.3113, 8.4947, 1900}, {0, -2, 0}}},
                 every_pixel});
  // Rolled by 20 to 38 degrees a pair bears 1 to 2, and its rays leave out what is steeper than 1.7
  // to 2.7.
  all.push_back({"shared_combs_rolled",
                 "the same, rolled",
                 steep_combs,
                 options_of({.image = narrow, .range_km = 35, .error_px = 1}),
                 {{{46.3013, 8.5027, 1500}, {25, -1.5, 0}},
                  {{46.3113, 8.4947, 1700}, {32, -1.8, 0}},
                  {{46.3113, 8.4987, 1900}, {-35, -2, 0}}},
                 every_pixel});
  // 36 pixels at 26 degrees of roll would bear 0.98 if blocks went on in step in the next tile.
  // They begin anew there, after 32 pixels, and bear 0.65.
  all.push_back({"shared_combs_across",
                 "slopes of 0.8 seen end on, across the borders of tiles",
                 combs("low_combs", 0.8),
                 options_of({.image = {320, 256, 10}, .range_km = 35, .error_px = 3.6}),
                 {{{46.3013, 8.5027, 1300}, {26, -2, 0}},
                  {{46.3113, 8.4947, 1500}, {25, -2.5, 0}},
                  {{46.3113, 8.4987, 1700}, {-26, -3, 0}},
                  {{46.3213, 8.5107, 1400}, {26, -2.3, 0}},
                  {{46.3313, 8.4907, 1600}, {26, -2.8, 0}},
                  {{46.2913, 8.5207, 1800}, {-26, -2.9, 0}}},
                 320 * 256});
}

void add_other_ground_scenes(std::vector<DesignedScene>& all) {
  // Roads of known ground, one cell wide, that lead away from the eye over unknown ground: the
  // rays beside one pass over the void and meet nothing before its far shore.
  const DesignedLand roads = fine("roads", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    const bool gap = at.row >= 620 && at.row < 680 && at.column % 6 > 1;
    return gap ? std::nan("") : 400.0;
  });
  all.push_back({"shared_roads",
                 "roads of known ground through unknown ground",
                 roads,
                 options_of({.image = {224, 176, 20}, .range_km = 25, .error_px = 4}),
                 {{{46.4013, 8.50055, 1900}, {0, -6, 0}}, {{46.4013, 8.4977, 2300}, {0, -8, 0}}},
                 every_pixel});
  const DesignedLand flat = fine("level_plain", [](double, double) { return 400.0; });
  all.push_back({"shared_diagonal",
                 "a plain in a rolled picture: distance changes most along the diagonal of a block",
                 flat,
                 options_of({.image = {224, 176, 20}, .range_km = 12, .error_px = 1.6}),
                 {{{46.5013, 8.5027, 700}, {20, -4, 30}}, {{46.5013, 8.5027, 700}, {-15, -8, 30}}},
                 every_pixel});
  const DesignedLand rough = fine("shared_rough", [](double latitude_deg, double longitude_deg) {
    return 400 + 60 * lottery(latitude_deg, longitude_deg);
  });
  all.push_back({"shared_from_above",
                 "small hills from so far above that their tops are nearest",
                 rough,
                 options_of({.image = {224, 176, 12}, .range_km = 20, .error_px = 1.6}),
                 {{{46.5013, 8.5027, 7000}, {0, -68, 0}}, {{46.5013, 8.5027, 7000}, {0, -62, 0}}},
                 every_pixel});
}

}  // namespace

void add_shared_scenes(std::vector<DesignedScene>& all) {
  add_steep_scenes(all);
  add_other_ground_scenes(all);
}

}  // namespace ridgeline::test
