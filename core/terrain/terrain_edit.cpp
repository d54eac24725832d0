#include "core/terrain/terrain_edit.hpp"

#include <algorithm>
#include <cmath>

#include "core/terrain/post_index.hpp"

namespace ridgeline {
namespace {

/// One row of a tile through one edit.
void apply_edit(const TerrainEdit& edit, const PostGrid& tile, int edit_row, int column,
                std::span<float> posts) {
  const PostGrid& e = edit.grid;
  const double middle = 0.5 * (tile.west_deg + tile.east_deg());
  const double edit_middle = 0.5 * (e.west_deg + e.east_deg());
  const double west = e.west_deg + 360.0 * std::round((middle - edit_middle) / 360.0);
  const double east = west + (e.columns - 1) * e.longitude_step_deg;
  const double from = (west - tile.west_deg) / tile.longitude_step_deg - column;
  const double to = (east - tile.west_deg) / tile.longitude_step_deg - column;
  const auto count = static_cast<double>(posts.size());
  const auto first = static_cast<std::ptrdiff_t>(std::clamp(std::floor(from), 0.0, count));
  const auto end = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(to) + 1.0, 0.0, count));
  for (std::ptrdiff_t k = first; k < end; ++k) {
    const double longitude =
        tile.west_deg + static_cast<double>(column + k) * tile.longitude_step_deg;
    const int at = post_index(longitude, west, e.longitude_step_deg, e.columns);
    if (at >= 0) {
      posts[static_cast<std::size_t>(k)] =
          edit.heights_m[static_cast<std::size_t>(edit_row) * static_cast<std::size_t>(e.columns) +
                         static_cast<std::size_t>(at)];
    }
  }
}

}  // namespace

void apply_edits(std::span<const TerrainEdit> edits, const PostGrid& tile, int row, int column,
                 std::span<float> posts) {
  const double latitude = tile.south_deg + row * tile.latitude_step_deg;
  for (const TerrainEdit& edit : edits) {
    const PostGrid& e = edit.grid;
    const int at = post_index(latitude, e.south_deg, e.latitude_step_deg, e.rows);
    if (at >= 0) apply_edit(edit, tile, at, column, posts);
  }
}

}  // namespace ridgeline
