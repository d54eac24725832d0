#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "config/limits.hpp"
#include "sim/attack/attack_case.hpp"

namespace ridgeline::sim {
namespace {

constexpr std::size_t most_layers = 64, most_tiles = 400, most_sea = 64, most_poses = 256;
constexpr std::size_t most_numbers = 8;
constexpr double most_posts = 1 << 24, most_pixels = 1 << 22;
constexpr double longest_time_s = 1e6;

/// The numbers of one word, taken in turn; one bad number makes the whole bad.
class Numbers {
 public:
  explicit Numbers(std::string_view text) {
    for (std::size_t from = 0; from <= text.size() && count_ < most_numbers;) {
      const std::size_t comma = std::min(text.find(',', from), text.size());
      values_[count_++] = number(text.substr(from, comma - from));
      from = comma + 1;
      complete_ = from > text.size();
    }
  }

  double next(double least, double most, bool whole = false) {
    const double value = taken_ < count_ ? values_[taken_] : std::nan("");
    ++taken_;
    if (!(value >= least && value <= most) || (whole && value != std::trunc(value))) good_ = false;
    return good_ ? value : least;
  }
  int next_int(int least, int most) { return static_cast<int>(next(least, most, true)); }
  /// NaN for the word `void`.
  double next_height() {
    if (taken_ < count_ && std::isinf(values_[taken_])) {
      ++taken_;
      return std::nan("");
    }
    return next(limits::min_terrain_height_m, limits::max_terrain_height_m);
  }

  [[nodiscard]] bool good() const { return good_ && complete_ && taken_ == count_; }

 private:
  /// NaN where it is no number, infinity where it is the word `void`.
  static double number(std::string_view text) {
    if (text == "void") return std::numeric_limits<double>::infinity();
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole_word = fault == std::errc() && end == text.data() + text.size();
    return whole_word && std::isfinite(value) ? value : std::nan("");
  }

  std::array<double, most_numbers> values_{};
  std::size_t count_ = 0, taken_ = 0;
  bool complete_ = false, good_ = true;
};

bool parse_layer(std::string_view text, AttackCase& c) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  if (colon == text.size() || c.land.size() >= most_layers) return false;
  for (int k = 0; k < layer_kinds; ++k) {
    Layer layer{static_cast<LayerKind>(k), {}};
    const LayerForm& form = layer_form(layer.kind);
    if (text.substr(0, colon) != form.name) continue;
    Numbers numbers(text.substr(colon + 1));
    for (std::size_t i = 0; i < form.count; ++i) {
      const LayerNumber& n = form.numbers[i];
      layer.numbers[i] = numbers.next(n.least, n.most, n.whole);
    }
    c.land.push_back(layer);
    return numbers.good();
  }
  return false;
}

bool parse_tile(std::string_view text, AttackCase& c) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  if (colon == text.size() || c.tiles.size() >= most_tiles) return false;
  const std::string_view name = text.substr(0, colon);
  Numbers numbers(text.substr(colon + 1));
  TilePlan tile;
  if (name == "hgt" || name == "dt0" || name == "dt1") {
    tile.format = name == "hgt"   ? TileFormat::hgt
                  : name == "dt0" ? TileFormat::dt0
                                  : TileFormat::dt1;
    tile.south_deg = numbers.next_int(-90, 89);
    tile.west_deg = numbers.next_int(-180, 179);
    c.tiles.push_back(tile);
    return numbers.good();
  }
  if (name != "tif16" && name != "tif32") return false;
  tile.format = name == "tif16" ? TileFormat::tif16 : TileFormat::tif32;
  tile.south_deg = numbers.next(-90, 90);
  tile.west_deg = numbers.next(-180, 180);
  tile.lat_per_deg = numbers.next_int(1, 10'800);
  tile.lon_per_deg = numbers.next_int(1, 10'800);
  tile.rows = numbers.next_int(2, 20'000);
  tile.columns = numbers.next_int(2, 20'000);
  c.tiles.push_back(tile);
  if (!numbers.good() || static_cast<double>(tile.rows) * tile.columns > most_posts) return false;
  const PostGrid grid = grid_of(tile);
  return grid.north_deg() <= 90 + 1e-9 && grid.east_deg() - grid.west_deg <= 360 + 1e-9;
}

bool parse_edit(std::string_view text, AttackCase& c) {
  if (c.edits.size() >= limits::max_edits) return false;
  Numbers numbers(text);
  EditPlan e;
  e.time_s = numbers.next(0, longest_time_s);
  e.south_deg = numbers.next(-90, 90);
  e.west_deg = numbers.next(-180, 180);
  e.lat_per_deg = numbers.next_int(1, 10'800);
  e.lon_per_deg = numbers.next_int(1, 10'800);
  e.rows = numbers.next_int(1, 1'000);
  e.columns = numbers.next_int(1, 1'000);
  e.height_m = numbers.next_height();
  c.edits.push_back(e);
  return numbers.good();
}

bool parse_pose(std::string_view text, AttackCase& c) {
  if (c.poses.size() >= most_poses) return false;
  Numbers numbers(text);
  AttackPose p;
  p.latitude_deg = numbers.next(-90, 90);
  p.longitude_deg = numbers.next(-180, 360);
  p.height_m = numbers.next(limits::min_eye_height_m, limits::max_eye_height_m);
  p.roll_deg = numbers.next(-360, 360);
  p.pitch_deg = numbers.next(-90, 90);
  p.heading_deg = numbers.next(-720, 720);
  p.time_s = numbers.next(0, longest_time_s);
  c.poses.push_back(p);
  return numbers.good();
}

bool parse_arrival(std::string_view text, AttackCase& c) {
  using Arrival = SceneOptions::Arrival;
  if (text != "settled" && text != "in_step" && text != "as_ready") return false;
  c.arrival = text == "settled"   ? Arrival::settled
              : text == "in_step" ? Arrival::in_step
                                  : Arrival::as_ready;
  return true;
}

bool parse_geoid(Numbers& numbers, AttackCase& c) {
  c.geoid.amplitude_m = numbers.next(0, 150);
  c.geoid.step_deg = numbers.next(0.25, 90);
  c.geoid.seed = numbers.next(0, 1e15, true);
  const double steps = 180 / c.geoid.step_deg;
  return numbers.good() && steps == std::trunc(steps);
}

bool parse_size(Numbers& numbers, AttackCase& c) {
  c.image.width_px = numbers.next_int(limits::min_image_px, limits::max_image_px);
  c.image.height_px = numbers.next_int(limits::min_image_px, limits::max_image_px);
  return numbers.good() && static_cast<double>(c.image.width_px) * c.image.height_px <= most_pixels;
}

bool parse_single(std::string_view key, std::string_view value, AttackCase& c) {
  if (key == "arrival") return parse_arrival(value, c);
  Numbers numbers(value);
  if (key == "size") return parse_size(numbers, c);
  if (key == "geoid") return parse_geoid(numbers, c);
  if (key == "at") {
    c.at_latitude_deg = numbers.next(-90, 90);
    c.at_longitude_deg = numbers.next(-180, 180);
  } else if (key == "window") {
    c.window_mib = numbers.next(0.05, 512);
  } else if (key == "hfov") {
    c.image.horizontal_field_of_view_deg =
        numbers.next(limits::min_field_of_view_deg, limits::max_field_of_view_deg);
  } else if (key == "error") {
    c.error_px = numbers.next(1e-4, limits::max_error_px);
  } else if (key == "range") {
    c.range_m = numbers.next(limits::min_range_m, limits::max_range_m);
  } else {
    return false;
  }
  return numbers.good();
}

bool parse_word(std::string_view key, std::string_view value, AttackCase& c,
                std::set<std::string, std::less<>>& seen) {
  if (key == "land") return parse_layer(value, c);
  if (key == "tile") return parse_tile(value, c);
  if (key == "edit") return parse_edit(value, c);
  if (key == "pose") return parse_pose(value, c);
  if (key == "sea") {
    Numbers numbers(value);
    const int south = numbers.next_int(-90, 89);
    c.sea.push_back({south, numbers.next_int(-180, 179)});
    return numbers.good() && c.sea.size() <= most_sea;
  }
  return seen.emplace(key).second && parse_single(key, value, c);
}

}  // namespace

std::string parse_case(const std::string& text, AttackCase& attack_case) {
  AttackCase made;
  std::set<std::string, std::less<>> seen;
  const std::string_view all = text;
  for (std::size_t from = 0; from < all.size();) {
    const std::size_t blank = std::min(all.find(' ', from), all.size());
    const std::string_view word = all.substr(from, blank - from);
    from = blank + 1;
    if (word.empty()) continue;
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string_view value =
        equals < word.size() ? word.substr(equals + 1) : std::string_view();
    if (!parse_word(word.substr(0, equals), value, made, seen)) {
      return "\"" + std::string(word) + "\" is no part of a case";
    }
  }
  if (made.tiles.empty()) return "a case without a tile";
  if (made.poses.empty()) return "a case without a pose";
  attack_case = std::move(made);
  return {};
}

}  // namespace ridgeline::sim
