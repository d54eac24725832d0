// Scenes whose true error is a large share of the bound: what breaks only a part of it shows.
#include <algorithm>
#include <cmath>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

/// As little as a strip can be asked to promise: 5.5e-6 rad.
constexpr double least_strip_px = 0.131;

/// A plain of pyramids, one post wide and up to 800 m high: slopes of about 1 at half a minute.
double pyramids_m(double latitude_deg, double longitude_deg) {
  const bool there = lottery(latitude_deg, longitude_deg) > 0.8;
  return 100 + (there ? 200 + 600 * lottery(longitude_deg, latitude_deg) : 0.0);
}

void add_arithmetic_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand pyramids = coarse("pyramids", {45, 47, 8, 10}, pyramids_m);
  all.push_back({"facets",
                 "slopes of about 1 in cells of half a minute, and the least bound",
                 pyramids,
                 options_of({.image = strip, .range_km = 40, .error_px = least_strip_px}),
                 {{{46.0131, 9.0272, 1200}, {0, -0.9, 30}},
                  {{46.0131, 9.0272, 900}, {90, -4, 200}},
                  {{46.0131, 9.0272, 3000}, {0, -8, 300}}}});
  const DesignedLand saddles =
      coarse("saddles", {82, 84, 8, 10}, [](double latitude_deg, double longitude_deg) {
        const auto odd = std::llround(latitude_deg * 120) + std::llround(longitude_deg * 20);
        return odd % 2 == 0 ? 100.0 : 350.0;
      });
  all.push_back({"saddles",
                 "near cells, where parallels bend most",
                 saddles,
                 options_of({.image = strip, .range_km = 10, .error_px = least_strip_px}),
                 {{{83 + 0.1 / 120, 9 + 0.1 / 20, 400}, {90, -8, 40}},
                  {{83 + 0.1 / 120, 9 + 0.1 / 20, 400}, {0, -4, 45}},
                  {{83 + 0.9 / 120, 9 + 0.1 / 20, 400}, {90, -6, 140}}}});
  const DesignedLand flat = coarse("flat", {44, 48, 6, 13}, sea_m);
  all.push_back(
      {"long_view",
       "200 km of level ground from 20 km",
       flat,
       options_of({.image = strip, .range_km = 200, .error_px = least_strip_px}),
       {{{46.0131, 9.3, 20'000}, {90, -8, 60}}, {{46.0131, 9.3, 20'000}, {0, -6.7, 330}}}});
  // Columns are 190 to 270 m wide here: slopes of about 1.
  const DesignedLand gentle =
      coarse("gentle_pole", {87, 89, -15, 15}, [](double latitude_deg, double longitude_deg) {
        return 200 * lottery(latitude_deg, longitude_deg);
      });
  all.push_back({"gentle_pole",
                 "five ranges from the pole: the ground map at its worst",
                 gentle,
                 options_of({.image = strip, .range_km = 50, .error_px = least_strip_px}),
                 {{{87.6, 0.02, 1000}, {0, -1.29, 15}},
                  {{87.6, 0.02, 1000}, {0, -1.29, 165}},
                  {{87.6, 0.02, 600}, {0, -0.81, 195}}}});
}

void add_wedge_scenes(std::vector<DesignedScene>& all) {
  // With the nadir beside the picture the grid closes, and its wedges are a 64th of a circle:
  // after a kilometre they outgrow the overlap of the finest nodes, and the sweep goes on for
  // eight with coarser ones. The finest level, and all spires in it, reach as far.
  const auto points = [](double latitude_deg, double longitude_deg) {
    const auto rows = std::abs(std::llround((latitude_deg - 46) * 1200) - 600);
    const auto columns = std::abs(std::llround((longitude_deg - 8) * 1200) - 600);
    const bool there = rows < 90 && columns < 130;
    return 400 + (there && lottery(latitude_deg, longitude_deg) < 0.01 ? 300.0 : 0.0);
  };
  all.push_back(
      {"wide_wedges",
       "wedges wider than the nodes of the finest level, in the finest level",
       fine("far_points", points),
       options_of(
           {.image = {192, 128, 60}, .range_km = 30, .gpu_mebibytes = 3, .spacing = {150.0, 1.0}}),
       {{{46.5, 8.5, 1600}, {0, -22, 0}},
        {{46.5, 8.5, 1300}, {0, -22, 100}},
        {{46.5, 8.5, 1600}, {0, -22, 220}}}});
}

void add_cell_scenes(std::vector<DesignedScene>& all) {
  // Hardly lower than the eye, so that the tops stand in one row of pixels.
  const DesignedLand peaks{"peaks", [](const std::string& folder) {
                             const auto height_m = [](double latitude_deg, double longitude_deg) {
                               const auto row = std::llround((latitude_deg - 46) * 3600) - 1800;
                               const auto column = std::llround((longitude_deg - 8) * 3600) - 1800;
                               const auto away = std::max(std::abs(row), std::abs(column));
                               const bool there =
                                   row % 2 == 0 && column % 2 == 0 && away > 9 && away < 44;
                               return 100 + (there ? 18.0 : 0.0);
                             };
                             if (!sim::write_tile_with(folder, 46, 8, 3601, height_m).ok())
                               std::abort();
                           }};
  all.push_back({"peaks",
                 "tops of pyramids, one pixel wide each",
                 peaks,
                 options_of({.image = strip, .range_km = 2, .error_px = least_strip_px}),
                 {{{46.500243742, 8.500204809, 118.1}, {0, -0.02, 110}},
                  {{46.500345230, 8.500269621, 118.1}, {0, -0.02, 100}},
                  {{46.500345230, 8.500269621, 118.1}, {0, -0.02, 280}},
                  {{46.500391472, 8.500387286, 118.1}, {0, -0.02, 70}},
                  {{46.500209416, 8.500243939, 118.1}, {0, -0.02, 300}},
                  {{46.500303870, 8.500344508, 118.1}, {0, -0.02, 290}},
                  {{46.500383220, 8.500407050, 118.1}, {0, -0.02, 250}},
                  {{46.500338862, 8.500309448, 118.1}, {0, -0.02, 300}},
                  {{46.500410634, 8.500287337, 118.1}, {0, -0.02, 70}},
                  {{46.500378537, 8.500340719, 118.1}, {0, -0.02, 280}},
                  {{46.500210472, 8.500302973, 118.1}, {0, -0.02, 60}},
                  {{46.500366276, 8.500409735, 118.1}, {0, -0.02, 120}}},
                 2000});
  // Voids in the last two rows before a cliff whose back falls away; their floor is that of the
  // low ground before them.
  const DesignedLand cliff =
      coarse("cliff", {45, 47, 8, 10}, [](double latitude_deg, double /*longitude_deg*/) {
        const auto row = std::llround((latitude_deg - 45) * 120);
        if (row >= 166 && row < 168) return std::nan("");
        return row >= 168 ? std::max(0.0, 900.0 - 300.0 * static_cast<double>(row - 168)) : 100.0;
      });
  all.push_back({"cliff",
                 "a cliff at the border of unknown ground, falling away behind",
                 cliff,
                 options_of({.image = {96, 64, 20}}),
                 {{{46.1, 9.0, 700}, {0, 0, 0}}, {{46.2, 9.0, 500}, {0, 1, 20}}}});
}

void add_scale_scenes(std::vector<DesignedScene>& all) {
  // What rounds a height is the largest part of the bound here, and half of it is met: 25.30029 m
  // over a whole number above 8192 m is as far from any float as can be. The crest stands 28 m from
  // an eye of its own height, at the end of a profile that looks up; the ground falls away on both
  // sides, so that no cell is near enough to be drawn about the eye.
  constexpr double crest_m = 8925.30029;
  const DesignedLand crest{
      "rounded_crest", [](const std::string& folder) {
        const auto height_m = [](double /*latitude_deg*/, double longitude_deg) {
          const auto away = std::abs(std::llround((longitude_deg - 8) * 3600) - 1800);
          return 8900 - 15.0 * static_cast<double>(std::min(away, 60LL));
        };
        if (!sim::write_tile_with(folder, 60, 8, 3601, height_m).ok()) std::abort();
        write_geoid(folder + "/geoid.gtx", {55, 65, 0, 20}, crest_m - 8900, 0);
      }};
  sim::SceneOptions options =
      options_of({.image = {2048, 96, 120}, .range_km = 5, .error_px = 0.016});
  options.geoid = "geoid.gtx";
  all.push_back({"crest_corner",
                 "a rounded crest at the edge of 120 degrees",
                 crest,
                 options,
                 {{{60.5, 8.499479371, crest_m + 0.052}, {88.454, 59.127, 90}},
                  {{60.5, 8.499499635, crest_m + 0.005}, {-88.445, 59.112, 90}},
                  {{60.5, 8.499496173, crest_m + 0.033}, {-88.033, 58.453, 90}},
                  {{60.5, 8.499493443, crest_m + 0.050}, {-88.232, 58.771, 90}},
                  {{60.5, 8.499476275, crest_m + 0.015}, {88.098, 58.557, 90}},
                  {{60.5, 8.499480328, crest_m + 0.029}, {-88.196, 58.714, 90}},
                  {{60.5, 8.499484380, crest_m + 0.044}, {88.294, 58.871, 90}},
                  {{60.5, 8.499488433, crest_m + 0.059}, {-88.392, 59.028, 90}},
                  {{60.5, 8.499499043, crest_m + 0.023}, {88.258, 58.813, 90}},
                  {{60.5, 8.499481876, crest_m + 0.048}, {-88.124, 58.599, 90}},
                  {{60.5, 8.499492486, crest_m + 0.013}, {88.490, 59.185, 90}},
                  {{60.5, 8.499485928, crest_m + 0.003}, {88.222, 58.756, 90}}},
                 14'000});
}

void add_slant_scenes(std::vector<DesignedScene>& all) {
  const auto over = [&](const DesignedLand& land, std::string_view name, std::string_view shows,
                        const View& view, std::vector<ScenePose> poses) {
    all.push_back({name, shows, land, options_of(view), poses});
  };
  const DesignedLand crest = fine("corner_crest", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    return 500 + (at.row == 771 && std::abs(at.column - 624) < 12 ? 65.0 : 0.0);
  });
  over(crest, "levels_corner", "a crest of a pixel at the edge of 120 degrees",
       {.image = {530, 64, 120}, .range_km = 30, .error_px = 0.1, .gpu_mebibytes = 3},
       {{{46.5, 8.5, 700}, {0, 0, 310}},
        {{46.5, 8.5, 700}, {0, 0.11, 310}},
        {{46.5, 8.5, 700}, {0, 0.23, 309}},
        {{46.5, 8.5, 690}, {0, 0.05, 61}}});
  // Hillsides that face the eye, on which every other column stands higher: coarse levels draw
  // the middle.
  const auto teeth = [](long long columns, double rise_m, double tooth_m) {
    return [=](double latitude_deg, double longitude_deg) {
      const FinePost at = fine_post(latitude_deg, longitude_deg);
      const auto up = std::clamp(at.column - 640, 0LL, columns);
      const bool rough = up > 8 && up < columns - 8 && std::abs(at.row - 600) < 40;
      return 500 + rise_m * static_cast<double>(up) + (rough && at.column % 2 == 1 ? tooth_m : 0.0);
    };
  };
  over(fine("teeth", teeth(64, 20, 10)), "levels_slanted",
       "a hillside of coarse ground, from above",
       {.image = {192, 48, 10}, .range_km = 15, .error_px = 0.1, .gpu_mebibytes = 1},
       {{{46.5, 8.5, 6000}, {0, -48, 90}},
        {{46.5, 8.5, 6000}, {0, -46, 90}},
        {{46.5, 8.5, 6000}, {2, -47, 89}}});
  over(fine("steep_teeth", teeth(32, 48, 6)), "levels_steep", "a steep one",
       {.image = {192, 48, 10}, .range_km = 15, .error_px = 0.1, .gpu_mebibytes = 1},
       {{{46.5, 8.5, 4000}, {0, -36, 90}},
        {{46.5, 8.5, 4000}, {0, -33, 90}},
        {{46.5, 8.5, 3500}, {0, -30, 90}}});
  // Through notches less than a pixel wide one sees coarse ground, and that pixel alone does.
  const DesignedLand notches = fine("notches", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    if (at.row == 640 && std::abs(at.column - 600) < 60) return at.column % 2 == 0 ? 700.0 : 580.0;
    return 400 + (at.row > 720 ? 8 * lottery(latitude_deg, longitude_deg) : 0.0);
  });
  over(notches, "levels_notched", "coarse ground through notches of a pixel, at 45 degrees of roll",
       {.image = {192, 96, 60}, .range_km = 30, .error_px = 0.1, .gpu_mebibytes = 3},
       {{{46.5, 8.5, 650}, {45, -1, 0}},
        {{46.5, 8.5, 650}, {30, -1, 5}},
        {{46.5, 8.5, 650}, {0, -1, 5}}});
}

}  // namespace

void add_sharp_scenes(std::vector<DesignedScene>& all) {
  add_arithmetic_scenes(all);
  add_wedge_scenes(all);
  add_cell_scenes(all);
  add_scale_scenes(all);
  add_slant_scenes(all);
}

}  // namespace ridgeline::test
