#include <cmath>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {

void add_polar_scenes(std::vector<DesignedScene>& all) {
  const auto hills = [](double latitude_deg, double longitude_deg) {
    constexpr double deg = 0.017453292519943295;
    const double p = (90 - latitude_deg) * 111.7;
    const double x = p * std::sin(longitude_deg * deg), y = p * std::cos(longitude_deg * deg);
    return 600 + 220 * std::sin(x / 2.3) * std::cos(y / 3.1) + 120 * std::sin((x + 2 * y) / 5.7);
  };
  const CellRange cap{89, 90, -180, 180};
  const DesignedLand smooth = coarse("cap", cap, hills);
  // The oracle takes milliseconds for a ray near the pole: fewer pixels.
  all.push_back({"polar",
                 "hills round the pole",
                 smooth,
                 options_of({.range_km = 30}),
                 {{{90, 0, 3500}, {0, -5, 0}},
                  {{89.95, 30, 1500}, {0, -3, 90}},
                  {{89.9, -130, 3500}, {20, -12, 200}}},
                 200});
  all.push_back({"polar_steep",
                 "hills round the pole from above",
                 smooth,
                 options_of({.range_km = 30}),
                 {{{89.9, 30, 3500}, {0, -30, 90}}, {{89.85, 30, 3500}, {0, -35, 180}}},
                 300,
                 1});
  const DesignedLand rough =
      coarse("rough_cap", cap, [=](double latitude_deg, double longitude_deg) {
        return hills(latitude_deg, longitude_deg) + 60 * lottery(latitude_deg, longitude_deg);
      });
  all.push_back({"polar_rough",
                 "rough ground in a polar chart",
                 rough,
                 options_of({.range_km = 30}),
                 {{{89.75, 60, 4000}, {0, -6, 180}}, {{89.7, 150, 2500}, {0, -3, 120}}},
                 1000});
  const DesignedLand gap{"gap_cap", [=](const std::string& folder) {
                           write_coarse_cells(folder, {89, 90, -180, 30}, hills);
                           write_coarse_cells(folder, {89, 90, 31, 180}, hills);
                         }};
  all.push_back({"polar_gap",
                 "a missing tile near the pole",
                 gap,
                 options_of({.range_km = 30}),
                 {{{89.8926, -150, 3500}, {0, -4, 0}}, {{89.776, 100, 3500}, {0, -4, 330}}},
                 400});
}

}  // namespace ridgeline::test
