// Scenes in which whole tiles are sky, or would be but for little ground.
#include <cmath>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry large{224, 176, 30};

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
