#include "tests/mutants/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

void add_near_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand rough = coarse("rough", alps, rough_m);
  all.push_back({"near",
                 "rough land at half a minute, every attitude",
                 rough,
                 options_of({}),
                 {{{46.013, 9.027, 3000}, {0, -8, 30}},
                  {{45.971, 8.934, 2300}, {-25, -3, 215}},
                  {{45.965, 9.1, 900}, {0, 4, 100}},
                  {{46.37, 8.925, 800}, {10, 3, 340}},
                  {{46.1, 9.2, 4500}, {100, -25, 300}}}});
  all.push_back({"around",
                 "straight down, behind, and after frames of quite other poses",
                 rough,
                 options_of({}),
                 {{{46.0131, 9.0272, 4000}, {0, -80, 10}},
                  {{46.0131, 9.0272, 3000}, {0, -10, 180}},
                  {{46.0131, 9.0272, 3000}, {0, 5, 180}},
                  {{45.91, 8.87, 3500}, {170, -35, 100}},
                  {{46.0131, 9.0272, 3200}, {20, -30, 175}}}});
  all.push_back({"coarse_rows",
                 "rows far apart",
                 rough,
                 options_of({.image = {96, 384, 20}, .spacing = {3.0, 9.0}}),
                 {{{45.965, 9.1, 900}, {0, 4, 100}},
                  {{46.37, 8.925, 1200}, {0, 0, 340}},
                  {{46.013, 9.027, 2500}, {0, -5, 30}}}});
  const auto tower = [](double latitude_deg, double longitude_deg) {
    const auto row = std::llround(latitude_deg * 120), column = std::llround(longitude_deg * 120);
    return column == 9 * 120 && row >= 46 * 120 - 12 && row < 46 * 120 - 8 ? 2000.0 : 100.0;
  };
  const DesignedLand south = coarse("south", alps, tower);
  std::vector<ScenePose> behind;  // each other way first: its nodes are still in the texture
  for (int k = -2; k < 3; ++k) {
    for (const double heading_deg : {0.0, 180.0}) {
      behind.push_back({{46.0, 9 + 0.5 * k / 120, 900}, {0, -38, heading_deg}});
    }
  }
  all.push_back({"south", "a tower due south, where a closed grid closes", south,
                 options_of({.image = {64, 512, 20}, .spacing = all_round}), behind});
  all.push_back({"down",
                 "rays steeper than the grid",
                 rough,
                 options_of({}),
                 {{{46.0131, 9.0272, 5000}, {0, -55, 40}}, {{46.1, 8.9, 8000}, {30, -40, 200}}}});
}

void add_wall_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand half = coarse("half", alps, [](double latitude_deg, double longitude_deg) {
    return longitude_deg < 8.96 ? 2500.0 : 300 + 0.3 * rough_m(latitude_deg, longitude_deg);
  });
  all.push_back({"half",
                 "a wall on the right, open land on the left",
                 half,
                 options_of({}),
                 {{{46.0131, 9.0, 9000}, {0, -3, 180}},
                  {{46.0131, 9.0, 1500}, {0, -3, 180}},
                  {{46.0131, 9.0, 9000}, {0, -65, 180}},
                  {{46.0131, 9.0, 1500}, {0, -3, 180}}}});
  const DesignedLand sharp = fine("fine_rough", rough_m);
  all.push_back({"axes",
                 "the eye on columns of posts",
                 sharp,
                 options_of({.range_km = 18}),
                 {{{46.51, 8.47, 2600}, {0, -6, 30}},
                  {{46.51, 8.47, 2600}, {-133, -6, 30}},
                  {{46.42, 8.61, 2632}, {20, -75, 200}},
                  {{46.42, 8.61, 2632}, {20, -60, 200}},
                  {{46.5, 8.5, 2600}, {0, -4, 45}},
                  {{46.5, 8.5, 2600}, {0, -4, 270}}}});
  all.push_back({"profile",
                 "profiles of rough land at 3\", 4096 pixels over 10 degrees",
                 sharp,
                 options_of({.image = strip, .range_km = 20}),
                 {{{46.513, 8.527, 2600}, {90, -2, 30}},
                  {{46.471, 8.434, 2300}, {0, -1, 215}},
                  {{46.53, 8.6, 3200}, {90, -9, 300}}},
                 3000});
  all.push_back({"walls",
                 "walls of one post's width",
                 coarse("walls", alps, walls_m),
                 options_of({.image = strip}),
                 {{{46.0131, 9.0272, 3300}, {90, -3, 30}},
                  {{45.95, 8.9, 2100}, {0, -0.5, 120}},
                  {{45.95, 8.9, 2700}, {90, -2, 220}}}});
}

void add_flat_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand mesa{"mesa", [](const std::string& folder) {
                            for (int west = -2; west < 2; ++west) {
                              write_fine_cell(folder, 0, west,
                                              [](double, double) { return 8900.0; });
                            }
                          }};
  all.push_back({"mesa",
                 "150 km of level ground at 8900 m near the equator, from 20 km",
                 mesa,
                 options_of({.image = strip, .range_km = 150, .spacing = fine_rows}),
                 {{{0.5, 0.02, 20'000}, {0, -4.9, 90}},
                  {{0.5, 0.02, 20'000}, {0, -5.5, 270}},
                  {{0.5, 0.02, 20'000}, {90, -8, 90}}}});
  // The peak behind keeps rays from starting just over the sea.
  const auto sea = [](double latitude_deg, double longitude_deg) {
    return latitude_deg > 0.5 && longitude_deg < -0.5 ? 900.0 : 0.0;
  };
  all.push_back({"sea",
                 "level ground seen along it",
                 coarse("sea", {-1, 1, -1, 1}, sea),
                 options_of({.image = strip, .range_km = 20}),
                 {{{0.013, 2.01 / 120, 40}, {90, -4, 90}}, {{0.013, 0.02, 40}, {90, -4, 20}}}});
  const auto wall = [](double latitude_deg, double) {
    return latitude_deg > 46.42 && latitude_deg < 46.5 ? 800.0 : 100.0;
  };
  const ImageGeometry wide{4096, 16, 120};
  all.push_back({"plateau",
                 "a wall as high as the eye, behind the end of the sweep",
                 coarse("plateau", alps, wall),
                 options_of({.image = wide, .range_km = 80, .spacing = {48.0, 1.5}}),
                 {{{46.0, 9.0, 740}, {0, -0.2, 0}},
                  {{46.0, 9.0, 750}, {0, -0.19, 10}},
                  {{46.0, 9.0, 700}, {0, -0.15, 0}},
                  {{46.0, 9.0, 3000}, {0, -3.4, 350}}}});
}

void add_far_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand north = coarse("north", {59, 61, 9, 13}, rough_m);
  all.push_back({"far",
                 "100 km at 60 degrees north",
                 north,
                 options_of({.image = strip, .range_km = 100}),
                 {{{60.013, 11.02, 2500}, {90, 1, 40}},
                  {{59.97, 10.93, 2700}, {0, -0.6, 250}},
                  {{60.05, 11.1, 3500}, {90, 0, 135}}}});
  all.push_back(
      {"high",
       "from 15 km over 100 km",
       north,
       options_of({.image = strip, .range_km = 100}),
       {{{60.013, 11.02, 15'000}, {90, -12, 40}}, {{60.013, 11.02, 15'000}, {90, -16, 200}}}});
  const DesignedLand arctic =
      coarse("arctic", {81, 83, 13, 27}, [](double latitude_deg, double longitude_deg) {
        const bool near = std::abs(latitude_deg - 82) < 0.35;
        return near ? 500.0 : 500 + rough_m(latitude_deg, longitude_deg);
      });
  all.push_back({"arctic",
                 "100 km at 82 degrees north",
                 arctic,
                 options_of({.image = strip, .range_km = 100}),
                 {{{82.013, 20.02, 2500}, {90, 2, 40}},
                  {{81.99, 19.93, 2700}, {0, -0.8, 320}},
                  {{82.0, 20.1, 3500}, {90, 1, 0}},
                  {{82.0, 20.1, 2200}, {0, -0.2, 155}}}});
  // A wall just south of nodes 64 posts wide: whoever leaves them straight on steps over it.
  const auto wall = [](double latitude_deg, double longitude_deg) {
    return std::llround((latitude_deg - 82) * 120) == 62 && longitude_deg > 22.2 ? 8000.0 : 0.0;
  };
  const DesignedLand bent = coarse("bent", {82, 84, 20, 32}, wall);
  sim::SceneOptions options = options_of({.image = strip, .range_km = 100});
  const std::vector<ScenePose> along{{{82 + 64.02 / 120, 20.06, 1000}, {0, 0, 92}},
                                     {{82 + 64.04 / 120, 20.06, 1000}, {0, 0.01, 88}}};
  all.push_back({"bent", "a wall along a parallel, and great circles that bend across it", bent,
                 options, along});
  options.settings.cast_every_pixel = true;
  all.push_back({"bent_cast", "the same without a grid", bent, options, along});
}

void add_spire_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand spires = coarse("spires", {44, 48, 6, 12}, spires_m);
  all.push_back({"spires",
                 "spires of one post, wedges wider than the overlap before the range ends",
                 spires,
                 options_of({.image = {512, 64, 120}, .range_km = 200, .spacing = wide_wedges}),
                 {{{46.0131, 9.0272, 2500}, {0, -1, 30}},
                  {{45.97, 8.93, 2000}, {0, -1, 115}},
                  {{46.02, 9.08, 6000}, {0, -2, 180}},
                  {{46.02, 9.084, 1200}, {0, 0, 270}}}});
  std::vector<ScenePose> many;
  for (int k = 0; k < 12; ++k) {
    many.push_back({{46.0131 + 0.01 * k, 9.0272, 1500 + 200.0 * (k % 7)}, {0, -0.5, 30.0 * k}});
  }
  all.push_back({"spires_limit", "wedges all as wide as the overlap allows", spires,
                 options_of({.image = {512, 48, 60}, .range_km = 120, .spacing = {60.0, 0.3}}),
                 many, 4000});
  all.push_back(
      {"spires_far",
       "200 km in a profile",
       spires,
       options_of({.image = strip, .range_km = 200}),
       {{{46.0131, 9.0272, 12'000}, {90, -3, 30}}, {{46.0131, 9.0272, 9'000}, {0, -2.5, 300}}}});
  const DesignedLand rough = coarse("rough_wide", {44, 48, 6, 12}, rough_m);
  all.push_back(
      {"rough_far",
       "200 km of rough land in a profile",
       rough,
       options_of({.image = strip, .range_km = 200}),
       {{{46.0131, 9.0272, 12'000}, {90, -1, 30}}, {{46.0131, 9.0272, 9'000}, {0, -2.2, 300}}}});
  const sim::SceneOptions options =
      options_of({.range_km = 100, .arrival = sim::SceneOptions::Arrival::in_step});
  std::vector<ScenePose> dash;
  for (int k = 0; k < 5; ++k)
    dash.push_back({{46.0, 7.3 + 0.9 * k, 4000}, {0, -4, 90.0 - 20 * (k % 2)}, 1.0 * k});
  all.push_back(
      {"dash", "70 km from frame to frame, faster than terrain arrives", rough, options, dash});
  const DesignedLand pole = coarse("near_pole", {87, 89, -15, 15}, rough_m);
  std::vector<ScenePose> rose;
  for (int k = 0; k < 7; ++k) rose.push_back({{87.6, 0.02, 3000}, {90, -1, 30.0 * k}});
  all.push_back({"near_pole", "nearly five ranges from a pole: the ground map at its worst", pole,
                 options_of({.image = strip, .range_km = 50}), rose, 2000});
  all.push_back({"near_pole_wide",
                 "the same at 120 degrees",
                 pole,
                 options_of({.image = {4096, 16, 120}, .range_km = 50}),
                 {{{87.6, 0.02, 2500}, {0, -1, 0}}, {{87.6, 0.02, 2500}, {0, -1, 45}}}});
}

void add_unknown_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand holes = coarse("holes", alps, rough_with_voids_m);
  all.push_back({"unknown",
                 "void islands and specks",
                 holes,
                 options_of({}),
                 {{{46.013, 9.027, 2800}, {0, -8, 30}},
                  {{45.971, 8.934, 2300}, {-25, -3, 215}},
                  {{46.93, 9.0, 3000}, {0, -8, 0}},
                  {{45.1, 8.2, 3000}, {0, -8, 200}}}});
  all.push_back({"unknown_high",
                 "voids from 12 km",
                 holes,
                 options_of({}),
                 {{{46.013, 9.027, 12'000}, {0, -25, 30}}}});
  const DesignedLand seam{
      "seam", [](const std::string& folder) {
        for (const int west : {8, 9}) {
          write_coarse_cells(folder, {45, 47, west, west + 1}, [west](double a, double b) {
            const bool gone = west == 9 && b < 9.0001 && std::sin(a * 60) > 0.3;
            return gone ? std::nan("") : rough_m(a, b) + (west == 8 ? 0 : 400 * std::sin(a * 40));
          });
        }
      }};
  all.push_back({"seam",
                 "two tiles that disagree along their edge",
                 seam,
                 options_of({}),
                 {{{46.1, 8.97, 3000}, {0, -10, 0}},
                  {{46.05, 8.9, 3000}, {0, -8, 60}},
                  {{46.05, 9.1, 2600}, {0, -8, 250}}}});
  const DesignedLand overlap{
      "overlap", [](const std::string& folder) {
        write_coarse_cells(folder, {46, 47, 8, 9}, rough_m);
        write_fine_cell(folder, 46, 8, [](double a, double b) { return 0.5 * rough_m(a, b); });
      }};
  all.push_back({"overlap",
                 "a fine tile over a coarse one that is higher",
                 overlap,
                 options_of({.range_km = 20}),
                 {{{46.5, 8.5, 2500}, {0, -8, 30}}}});
  const DesignedLand steps{"steps", [](const std::string& folder) {
                             const auto hills = [](double a, double b) {
                               return 500 + 0.05 * rough_m(a, b);
                             };
                             write_coarse_cells(folder, {46, 47, 9, 10}, hills);
                             write_fine_cell(folder, 46, 8, hills);
                           }};
  all.push_back({"steps",
                 "tiles of 3\" and 30\" side by side",
                 steps,
                 options_of({.image = {512, 64, 20}, .range_km = 20}),
                 {{{46.5, 8.9, 900}, {0, -2, 90}}, {{46.45, 9.1, 900}, {0, -2, 280}}}});
  all.push_back({"antimeridian",
                 "both sides of 180 degrees",
                 {"antimeridian",
                  [](const std::string& folder) {
                    const auto land = [](double a, double b) {
                      return rough_m(a, b < 0 ? b + 360 : b);
                    };
                    write_coarse_cells(folder, {0, 1, 179, 180}, land);
                    write_coarse_cells(folder, {0, 1, -180, -179}, land);
                  }},
                 options_of({}),
                 {{{0.5, 179.9, 3000}, {0, -8, 90}}, {{0.5, -179.9, 3000}, {0, -8, 270}}}});
}

void add_other_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand over_geoid{"over_geoid", [](const std::string& folder) {
                                  write_coarse_cells(folder, alps, rough_m);
                                  write_geoid(folder + "/geoid.gtx", {40, 52, 0, 20}, 25, 10);
                                }};
  sim::SceneOptions options = options_of({});
  options.geoid = "geoid.gtx";
  all.push_back({"geoid",
                 "heights over a geoid",
                 over_geoid,
                 options,
                 {{{46.013, 9.027, 3000}, {0, -8, 30}}}});
  // 25.30029 m over a whole number above 8192 m is as far from any float as can be.
  constexpr double ground_m = 8925.30029;
  const DesignedLand plain{
      "plain", [](const std::string& folder) {
        write_coarse_cells(folder, alps, [](double, double) { return 8900.0; });
        write_geoid(folder + "/geoid.gtx", {40, 52, 0, 20}, ground_m - 8900, 0);
      }};
  options = options_of({.image = strip, .range_km = 5});
  options.geoid = "geoid.gtx";
  all.push_back({"low_over_geoid",
                 "an eye a metre over high ground",
                 plain,
                 options,
                 {{{46.013, 9.027, ground_m + 1.2}, {90, -40, 30}},
                  {{46.013, 9.027, ground_m + 2.5}, {90, -20, 130}}}});
  options = options_of({.range_km = 5});
  options.geoid = "geoid.gtx";
  all.push_back({"low_over_rough",
                 "an eye a few metres over slopes",
                 over_geoid,
                 options,
                 {{{46.0131, 9.0272, 1450}, {0, -50, 30}}}});
  // Beyond the edge the ground is unknown up to the hills, higher than the eye: a ray south that
  // began there would end at once.
  const DesignedLand edge_hills =
      coarse("edge_hills", alps, [](double latitude_deg, double longitude_deg) {
        return 800 - 500 * std::cos((longitude_deg - 8.5) * 94.2) + 20 * (latitude_deg - 47);
      });
  all.push_back({"data_edge",
                 "a low eye exactly on the northern edge of the data",
                 edge_hills,
                 options_of({.image = {96, 72, 100}, .range_km = 15}),
                 {{{47, 8.5, 700}, {0, -9, 100}}, {{47, 8.5, 600}, {0, -9, 190}}}});
  const DesignedLand edited{"edited", [](const std::string& folder) {
                              write_coarse_cells(folder, alps, rough_m);
                              std::ofstream(folder + "/edits.txt")
                                  << "10 46.1 9.1 30 30 3 3 fill 4500\n";
                            }};
  options = options_of({});
  options.edit_file = "edits.txt";
  all.push_back({"edits",
                 "a peak raised in flight",
                 edited,
                 options,
                 {{{46.0, 9.0, 3000}, {0, 0, 35}, 9}, {{46.0, 9.0, 3000}, {0, 0, 35}, 10}}});
}

}  // namespace

const std::vector<DesignedScene>& designed_scenes() {
  static const std::vector<DesignedScene> all = [] {
    std::vector<DesignedScene> scenes;
    add_near_scenes(scenes);
    add_wall_scenes(scenes);
    add_flat_scenes(scenes);
    add_far_scenes(scenes);
    add_spire_scenes(scenes);
    add_level_scenes(scenes);
    add_unknown_scenes(scenes);
    add_other_scenes(scenes);
    add_polar_scenes(scenes);
    add_sharp_scenes(scenes);
    add_shared_scenes(scenes);
    add_sky_scenes(scenes);
    return scenes;
  }();
  return all;
}

const DesignedScene* find_scene(std::string_view name) {
  for (const DesignedScene& scene : designed_scenes()) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace ridgeline::test
