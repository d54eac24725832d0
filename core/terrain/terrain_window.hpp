#pragma once
#include <cstdint>
#include <span>

#include "core/base/result.hpp"
#include "core/terrain/height_tile.hpp"
#include "core/terrain/tile_location.hpp"

namespace ridgeline {

/// The posts the renderer sees: one regular grid round the eye, cut from raw tiles.
/// Frame: row 0 is the SOUTH row, column 0 the WEST column; columns may run past 180 degrees east.
struct WindowGrid {
  double south_deg = 0, west_deg = 0;
  double latitude_step_deg = 0, longitude_step_deg = 0;
  int columns = 0, rows = 0;  ///< multiples of limits::window_alignment_posts

  [[nodiscard]] double latitude_deg(int row) const { return south_deg + row * latitude_step_deg; }
  [[nodiscard]] double longitude_deg(int column) const {
    return west_deg + column * longitude_step_deg;
  }
};

/// What the posts of a window mean to the shaders.
///
/// A known post is stored as its height minus `base_height_m`. A void post is stored as
/// `floor - void_offset_m`, floor being the height (minus base) up to which its cells are drawn as
/// unknown: the highest known post of the smallest aligned block of 8, 16, 32 or 64 posts a side
/// that holds the void post and a known one; where there is none, the highest known post of the 5 x
/// 5 blocks round it; where those hold none, `far_floor_m` above the lowest known post of the
/// window. All three lie between what the contract says must and may be unknown (docs/adr/0006).
inline constexpr float void_offset_m = 100'000.0f;
inline constexpr float void_threshold_m = -50'000.0f;
inline constexpr double far_floor_m = 100.0;

struct WindowSummary {
  double lowest_m = 0, highest_m = 0;  ///< HAE of known posts and unknown floors
  std::int64_t known_posts = 0;
  std::int64_t void_posts = 0;
  int tiles_used = 0;
  int tiles_mismatched = 0;  ///< tiles whose posts do not lie on the window's grid: left unknown
};

/// Undulation of the geoid, m, added to every post; null function means 0 everywhere.
struct GeoidLookup {
  double (*undulation_m)(const void* context, double latitude_deg, double longitude_deg) = nullptr;
  const void* context = nullptr;
};

/// The grid for an eye: finest step of the tiles, origin on a post, centred on the eye.
/// Domain: `columns` and `rows` multiples of limits::window_alignment_posts.
WindowGrid window_grid_at(double latitude_deg, double longitude_deg, double latitude_step_deg,
                          double longitude_step_deg, double phase_latitude_deg,
                          double phase_longitude_deg, int columns, int rows);

/// The box a window covers, shrunk by `margin_posts` on every side.
GeoBox window_box(const WindowGrid& grid, int margin_posts);

/// The smallest box that holds every ground point within `range_m` of the eye (plus 1 %).
GeoBox range_box(double latitude_deg, double longitude_deg, double range_m);

/// Fills `posts` (rows x columns, row-major from the south-west) from the tiles.
/// Where two tiles give a post, the taller height counts; a known post wins over a void one.
/// A tile of a coarser grid is interpolated bilinearly, which leaves its surface unchanged.
/// Shape:  posts.size() == rows * columns; scratch.size() >= columns + 2 * tile columns.
/// Cost:   O(posts); no allocation.
WindowSummary fill_window(const WindowGrid& grid, std::span<const HeightTile> tiles,
                          const GeoidLookup& geoid, double base_height_m, std::span<float> posts,
                          std::span<float> scratch);

/// Height of the known surface at a place, m above the window's base, NaN where unknown.
/// The same posts the renderer sees, interpolated in double.
double window_height_m(const WindowGrid& grid, std::span<const float> posts, double latitude_deg,
                       double longitude_deg);

}  // namespace ridgeline
