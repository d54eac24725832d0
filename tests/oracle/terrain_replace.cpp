// Posts that are replaced while frames are judged.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/oracle/terrain.hpp"

namespace ridgeline::oracle {
namespace {

/// Turns on which a patch can lie against a tile: a tile that goes all round holds both ends.
constexpr double turns_deg[] = {-360.0, 0.0, 360.0};

/// A row of posts: `first + i * step`.
struct PostRow {
  double first_deg;
  double step_deg;
  int count;
};

PostRow south_to_north(const Grid& grid) {
  return {grid.south_deg, grid.lat_step_deg, grid.rows};
}

PostRow west_to_east(const Grid& grid, double turn_deg) {
  return {grid.west_deg + turn_deg, grid.lon_step_deg, grid.columns};
}

/// For every post of `patch` the index of the post of `tile` at its place, or -1.
std::vector<int> shared_posts(const PostRow& patch, const PostRow& tile) {
  const double slack = same_post_steps * std::min(1.0, patch.step_deg / tile.step_deg);
  std::vector<int> indices;
  indices.reserve(static_cast<std::size_t>(patch.count));
  for (int i = 0; i < patch.count; ++i) {
    indices.push_back(post_index(patch.first_deg + i * patch.step_deg, tile.first_deg,
                                 tile.step_deg, tile.count, slack));
  }
  return indices;
}

bool has_some(const std::vector<int>& indices) {
  return std::any_of(indices.begin(), indices.end(), [](int index) { return index >= 0; });
}

bool shares_posts(const Grid& grid, const Grid& patch) {
  return has_some(shared_posts(south_to_north(patch), south_to_north(grid))) &&
         std::any_of(std::begin(turns_deg), std::end(turns_deg), [&](double turn) {
           return has_some(shared_posts(west_to_east(patch, turn), west_to_east(grid, 0)));
         });
}

bool has_steps_of(const Grid& grid, const Grid& patch) {
  return std::abs(grid.lat_step_deg / patch.lat_step_deg - 1) < 1e-6 &&
         std::abs(grid.lon_step_deg / patch.lon_step_deg - 1) < 1e-6;
}

}  // namespace

bool Terrain::has_lattice_of(const Grid& patch) const {
  const auto is_lattice = [&](const Grid& grid) {
    return has_steps_of(grid, patch) && shares_posts(grid, patch);
  };
  return std::any_of(far_grids_.begin(), far_grids_.end(), is_lattice) ||
         std::any_of(tiles_.begin(), tiles_.end(),
                     [&](const TerrainTile& entry) { return is_lattice(entry.tile); });
}

ReplacedPosts Terrain::replace(const Tile& patch) {
  ReplacedPosts replaced;
  replaced.lowest_elsewhere_m = lowest_elsewhere_m_;
  for (std::size_t index = 0; index < tiles_.size(); ++index) {
    Tile& tile = tiles_[index].tile;
    const std::vector<int> rows = shared_posts(south_to_north(patch), south_to_north(tile));
    if (!has_some(rows)) continue;
    for (const double turn : turns_deg) {
      const std::vector<int> columns =
          shared_posts(west_to_east(patch, turn), west_to_east(tile, 0));
      for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
          if (rows[r] < 0 || columns[c] < 0) continue;
          replaced.posts.push_back({index, rows[r], columns[c], tile.at(rows[r], columns[c])});
          tile.set(rows[r], columns[c], patch.at(static_cast<int>(r), static_cast<int>(c)));
        }
      }
    }
  }
  // The posts of tiles that were not kept are not known one by one; a lower post among them can
  // only lower what must be unknown.
  if (std::any_of(far_grids_.begin(), far_grids_.end(),
                  [&](const Grid& grid) { return shares_posts(grid, patch); })) {
    lowest_elsewhere_m_ = std::min(lowest_elsewhere_m_, lowest_known_m(patch));
  }
  summarise_changed(replaced.posts);
  return replaced;
}

void Terrain::put_back(const ReplacedPosts& replaced) {
  // Backwards, because a post may have been replaced twice.
  for (auto post = replaced.posts.rbegin(); post != replaced.posts.rend(); ++post) {
    tiles_[post->tile].tile.set(post->row, post->column, post->height_m);
  }
  lowest_elsewhere_m_ = replaced.lowest_elsewhere_m;
  summarise_changed(replaced.posts);
}

}  // namespace ridgeline::oracle
