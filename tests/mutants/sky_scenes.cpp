// Scenes in which whole tiles are sky, or would be but for little ground.
#include <cmath>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry large{224, 176, 30};

bool seldom(double latitude_deg, double longitude_deg) {
  return lottery(latitude_deg, longitude_deg) < 0.006;
}

}  // namespace

void add_sky_scenes(std::vector<DesignedScene>& all) {
  // In each block of 64 posts a tower of one post in the north-east, a pit in the south-west, so
  // that the middle of the block's heights is far below the tower.
  const DesignedLand towers = fine("towers", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    const bool tower = at.row % 64 == 60 && at.column % 64 == 60;
    const bool pit = at.row % 64 == 20 && at.column % 64 == 20;
    return tower ? 1700.0 : (pit ? -1500.0 : 400.0);
  });
  all.push_back({"sky_towers",
                 "towers of one post before the sky",
                 towers,
                 options_of({.image = large, .range_km = 20, .error_px = 1}),
                 {{{46.4013, 8.5027, 900}, {0, 3, 20}},
                  {{46.4513, 8.4527, 700}, {30, 2, 110}},
                  {{46.5513, 8.5427, 1200}, {-10, 1, 250}}},
                 large.width_px * large.height_px});
  // So far away that the parts of a block are looked at by fours.
  const DesignedLand high_towers =
      fine("high_towers", [](double latitude_deg, double longitude_deg) {
        const FinePost at = fine_post(latitude_deg, longitude_deg);
        return at.row % 64 > 56 && at.column % 64 > 56 ? 6000.0 : 400.0;
      });
  all.push_back({"sky_far_towers",
                 "higher towers, farther away",
                 high_towers,
                 options_of({.image = {224, 176, 60}, .range_km = 30, .error_px = 1}),
                 {{{46.4013, 8.5027, 900}, {0, 8, 10}}, {{46.6513, 8.5527, 700}, {30, 7, 200}}},
                 224 * 176});
  // Posts far apart make blocks of 59 km, and at 100 km the Earth has bent by a degree.
  const DesignedLand spikes =
      coarse("sky_spikes", {45, 48, 8, 11}, [](double latitude_deg, double longitude_deg) {
        return seldom(latitude_deg, longitude_deg) ? 3500.0 : 0.0;
      });
  all.push_back({"sky_spikes",
                 "spikes 60 to 170 km away, on blocks that the Earth has turned away",
                 spikes,
                 options_of({.image = {1024, 160, 10}, .range_km = 170, .error_px = 0.6}),
                 {{{45.30, 9.50, 3000}, {0, -0.6, 0}},
                  {{45.25, 9.21, 3500}, {0, -0.7, 5}},
                  {{45.36, 9.71, 4000}, {0, -0.9, -6}},
                  {{45.21, 9.35, 3200}, {0, -0.7, 10}}},
                 20'000});
  const DesignedLand plain = fine("small_tile_plain", [](double, double) { return 400.0; });
  // A border of 3 pixels, two tiles of 32 and one of 3: as large as a block.
  all.push_back({"sky_small_tile",
                 "ground in a tile as small as a block",
                 plain,
                 options_of({.image = {73, 73, 60}, .range_km = 12, .error_px = 1.6}),
                 {{{46.5013, 8.5027, 700}, {0, -30, 30}}},
                 73 * 73});
  // More records than one row of their list holds.
  all.push_back({"sky_many_tiles",
                 "a picture of many tiles",
                 plain,
                 options_of({.image = {1024, 768, 60}, .range_km = 12, .error_px = 1.6}),
                 {{{46.5013, 8.5027, 700}, {5, -10, 30}}},
                 20'000});
}

}  // namespace ridgeline::test
