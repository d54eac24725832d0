// Scenes in which one ray stands for several pixels, over ground that hardly lets it.
#include <cmath>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry large{224, 176, 60};

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
                 large.width_px * large.height_px});
  all.push_back({"shared_wide", "the same, and a bound of 6 pixels", blades,
                 options_of({.image = large, .range_km = 12, .error_px = 6}), low,
                 large.width_px * large.height_px});
}

void add_other_ground_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand holes = fine("pinholes", [](double latitude_deg, double longitude_deg) {
    const bool there = lottery(latitude_deg, longitude_deg) < 0.003;
    const double hills_m = 90 * std::sin(170 * latitude_deg) * std::sin(140 * longitude_deg);
    return there ? std::nan("") : 400 + hills_m;
  });
  all.push_back({"shared_holes",
                 "gentle ground with single void posts",
                 holes,
                 options_of({.image = large, .range_km = 12, .error_px = 4}),
                 {{{46.5013, 8.5027, 540}, {0, -1, 30}}, {{46.4871, 8.5234, 560}, {10, -2, 200}}},
                 large.width_px * large.height_px});
  const DesignedLand flat = fine("level_plain", [](double, double) { return 400.0; });
  all.push_back({"shared_down",
                 "a plain from above, rolled: pixels far over or under their ray",
                 flat,
                 options_of({.image = large, .range_km = 12, .error_px = 4}),
                 {{{46.5013, 8.5027, 700}, {20, -50, 30}}, {{46.5013, 8.5027, 700}, {14, -14, 30}}},
                 large.width_px * large.height_px});
}

}  // namespace

void add_shared_scenes(std::vector<DesignedScene>& all) {
  add_steep_scenes(all);
  add_other_ground_scenes(all);
}

}  // namespace ridgeline::test
