#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/mutants/scene_views.hpp"

namespace ridgeline::test {
namespace {

/// Hills so smooth that coarse levels hardly differ from them.
double smooth_m(double latitude_deg, double longitude_deg) {
  return 500 + 200 * std::sin(latitude_deg * 25) * std::sin(longitude_deg * 21);
}

/// Smooth hills with crests of one post's width, which coarse levels flatten to half: one in the
/// south-east part of a block of level 1, one just beyond the finest level, one close by.
double crests_m(double latitude_deg, double longitude_deg) {
  const FinePost at = fine_post(latitude_deg, longitude_deg);
  const auto ramp = [](long long middle, long long along) {
    return std::clamp(1.2 - std::abs(static_cast<double>(along - middle)) / 10, 0.0, 1.0);
  };
  double crest = 0;
  if (at.row == 771) crest = 100 * ramp(624, at.column);
  if (at.row == 451) crest = 100 * ramp(603, at.column);
  if (at.column == 561) crest = 40 * ramp(600, at.row);
  return smooth_m(latitude_deg, longitude_deg) + crest;
}

void add_crest_scenes(std::vector<DesignedScene>& all) {
  const auto over = [&](const DesignedLand& land, std::string_view name, std::string_view shows,
                        const ImageGeometry& image, std::vector<ScenePose> poses) {
    all.push_back({name, shows, land,
                   options_of({.image = image, .range_km = 30, .gpu_mebibytes = 3}), poses});
  };
  const DesignedLand crests = fine("crests", crests_m);
  over(crests, "levels", "a crest that coarse levels flatten", {512, 64, 10},
       {{{46.5, 8.5, 1000}, {0, -1.5, 5}}, {{46.5, 8.5, 1300}, {0, -2.6, 3}}});
  over(crests, "levels_border", "a crest just beyond the finest level", {512, 64, 10},
       {{{46.5, 8.5, 700}, {0, 0, 180}}, {{46.5, 8.5, 560}, {0, 0, 178}}});
  over(crests, "levels_above", "a crest seen from above", {512, 256, 20},
       {{{46.5, 8.5, 7000}, {0, -23, 5}}});
  over(crests, "levels_near", "a crest that only the finest level may draw", {256, 64, 60},
       {{{46.5, 8.5, 640}, {0, -2, 270}}});
  over(crests, "levels_narrow", "a crest in view whose block's middle is not", {512, 64, 10},
       {{{46.5, 8.5, 700}, {0, 0, 10}}});
  over(crests, "levels_wide", "a crest at the edge of 120 degrees", {530, 64, 120},
       {{{46.5, 8.5, 700}, {0, 0, 310}},
        {{46.5, 8.5, 560}, {0, 0.1, 58}},
        {{46.5, 8.5, 620}, {1, 0.2, 310}}});
  over(crests, "levels_crest", "a crest less than a pixel high", {288, 48, 60},
       {{{46.5, 8.5, 700}, {0, 0, 0}},
        {{46.5, 8.5, 560}, {1, 0, 3}},
        {{46.5, 8.5, 620}, {-1, 0.1, 357}}});
  const DesignedLand needle = fine("needles", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    const bool field = at.row >= 769 && at.row < 800 && at.column >= 608 && at.column < 640;
    const bool spike = field && at.row % 2 == 1 && at.column % 2 == 1;
    return smooth_m(latitude_deg, longitude_deg) + (spike ? 100 : 0);
  });
  over(needle, "levels_needle", "needles that coarse levels flatten to a quarter", {512, 64, 10},
       {{{46.5, 8.5, 1000}, {0, -1.5, 5}}, {{46.5, 8.5, 1300}, {0, -2.6, 3}}});
  over(fine("smooth", smooth_m), "levels_smooth", "smooth ground over all levels", {256, 48, 60},
       {{{46.5, 8.5, 1500}, {0, -5, 270}},
        {{46.5, 8.5, 2500}, {0, -8, 90}},
        {{46.5, 8.5, 2500}, {0, -8, 0}},
        {{46.5, 8.5, 5000}, {0, -20, 270}}});
  // Two pixels, one over the other, share a ray half a pixel below the upper one. What coarse
  // ground leaves out of this crest is more than that, and no other ray is within reach.
  const DesignedLand low = fine("low_crest", [](double latitude_deg, double longitude_deg) {
    const FinePost at = fine_post(latitude_deg, longitude_deg);
    const auto away = static_cast<double>(std::abs(at.column - 624));
    return 500 + (at.row == 771 ? 7.2 * std::clamp((45 - away) / 10, 0.0, 1.0) : 0.0);
  });
  all.push_back(
      {"shared_levels",
       "a crest that coarse levels flatten by more than half a pixel",
       low,
       options_of({.image = {512, 64, 10}, .range_km = 30, .error_px = 1.28, .gpu_mebibytes = 3}),
       {{{46.5, 8.5, 1000}, {1, -1.8, 5}},
        {{46.5, 8.5, 1100}, {1.5, -2.2, 5}},
        {{46.5, 8.5, 1300}, {-1, -2.9, 6}}},
       512 * 64});
}

void add_rough_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand waves = fine("waves", [](double latitude_deg, double longitude_deg) {
    return 1500 +
           400 * (std::sin(latitude_deg * 116) + std::sin(longitude_deg * 84 + latitude_deg * 30));
  });
  all.push_back({"levels_rolled",
                 "steep smooth ground at a roll of 45 degrees",
                 waves,
                 options_of({.image = {192, 192, 60}, .range_km = 30, .gpu_mebibytes = 3}),
                 {{{46.5, 8.5, 2400}, {45, -3, 30}},
                  {{46.51, 8.49, 3000}, {40, -6, 250}},
                  {{46.49, 8.51, 2600}, {-45, -4, 140}}}});
  const auto points = [](int from_rows, int to_rows, int columns, double share) {
    return [=](double latitude_deg, double longitude_deg) {
      const FinePost at = fine_post(latitude_deg, longitude_deg);
      const auto rows = std::abs(at.row - 600);
      const bool there = rows >= from_rows && rows < to_rows && std::abs(at.column - 600) < columns;
      return 400 + (there && lottery(latitude_deg, longitude_deg) < share ? 150.0 : 0.0);
    };
  };
  const std::vector<ScenePose> low{{{46.5, 8.5, 520}, {0, 0, 270}},
                                   {{46.5, 8.5, 560}, {0, 0, 300}},
                                   {{46.5, 8.5, 600}, {0, -1, 30}},
                                   {{46.5, 8.5, 540}, {0, 0, 230}}};
  all.push_back(
      {"levels_spires", "spires near the border of the finest level",
       fine("points", points(0, 70, 150, 1.0 / 400)),
       options_of(
           {.image = {192, 64, 60}, .range_km = 30, .gpu_mebibytes = 3, .spacing = wide_wedges}),
       low});
}

void add_arriving_scenes(std::vector<DesignedScene>& all) {
  const DesignedLand crests = fine("crests", crests_m);
  const DesignedLand specks = fine("specks", [](double latitude_deg, double longitude_deg) {
    const auto row = std::llround(latitude_deg * 1200), column = std::llround(longitude_deg * 1200);
    const bool speck = row % 48 < 3 && column % 48 < 3;
    return speck ? std::nan("")
                 : 400 + 100 * std::sin(latitude_deg * 90) * std::cos(longitude_deg * 70);
  });
  all.push_back({"levels_voids",
                 "voids of 3 x 3 posts in coarse levels",
                 specks,
                 options_of({.image = {384, 128, 60}, .range_km = 30, .gpu_mebibytes = 3}),
                 {{{46.5, 8.5, 3000}, {0, -10, 30}}, {{46.51, 8.49, 5000}, {0, -17, 200}}}});
  sim::SceneOptions arriving = options_of(
      {.range_km = 12, .gpu_mebibytes = 1, .arrival = sim::SceneOptions::Arrival::in_step});
  std::vector<ScenePose> flight;
  for (int k = 0; k < 4; ++k)
    flight.push_back({{46.3, 8.3 + 0.001 * k, 1500}, {0, -6, 35}, 1.0 * k});
  for (int k = 0; k < 8; ++k)
    flight.push_back({{46.65, 8.7 + 0.001 * k, 1500}, {0, -6, 240}, 10.0 + k});
  all.push_back({"jump", "a jump, drawn from what has arrived", crests, arriving, flight});
  const DesignedLand islands{"islands", [](const std::string& folder) {
                               write_coarse_cells(folder, {45, 47, 8, 10}, rough_m);
                               write_coarse_cells(folder, {45, 47, 14, 16}, rough_m);
                               std::ofstream(folder + "/edits.txt")
                                   << "10.5 46.1 15.1 30 30 3 3 fill 4500\n";
                             }};
  arriving = options_of({.arrival = sim::SceneOptions::Arrival::in_step});
  arriving.edit_file = "edits.txt";
  flight = {{{46.0, 9.0, 3000}, {0, 0, 35}, 1}};
  for (int k = 0; k < 6; ++k)
    flight.push_back({{46.0, 15.0 + 0.001 * k, 3000}, {0, 0, 35}, 10.0 + k});
  all.push_back({"edits_arriving", "an edit while blocks are on their way", islands, arriving,
                 flight, 7000, 2});
}

}  // namespace

void add_level_scenes(std::vector<DesignedScene>& all) {
  add_crest_scenes(all);
  add_rough_scenes(all);
  add_arriving_scenes(all);
}

}  // namespace ridgeline::test
