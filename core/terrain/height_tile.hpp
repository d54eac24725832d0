#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace ridgeline {

/// Where the posts of a raster stand. Posts are points, not areas.
/// Frame: WGS 84 latitude and longitude. Row 0 is the SOUTH row, column 0 the WEST column.
struct PostGrid {
  double south_deg = 0;           ///< latitude of row 0
  double west_deg = 0;            ///< longitude of column 0, -180 <= west < 180
  double latitude_step_deg = 0;   ///< > 0
  double longitude_step_deg = 0;  ///< > 0
  int rows = 0;
  int columns = 0;

  [[nodiscard]] double north_deg() const { return south_deg + (rows - 1) * latitude_step_deg; }
  [[nodiscard]] double east_deg() const { return west_deg + (columns - 1) * longitude_step_deg; }

  friend bool operator==(const PostGrid&, const PostGrid&) = default;
};

/// Every height outside lowest_post_m..highest_post_m is unknown, in every layout. No ground or sea
/// bed of the Earth lies outside; the void markers (-32768, -32767, 32767, 65535) and the heights
/// a damaged or wrongly signed file gives do. Units: m.
inline constexpr float lowest_post_m = -12000.0F;
inline constexpr float highest_post_m = 9000.0F;

/// Also unknown in .hgt files: tools without a void of their own write it. The deepest dry land is
/// near -430 m, so it hides at most one metre of deep sea bed.
inline constexpr int hgt_extra_void_m = -9999;

/// How the bytes of a tile are laid out. A void post is NaN once read, in every layout.
enum class TileLayout : std::uint8_t {
  hgt_int16_be,  ///< rows from north to south, big-endian int16, -32768 void
  dted,          ///< records from west to east, posts from south to north, sign-magnitude
  float32_rows,  ///< rows from SOUTH to north, host float32, NaN void (decoded by a desktop reader)
  all_zero,      ///< no bytes: stated sea, every post at 0 m
};

/// A view of one raw tile: georeference plus bytes that stay where they are (a mapped file).
/// Owner: views `bytes`; whoever mapped the file keeps it alive.
struct HeightTile {
  PostGrid grid;
  TileLayout layout = TileLayout::hgt_int16_be;
  std::span<const std::byte>
      bytes;  ///< the whole file, header included; for float32_rows the posts
};

/// Reads `out.size()` posts of row `row` (0 = south) from column `column` eastwards into `out`.
/// Units: m above the tile's vertical datum (MSL for SRTM and DTED); NaN = void.
/// Domain: row and columns inside the grid, else RL_ASSERT.
/// Cost: O(out.size()); no allocation.
void read_posts(const HeightTile& tile, int row, int column, std::span<float> out);

}  // namespace ridgeline
