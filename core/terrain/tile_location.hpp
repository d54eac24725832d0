#pragma once
#include <string_view>

#include "core/base/result.hpp"
#include "core/terrain/height_tile.hpp"

namespace ridgeline {

/// The south-west corner of a one-degree cell. Frame: WGS 84; south -90..89, west -180..179.
struct TileLocation {
  int south_deg = 0;
  int west_deg = 0;

  friend bool operator==(const TileLocation&, const TileLocation&) = default;
};

/// The cell that a tile's file name names: `N46E008.hgt`, `n46_e008.dt1`, `s20w180.SRTMGL1.hgt`.
/// The name is N or S, two digits, an optional `_`, E or W, three digits, then its end or a
/// character that is neither letter nor digit. Any case; no folder in front.
/// Domain: S90..N89 and W180..E179, else Fault::tile_name_unknown, as for every other name.
Result<TileLocation> location_from_name(std::string_view file_name);

/// A box of latitudes and longitudes. Frame: WGS 84, degrees.
/// Domain: south <= north. The box runs from west eastwards to east: an east below west, or beyond
/// 180, says that it crosses the antimeridian; 360 degrees or more is the whole circle.
struct GeoBox {
  double south_deg = 0;
  double west_deg = 0;
  double north_deg = 0;
  double east_deg = 0;

  friend bool operator==(const GeoBox&, const GeoBox&) = default;
};

/// Whether the ground between the posts of `grid` meets the box; touching counts, because the posts
/// of a shared edge count (the taller of two tiles is the truth).
/// Error: boxes that miss each other by less than 1e-9 degree also count.
bool overlaps(const GeoBox& box, const PostGrid& grid);

}  // namespace ridgeline
