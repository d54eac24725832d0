#include "core/terrain/tile_location.hpp"

#include <cmath>
#include <cstddef>

namespace ridgeline {
namespace {

constexpr double touch_deg = 1e-9;

// ASCII only: the locale has no say in file names.
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool ends_name(std::string_view name, std::size_t at) {
  if (at >= name.size()) return true;
  const char c = upper(name[at]);
  return !is_digit(c) && !(c >= 'A' && c <= 'Z');
}

// Degrees from `count` digits, or -1.
int degrees_at(std::string_view name, std::size_t at, std::size_t count) {
  if (name.size() < at + count) return -1;
  int degrees = 0;
  for (const char c : name.substr(at, count)) {
    if (!is_digit(c)) return -1;
    degrees = 10 * degrees + (c - '0');
  }
  return degrees;
}

double wrapped_360(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360.0 : rest;
}

}  // namespace

Result<TileLocation> location_from_name(std::string_view file_name) {
  if (file_name.size() < 7) return Fault::tile_name_unknown;
  const char latitude_sign = upper(file_name[0]);
  if (latitude_sign != 'N' && latitude_sign != 'S') return Fault::tile_name_unknown;
  const int latitude = degrees_at(file_name, 1, 2);
  const std::size_t at = file_name[3] == '_' ? 4 : 3;
  const char longitude_sign = upper(file_name[at]);
  if (longitude_sign != 'E' && longitude_sign != 'W') return Fault::tile_name_unknown;
  const int longitude = degrees_at(file_name, at + 1, 3);
  if (latitude < 0 || longitude < 0 || !ends_name(file_name, at + 4)) {
    return Fault::tile_name_unknown;
  }
  const TileLocation location{latitude_sign == 'S' ? -latitude : latitude,
                              longitude_sign == 'W' ? -longitude : longitude};
  if (location.south_deg < -90 || location.south_deg > 89 || location.west_deg < -180 ||
      location.west_deg > 179) {
    return Fault::tile_name_unknown;
  }
  return location;
}

bool overlaps(const GeoBox& box, const PostGrid& grid) {
  if (grid.south_deg > box.north_deg + touch_deg) return false;
  if (grid.north_deg() < box.south_deg - touch_deg) return false;
  const double span_deg = box.east_deg - box.west_deg;
  const double box_width_deg = span_deg >= 360.0 ? 360.0 : wrapped_360(span_deg);
  const double grid_width_deg = grid.east_deg() - grid.west_deg;
  const double offset_deg = wrapped_360(grid.west_deg - box.west_deg);
  return offset_deg <= box_width_deg + touch_deg ||
         offset_deg + grid_width_deg >= 360.0 - touch_deg;
}

}  // namespace ridgeline
