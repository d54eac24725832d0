#include "sim/attack/attack_case.hpp"

#include <charconv>
#include <cmath>

namespace ridgeline::sim {
namespace {

constexpr LayerNumber height{"height_m", NumberRole::amount, -25'000, 25'000, false};
constexpr LayerNumber wave{"wave_m", NumberRole::length, 1, 1e7, false};
constexpr LayerNumber seed{"seed", NumberRole::pattern, 0, 1e15, true};
constexpr LayerNumber one_in{"one_in", NumberRole::rarity, 1, 1e9, true};
constexpr LayerNumber spacing{"spacing", NumberRole::rarity, 1, 1e6, true};
constexpr LayerNumber width{"width", NumberRole::length, 1, 1e6, true};
constexpr LayerNumber direction{"direction", NumberRole::pattern, 0, 3, true};
constexpr LayerNumber first{"first", NumberRole::pattern, -1e6, 1e6, true};
constexpr LayerNumber share{"share", NumberRole::amount, 0, 1, false};
constexpr LayerNumber level{"level_m", NumberRole::length, -12'000, 9'000, false};
constexpr LayerNumber extent{"extent", NumberRole::amount, 0, 1e6, true};
constexpr LayerNumber rise{"rise_m", NumberRole::length, 1e-3, 25'000, false};

constexpr std::array<LayerForm, layer_kinds> forms{{
    {"flat", 1, {height}},
    {"slope", 2, {height, height}},
    {"fractal", 3, {height, wave, seed}},
    {"ridges", 3, {height, wave, seed}},
    {"rough", 2, {height, seed}},
    {"spires", 3, {height, one_in, seed}},
    {"walls", 5, {height, spacing, width, direction, first}},
    {"cliffs", 4, {height, spacing, direction, first}},
    {"checker", 2, {height, width}},
    {"stairs", 1, {rise}},
    {"clamp", 2, {level, level}},
    {"seam", 1, {height}},
    {"holes", 2, {one_in, seed}},
    {"islands", 3, {share, wave, seed}},
    {"stripes", 4, {spacing, width, direction, first}},
    {"half", 2, {direction, first}},
    {"box", 4, {first, first, extent, extent}},
}};

constexpr std::array<const char*, 5> format_names{"hgt", "dt0", "dt1", "tif16", "tif32"};
constexpr std::array<const char*, 3> arrival_names{"settled", "in_step", "as_ready"};

std::string number_text(double value) {
  char buffer[40];
  const auto [end, fault] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return fault == std::errc() ? std::string(buffer, end) : "0";
}

template <typename... Numbers>
std::string list(Numbers... numbers) {
  std::string text;
  ((text += (text.empty() ? "" : ",") + number_text(static_cast<double>(numbers))), ...);
  return text;
}

std::string layer_text(const Layer& layer) {
  const LayerForm& form = layer_form(layer.kind);
  std::string text = form.name;
  for (std::size_t i = 0; i < form.count; ++i) {
    text += (i == 0 ? ":" : ",") + number_text(layer.numbers[i]);
  }
  return text;
}

bool is_tiff(TileFormat format) {
  return format == TileFormat::tif16 || format == TileFormat::tif32;
}

std::string tile_text(const TilePlan& t) {
  const std::string name = format_names[static_cast<std::size_t>(t.format)];
  if (!is_tiff(t.format)) return name + ":" + list(t.south_deg, t.west_deg);
  return name + ":" +
         list(t.south_deg, t.west_deg, t.lat_per_deg, t.lon_per_deg, t.rows, t.columns);
}

// Multiples of the latitude interval of DTED, from the equator to the pole.
int zone_factor(double south_deg) {
  const double nearest = south_deg >= 0 ? south_deg : -south_deg - 1;
  if (nearest < 50) return 1;
  if (nearest < 70) return 2;
  if (nearest < 75) return 3;
  return nearest < 80 ? 4 : 6;
}

}  // namespace

const LayerForm& layer_form(LayerKind kind) {
  return forms[static_cast<std::size_t>(kind)];
}

bool operator==(const EditPlan& a, const EditPlan& b) {
  const bool same_height =
      a.height_m == b.height_m || (std::isnan(a.height_m) && std::isnan(b.height_m));
  return same_height && a.time_s == b.time_s && a.south_deg == b.south_deg &&
         a.west_deg == b.west_deg && a.lat_per_deg == b.lat_per_deg &&
         a.lon_per_deg == b.lon_per_deg && a.rows == b.rows && a.columns == b.columns;
}

bool operator==(const AttackCase& a, const AttackCase& b) {
  return text_of(a) == text_of(b);
}

std::string text_of(const AttackCase& c) {
  std::string text = "at=" + list(c.at_latitude_deg, c.at_longitude_deg);
  for (const Layer& layer : c.land) text += " land=" + layer_text(layer);
  for (const TilePlan& tile : c.tiles) text += " tile=" + tile_text(tile);
  for (const SeaCell& cell : c.sea) text += " sea=" + list(cell.south_deg, cell.west_deg);
  for (const EditPlan& e : c.edits) {
    text += " edit=" + list(e.time_s, e.south_deg, e.west_deg, e.lat_per_deg, e.lon_per_deg, e.rows,
                            e.columns);
    text += "," + (std::isnan(e.height_m) ? std::string("void") : number_text(e.height_m));
  }
  if (c.geoid.amplitude_m != 0) {
    text += " geoid=" + list(c.geoid.amplitude_m, c.geoid.step_deg, c.geoid.seed);
  }
  text += " window=" + number_text(c.window_mib);
  text += std::string(" arrival=") + arrival_names[static_cast<std::size_t>(c.arrival)];
  text += " size=" + list(c.image.width_px, c.image.height_px);
  text += " hfov=" + number_text(c.image.horizontal_field_of_view_deg);
  text += " error=" + number_text(c.error_px) + " range=" + number_text(c.range_m);
  for (const AttackPose& p : c.poses) {
    text += " pose=" + list(p.latitude_deg, p.longitude_deg, p.height_m, p.roll_deg, p.pitch_deg,
                            p.heading_deg, p.time_s);
  }
  return text;
}

PostGrid grid_of(const TilePlan& t) {
  if (is_tiff(t.format)) {
    // Like every reader, from whole posts: the corner is the nearest one to what the plan says.
    return {std::round(t.south_deg * t.lat_per_deg) / t.lat_per_deg,
            std::round(t.west_deg * t.lon_per_deg) / t.lon_per_deg,
            1.0 / t.lat_per_deg,
            1.0 / t.lon_per_deg,
            t.rows,
            t.columns};
  }
  const int intervals = t.format == TileFormat::dt0 ? 120 : 1200;
  const int across = t.format == TileFormat::hgt ? intervals : intervals / zone_factor(t.south_deg);
  return {t.south_deg, t.west_deg, 1.0 / intervals, 1.0 / across, intervals + 1, across + 1};
}

}  // namespace ridgeline::sim
