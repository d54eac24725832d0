#include "core/terrain/shared_posts.hpp"

#include <algorithm>
#include <cmath>

#include "core/terrain/post_index.hpp"

namespace ridgeline {
namespace {

constexpr double same_step = 1e-6;  ///< relative
constexpr double touching_deg = 1e-9;

bool same(double a, double b) {
  return std::abs(a / b - 1.0) < same_step;
}

float taller(float a, float b) {
  if (std::isnan(a)) return b;
  if (std::isnan(b)) return a;
  return std::max(a, b);
}

/// Two tiles that touch: `shift_deg` brings the other's longitudes to the tile's turn.
struct Contact {
  bool shares = false;
  double shift_deg = 0;
};

Contact contact(const PostGrid& tile, const PostGrid& other) {
  const double middle = 0.5 * (tile.west_deg + tile.east_deg());
  const double other_middle = 0.5 * (other.west_deg + other.east_deg());
  Contact c;
  c.shift_deg = 360.0 * std::round((middle - other_middle) / 360.0);
  const double width = std::min(tile.east_deg(), other.east_deg() + c.shift_deg) -
                       std::max(tile.west_deg, other.west_deg + c.shift_deg);
  const double height =
      std::min(tile.north_deg(), other.north_deg()) - std::max(tile.south_deg, other.south_deg);
  if (width < -touching_deg || height < -touching_deg) return c;
  const bool one_lattice = same(tile.latitude_step_deg, other.latitude_step_deg) &&
                           same(tile.longitude_step_deg, other.longitude_step_deg);
  const bool only_an_edge =
      width < 0.5 * std::min(tile.longitude_step_deg, other.longitude_step_deg) ||
      height < 0.5 * std::min(tile.latitude_step_deg, other.latitude_step_deg);
  c.shares = one_lattice || only_an_edge;
  return c;
}

float own_post(const TerrainSource& source, const HeightTile& tile, int row, int column) {
  float post = 0;
  read_posts(tile, row, column, std::span(&post, 1));
  if (!source.edits.empty()) apply_edits(source.edits, tile.grid, row, column, std::span(&post, 1));
  return post;
}

/// Merges what another tile says of posts first..end (excluded) of a row.
void merge_other(const TerrainSource& source, const PostGrid& tile, const HeightTile& other,
                 const Contact& c, int row, int column, int first, int end, std::span<float> out) {
  const PostGrid& o = other.grid;
  const double latitude = tile.south_deg + row * tile.latitude_step_deg;
  const int other_row = post_index(latitude, o.south_deg, o.latitude_step_deg, o.rows);
  if (other_row < 0) return;
  const double west = o.west_deg + c.shift_deg;
  const double east = o.east_deg() + c.shift_deg;
  const double from = std::ceil((west - tile.west_deg) / tile.longitude_step_deg - 0.5);
  const double to = std::floor((east - tile.west_deg) / tile.longitude_step_deg + 0.5);
  const int low = static_cast<int>(std::max(from, static_cast<double>(first)));
  const int high = static_cast<int>(std::min(to, end - 1.0));
  for (int k = low; k <= high; ++k) {
    const double longitude = tile.west_deg + k * tile.longitude_step_deg;
    const int other_column = post_index(longitude, west, o.longitude_step_deg, o.columns);
    if (other_column < 0) continue;
    float& post = out[static_cast<std::size_t>(k - column)];
    post = taller(post, own_post(source, other, other_row, other_column));
  }
}

}  // namespace

void read_shared_posts(const TerrainSource& source, const HeightTile& tile, int row, int column,
                       std::span<float> out) {
  read_posts(tile, row, column, out);
  if (!source.edits.empty()) apply_edits(source.edits, tile.grid, row, column, out);
  const PostGrid& grid = tile.grid;
  const int end = column + static_cast<int>(out.size()), last = grid.columns - 1;
  const bool border_row = row == 0 || row == grid.rows - 1;
  const bool west = column == 0 && end > 0, east = end == grid.columns;
  if (!border_row && !west && !east) return;
  for (const HeightTile& other : source.tiles) {
    if (&other == &tile) continue;
    const Contact c = contact(grid, other.grid);
    if (!c.shares) continue;
    if (border_row) {
      merge_other(source, grid, other, c, row, column, column, end, out);
      continue;
    }
    if (west) merge_other(source, grid, other, c, row, column, 0, 1, out);
    if (east) merge_other(source, grid, other, c, row, column, last, grid.columns, out);
  }
}

}  // namespace ridgeline
