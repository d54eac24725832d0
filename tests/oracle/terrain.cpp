#include "tests/oracle/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/oracle/input_error.hpp"
#include "tests/oracle/tile_files.hpp"

namespace ridgeline::oracle {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Posts count as the same where they are this close, in steps.
constexpr double same_post_steps = 1e-3;

bool same_steps(const Tile& a, const Tile& b) {
  return std::abs(a.lat_step_deg / b.lat_step_deg - 1) < 1e-9 &&
         std::abs(a.lon_step_deg / b.lon_step_deg - 1) < 1e-9;
}

/// The index of `value` in a row of posts, or -1 where no post stands there.
int post_index(double value, double first, double step, int count) {
  const double index = (value - first) / step;
  const double nearest = std::round(index);
  if (std::abs(index - nearest) > same_post_steps || nearest < 0 || nearest > count - 1) return -1;
  return static_cast<int>(nearest);
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
      a.at(row, column) = height;
      b.at(b_row, b_column) = height;
    }
  }
}

Block post_block(const Tile& tile, int row, int column) {
  Block block{infinity, -infinity, -infinity, false};
  const int last_row = std::min((row + 1) * block_cells, tile.rows - 1);
  const int last_column = std::min((column + 1) * block_cells, tile.columns - 1);
  for (int r = row * block_cells; r <= last_row; ++r) {
    for (int c = column * block_cells; c <= last_column; ++c) {
      const float post = tile.at(r, c);
      if (std::isnan(post)) {
        block.has_unknown = true;
        continue;
      }
      block.lowest_m = std::min(block.lowest_m, post);
      block.highest_m = std::max(block.highest_m, post);
    }
  }
  return block;
}

/// The steepest rise per run between neighbouring posts of a tile.
double steepest_of(const Tile& tile) {
  double steepest = 0;
  const double north_m = tile.lat_step_deg * degree_rad * semi_minor_m;
  const auto take = [&](float rise, double run_m) {
    if (!std::isnan(rise))
      steepest = std::max(steepest, std::abs(static_cast<double>(rise)) / run_m);
  };
  for (int row = 0; row < tile.rows; ++row) {
    const double lat = (tile.south_deg + row * tile.lat_step_deg) * degree_rad;
    const double east_m =
        std::max(1e-3, tile.lon_step_deg * degree_rad * semi_minor_m * std::cos(lat));
    for (int column = 0; column < tile.columns; ++column) {
      const float post = tile.at(row, column);
      if (column + 1 < tile.columns) take(tile.at(row, column + 1) - post, east_m);
      if (row + 1 < tile.rows) take(tile.at(row + 1, column) - post, north_m);
    }
  }
  return steepest;
}

BlockLevel coarser(const BlockLevel& fine) {
  BlockLevel level{(fine.rows + 1) / 2, (fine.columns + 1) / 2, {}};
  for (int row = 0; row < level.rows; ++row) {
    for (int column = 0; column < level.columns; ++column) {
      Block block{infinity, -infinity, -infinity, false};
      for (int r = 2 * row; r < std::min(2 * row + 2, fine.rows); ++r) {
        for (int c = 2 * column; c < std::min(2 * column + 2, fine.columns); ++c) {
          const Block& part = fine.at(r, c);
          block.lowest_m = std::min(block.lowest_m, part.lowest_m);
          block.highest_m = std::max(block.highest_m, part.highest_m);
          block.must_below_m = std::max(block.must_below_m, part.must_below_m);
          block.has_unknown = block.has_unknown || part.has_unknown;
        }
      }
      level.blocks.push_back(block);
    }
  }
  return level;
}

/// How much N can differ inside a box, from samples; twice their spread covers what lies between.
double undulation_spread_m(const Geoid& geoid, double south, double north, double west,
                           double east) {
  if (geoid.is_none()) return 0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  constexpr int steps = 4;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const double n =
          geoid.at(south + (north - south) * i / steps, west + (east - west) * j / steps);
      low = std::min(low, n);
      high = std::max(high, n);
    }
  }
  return 2 * (high - low);
}

bool is_near(const Tile& tile, const std::vector<Neighbourhood>& places) {
  return places.empty() ||
         std::any_of(places.begin(), places.end(), [&](const Neighbourhood& place) {
           const double reach_deg = place.radius_m / 110000.0;
           const double lat = std::min(89.0, std::abs(place.lat_deg) + reach_deg);
           const double lon_reach_deg = reach_deg / std::cos(lat * degree_rad);
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

}  // namespace

double west_on_turn(const Tile& tile, double near_deg) {
  const double middle = 0.5 * (tile.west_deg + tile.east_deg());
  return tile.west_deg + 360.0 * std::round((near_deg - middle) / 360.0);
}

Terrain::Terrain(std::vector<Tile> tiles, Geoid geoid, double lowest_elsewhere_m)
    : geoid_(std::move(geoid)) {
  if (tiles.empty()) throw InputError("terrain", "holds no terrain tile");
  std::stable_sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) {
    const double a_area = a.lat_step_deg * a.lon_step_deg;
    const double b_area = b.lat_step_deg * b.lon_step_deg;
    if (std::abs(a_area / b_area - 1) > 1e-9) return a_area < b_area;
    return a.name < b.name;
  });
  for (Tile& tile : tiles) tiles_.push_back({std::move(tile), {}});
  share_posts();
  summarise(lowest_elsewhere_m);
}

void Terrain::share_posts() {
  // Taking the maximum pair by pair ends in the maximum over all tiles that hold a post, because
  // every pair of them is visited. Only a corner where steps differ can need a second round.
  for (int round = 0; round < 2; ++round) {
    for (std::size_t fine = 0; fine < tiles_.size(); ++fine) {
      for (std::size_t other = fine + 1; other < tiles_.size(); ++other) {
        share_posts_of(tiles_[other].tile, tiles_[fine].tile);
      }
    }
  }
}

void Terrain::summarise(double lowest_elsewhere_m) {
  float lowest = infinity;
  float highest = -infinity;
  for (TerrainTile& entry : tiles_) {
    const Tile& tile = entry.tile;
    BlockLevel level{(tile.rows - 2) / block_cells + 1, (tile.columns - 2) / block_cells + 1, {}};
    for (int row = 0; row < level.rows; ++row) {
      for (int column = 0; column < level.columns; ++column) {
        level.blocks.push_back(post_block(tile, row, column));
        lowest = std::min(lowest, level.blocks.back().lowest_m);
        highest = std::max(highest, level.blocks.back().highest_m);
      }
    }
    entry.levels = {std::move(level)};
    steepest_ = std::max(steepest_, steepest_of(tile));
  }
  lowest_post_m_ = std::min(static_cast<double>(lowest), lowest_elsewhere_m);
  highest_post_m_ = static_cast<double>(highest);
  for (TerrainTile& entry : tiles_) {
    const Tile& tile = entry.tile;
    BlockLevel& level = entry.levels.front();
    for (int row = 0; row < level.rows; ++row) {
      for (int column = 0; column < level.columns; ++column) {
        Block& block =
            level.blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                         static_cast<std::size_t>(column)];
        if (!block.has_unknown) continue;
        const double south = tile.south_deg + row * block_cells * tile.lat_step_deg;
        const double west = tile.west_deg + column * block_cells * tile.lon_step_deg;
        block.must_below_m = static_cast<float>(must_below_m(
            south, south + block_cells * tile.lat_step_deg, west,
            west + block_cells * tile.lon_step_deg, tile.lat_step_deg, tile.lon_step_deg));
      }
    }
    while (entry.levels.back().rows > 1 || entry.levels.back().columns > 1) {
      entry.levels.push_back(coarser(entry.levels.back()));
    }
  }
}

double Terrain::must_below_m(double south_deg, double north_deg, double west_deg, double east_deg,
                             double lat_step_deg, double lon_step_deg) const {
  const double south = south_deg - 127 * lat_step_deg;
  const double north = north_deg + 127 * lat_step_deg;
  const double west = west_deg - 127 * lon_step_deg;
  const double east = east_deg + 127 * lon_step_deg;
  const double shared_south = north_deg - 64 * lat_step_deg;
  const double shared_north = south_deg + 64 * lat_step_deg;
  const double shared_west = east_deg - 64 * lon_step_deg;
  const double shared_east = west_deg + 64 * lon_step_deg;
  double lowest = std::numeric_limits<double>::infinity();
  bool always_known = false;
  for (const TerrainTile& entry : tiles_) {
    const Tile& tile = entry.tile;
    const double tile_west = west_on_turn(tile, 0.5 * (west + east));
    const double lat_side = block_cells * tile.lat_step_deg;
    const double lon_side = block_cells * tile.lon_step_deg;
    const BlockLevel& level = entry.levels.front();
    const auto index = [](double value, int count) {
      return static_cast<int>(std::clamp(std::floor(value), -1.0, static_cast<double>(count)));
    };
    const int r0 = std::max(0, index((south - tile.south_deg) / lat_side - 1e-6, level.rows));
    const int r1 =
        std::min(level.rows - 1, index((north - tile.south_deg) / lat_side + 1e-6, level.rows));
    const int c0 = std::max(0, index((west - tile_west) / lon_side - 1e-6, level.columns));
    const int c1 =
        std::min(level.columns - 1, index((east - tile_west) / lon_side + 1e-6, level.columns));
    for (int row = r0; row <= r1; ++row) {
      for (int column = c0; column <= c1; ++column) {
        const Block& block = level.at(row, column);
        if (block.lowest_m > block.highest_m) continue;
        lowest = std::min(lowest, static_cast<double>(block.lowest_m));
        const double block_south = tile.south_deg + row * lat_side;
        const double block_west = tile_west + column * lon_side;
        always_known =
            always_known || (block_south > shared_south && block_south + lat_side < shared_north &&
                             block_west > shared_west && block_west + lon_side < shared_east);
      }
    }
  }
  if (!always_known) return lowest_post_m_;
  return lowest - undulation_spread_m(geoid_, south, north, west, east);
}

Terrain Terrain::load(const std::filesystem::path& folder, Geoid geoid,
                      const std::vector<Neighbourhood>& places) {
  std::vector<Tile> near;
  std::optional<Tile> elsewhere;
  std::vector<std::string> refused;
  float lowest = infinity;
  for (const std::filesystem::path& file : files_of(folder)) {
    std::optional<Tile> tile;
    try {
      tile = read_tile(file);
    } catch (const InputError& error) {
      refused.emplace_back(error.what());
    }
    if (!tile) continue;
    for (const float post : tile->posts) {
      lowest = std::isnan(post) ? lowest : std::min(lowest, post);
    }
    if (is_near(*tile, places)) {
      near.push_back(std::move(*tile));
    } else if (!elsewhere) {
      elsewhere = std::move(tile);
    }
  }
  // Far from every tile all ground is unknown; some tile must still say how large its cells are.
  if (near.empty() && elsewhere) near.push_back(std::move(*elsewhere));
  if (near.empty() && !refused.empty()) throw InputError(refused.front());
  if (near.empty()) throw InputError(folder.string(), "folder holds no terrain tile");
  Terrain terrain(std::move(near), std::move(geoid), static_cast<double>(lowest));
  terrain.refused_ = std::move(refused);
  return terrain;
}

}  // namespace ridgeline::oracle
