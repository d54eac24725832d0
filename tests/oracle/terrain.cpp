#include "tests/oracle/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "tests/oracle/coverage.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/tile_files.hpp"

namespace ridgeline::oracle {
namespace {

bool same_steps(const Tile& a, const Tile& b) {
  return std::abs(a.lat_step_deg / b.lat_step_deg - 1) < 1e-9 &&
         std::abs(a.lon_step_deg / b.lon_step_deg - 1) < 1e-9;
}

/// The first and last index of a row of posts inside [low, high].
std::pair<int, int> post_range(double low, double high, double first, double step, int count) {
  const double from = std::ceil((low - first) / step - same_post_steps);
  const double to = std::floor((high - first) / step + same_post_steps);
  return {static_cast<int>(std::clamp(from, 0.0, static_cast<double>(count))),
          static_cast<int>(std::clamp(to, -1.0, count - 1.0))};
}

float taller(float a, float b) {
  if (std::isnan(a)) return b;
  if (std::isnan(b)) return a;
  return std::max(a, b);
}

/// Makes two tiles agree on the posts they share. `a` is not finer than `b`.
void share_posts_of(Tile& a, Tile& b) {
  const double b_west = west_on_turn(b, a.west_deg + 0.5 * (a.east_deg() - a.west_deg));
  const double b_east = b_west + (b.columns - 1) * b.lon_step_deg;
  const auto rows = post_range(b.south_deg, b.north_deg(), a.south_deg, a.lat_step_deg, a.rows);
  const auto columns = post_range(b_west, b_east, a.west_deg, a.lon_step_deg, a.columns);
  if (rows.first > rows.second || columns.first > columns.second) return;
  const bool only_an_edge = rows.first == rows.second || columns.first == columns.second;
  if (!same_steps(a, b) && !only_an_edge) return;
  std::vector<int> b_columns;
  for (int column = columns.first; column <= columns.second; ++column) {
    b_columns.push_back(
        post_index(a.west_deg + column * a.lon_step_deg, b_west, b.lon_step_deg, b.columns));
  }
  for (int row = rows.first; row <= rows.second; ++row) {
    const int b_row =
        post_index(a.south_deg + row * a.lat_step_deg, b.south_deg, b.lat_step_deg, b.rows);
    if (b_row < 0) continue;
    for (int column = columns.first; column <= columns.second; ++column) {
      const int b_column = b_columns[static_cast<std::size_t>(column - columns.first)];
      if (b_column < 0) continue;
      const float height = taller(a.at(row, column), b.at(b_row, b_column));
      a.set(row, column, height);
      b.set(b_row, b_column, height);
    }
  }
}

/// A tile that goes round the whole Earth meets itself: its first and last columns are the same
/// posts.
void share_own_posts(Tile& tile) {
  const double turn = (tile.columns - 1) * tile.lon_step_deg;
  if (std::abs(turn - 360) > same_post_steps * tile.lon_step_deg) return;
  for (int row = 0; row < tile.rows; ++row) {
    const float height = taller(tile.at(row, 0), tile.at(row, tile.columns - 1));
    tile.set(row, 0, height);
    tile.set(row, tile.columns - 1, height);
  }
}

bool is_near(const Tile& tile, const std::vector<Neighbourhood>& places) {
  return places.empty() ||
         std::any_of(places.begin(), places.end(), [&](const Neighbourhood& place) {
           const double reach_deg = place.radius_m / 110000.0;
           const double lat = std::abs(place.lat_deg) + reach_deg;
           const double lon_reach_deg =
               lat < 89 ? reach_deg / std::cos(lat * degree_rad) : 360.0;  // all round the pole
           const double west = west_on_turn(tile, place.lon_deg);
           const double east = west + tile.east_deg() - tile.west_deg;
           return tile.south_deg < place.lat_deg + reach_deg &&
                  tile.north_deg() > place.lat_deg - reach_deg &&
                  west < place.lon_deg + lon_reach_deg && east > place.lon_deg - lon_reach_deg;
         });
}

/// The files of a folder and of its sub-folders, one level deep, hidden ones left out.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder) {
  std::error_code fault;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::recursive_directory_iterator it(folder, fault), end; !fault && it != end;
       it.increment(fault)) {
    const bool is_hidden = it->path().filename().string().starts_with('.');
    if (it->is_directory() && (is_hidden || it.depth() > 0)) it.disable_recursion_pending();
    if (!it->is_directory() && !is_hidden) files.push_back(it->path());
  }
  if (fault) throw InputError(folder.string(), "folder cannot be read");
  std::sort(files.begin(), files.end());
  return files;
}

/// What a folder and a coverage list hold together.
struct FolderTiles {
  std::vector<Tile> near;
  std::optional<Tile> elsewhere;  ///< some tile of a file that is not near
  std::vector<Grid> grids;        ///< where a file has its posts, readable or not
  std::vector<Grid> far_grids;
  std::vector<std::string> refused;
  std::vector<DegreeCell> refused_cells;  ///< that their names name
  double lowest_far_m = std::numeric_limits<double>::infinity();

  void add_file(const std::filesystem::path& file, const std::vector<Neighbourhood>& places) {
    std::optional<Tile> tile;
    try {
      tile = read_tile(file);
    } catch (const InputError& error) {
      refused.emplace_back(error.what());
      if (const auto cell = cell_in_name(file)) refused_cells.push_back(*cell);
      if (const auto grid = grid_of_file(file)) grids.push_back(*grid);
    }
    if (!tile) return;
    grids.push_back(*tile);
    if (is_near(*tile, places)) {
      near.push_back(std::move(*tile));
      return;
    }
    far_grids.push_back(*tile);
    lowest_far_m = std::min(lowest_far_m, lowest_known_m(*tile));
    if (!elsewhere) elsewhere = std::move(tile);
  }

  [[nodiscard]] bool has_file_for(const DegreeCell& cell) const {
    return std::find(refused_cells.begin(), refused_cells.end(), cell) != refused_cells.end() ||
           std::any_of(grids.begin(), grids.end(),
                       [&](const Grid& grid) { return reaches_into(grid, cell); });
  }

  void add_sea(const DegreeCell& cell, const StepsPerDegree& steps,
               const std::vector<Neighbourhood>& places) {
    Tile tile = sea_tile(cell, steps);
    if (is_near(tile, places)) {
      near.push_back(std::move(tile));
    } else {
      far_grids.push_back(tile);
      lowest_far_m = std::min(lowest_far_m, 0.0);
    }
  }
};

}  // namespace

double lowest_known_m(const Tile& tile) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tile.posts.size(); ++i) {
    const float post = tile.posts[i];
    if (!std::isnan(post)) lowest = std::min(lowest, static_cast<double>(post));
  }
  return lowest;
}

Terrain::Terrain(std::vector<Tile> tiles, Geoid geoid, double lowest_elsewhere_m)
    : geoid_(std::move(geoid)), lowest_elsewhere_m_(lowest_elsewhere_m) {
  if (tiles.empty()) throw InputError("terrain", "holds no terrain tile");
  std::stable_sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) {
    const double a_area = a.lat_step_deg * a.lon_step_deg;
    const double b_area = b.lat_step_deg * b.lon_step_deg;
    if (std::abs(a_area / b_area - 1) > 1e-9) return a_area < b_area;
    return a.name < b.name;
  });
  for (Tile& tile : tiles) tiles_.push_back({std::move(tile), {}});
  share_posts();
  summarise();
}

void Terrain::share_posts() {
  for (TerrainTile& entry : tiles_) share_own_posts(entry.tile);
  // Only tiles whose latitudes meet can share a post.
  std::vector<std::size_t> from_south(tiles_.size());
  std::iota(from_south.begin(), from_south.end(), std::size_t{0});
  std::sort(from_south.begin(), from_south.end(), [&](std::size_t a, std::size_t b) {
    return tiles_[a].tile.south_deg < tiles_[b].tile.south_deg;
  });
  // Taking the maximum pair by pair ends in the maximum over all tiles that hold a post, because
  // every pair of them is visited. Only a corner where steps differ can need a second round.
  for (int round = 0; round < 2; ++round) {
    for (auto one = from_south.begin(); one != from_south.end(); ++one) {
      const Tile& tile = tiles_[*one].tile;
      const double north = tile.north_deg() + tile.lat_step_deg;
      for (auto two = one + 1; two != from_south.end(); ++two) {
        if (tiles_[*two].tile.south_deg > north) break;
        share_posts_of(tiles_[std::max(*one, *two)].tile, tiles_[std::min(*one, *two)].tile);
      }
    }
  }
}

Terrain Terrain::load(const std::filesystem::path& folder, Geoid geoid,
                      const std::vector<Neighbourhood>& places,
                      const std::vector<DegreeCell>& coverage) {
  FolderTiles all;
  for (const std::filesystem::path& file : files_of(folder)) all.add_file(file, places);
  std::vector<DegreeCell> sea;
  std::copy_if(coverage.begin(), coverage.end(), std::back_inserter(sea),
               [&](const DegreeCell& cell) { return !all.has_file_for(cell); });
  const StepsPerDegree steps = finest_steps(all.grids);
  for (const DegreeCell& cell : sea) all.add_sea(cell, steps, places);
  // Far from every tile all ground is unknown; some tile must still say how large its cells are.
  const bool is_far_from_files = std::all_of(all.near.begin(), all.near.end(),
                                             [](const Tile& tile) { return tile.sea.has_value(); });
  if (is_far_from_files && all.elsewhere) all.near.push_back(std::move(*all.elsewhere));
  if (all.near.empty() && !sea.empty()) all.near.push_back(sea_tile(sea.front(), steps));
  if (all.near.empty() && !all.refused.empty()) throw InputError(all.refused.front());
  if (all.near.empty()) throw InputError(folder.string(), "folder holds no terrain tile");
  Terrain terrain(std::move(all.near), std::move(geoid), all.lowest_far_m);
  terrain.refused_ = std::move(all.refused);
  terrain.far_grids_ = std::move(all.far_grids);
  terrain.sea_cells_ = static_cast<int>(sea.size());
  terrain.ignored_sea_cells_ = static_cast<int>(coverage.size() - sea.size());
  return terrain;
}

}  // namespace ridgeline::oracle
