// What blocks of cells are summed up to, and how replaced posts change it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "tests/oracle/terrain.hpp"

namespace ridgeline::oracle {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// How far from a cell the blocks of some alignment reach, in cells.
constexpr int reach_cells = 127;

constexpr Block without_posts{infinity, -infinity, -infinity, false};
constexpr Block open_sea{0, 0, -infinity, false};

Block post_block(const Tile& tile, int row, int column) {
  Block block = without_posts;
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

/// Calls `take(row, column)` for the blocks on all sides of a post.
template <class Take>
void for_each_block_round(const Tile& tile, int row, int column, const Take& take) {
  for (int r = std::max(row - 1, 0); r <= std::min(row, tile.rows - 2); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column, tile.columns - 2); ++c) {
      take(r / block_cells, c / block_cells);
    }
  }
}

BlockLevel finest_level(const Tile& tile) {
  const int rows = (tile.rows - 2) / block_cells + 1;
  const int columns = (tile.columns - 2) / block_cells + 1;
  BlockLevel level = tile.sea ? BlockLevel::bordered(rows, columns, open_sea)
                              : BlockLevel::full(rows, columns, without_posts);
  const auto sum_up = [&](int row, int column) {
    level.set(row, column, post_block(tile, row, column));
  };
  level.for_each_held(sum_up);
  if (!tile.sea) return level;
  tile.sea->for_each_set_inside(
      [&](int row, int column) { for_each_block_round(tile, row, column, sum_up); });
  return level;
}

/// The four blocks of the next finer level in one.
Block joined(const BlockLevel& fine, int row, int column) {
  Block block = without_posts;
  for (int r = 2 * row; r < std::min(2 * row + 2, fine.rows()); ++r) {
    for (int c = 2 * column; c < std::min(2 * column + 2, fine.columns()); ++c) {
      const Block& part = fine.at(r, c);
      block.lowest_m = std::min(block.lowest_m, part.lowest_m);
      block.highest_m = std::max(block.highest_m, part.highest_m);
      block.must_below_m = std::max(block.must_below_m, part.must_below_m);
      block.has_unknown = block.has_unknown || part.has_unknown;
    }
  }
  return block;
}

BlockLevel coarser(const BlockLevel& fine) {
  const int rows = (fine.rows() + 1) / 2;
  const int columns = (fine.columns() + 1) / 2;
  BlockLevel level = fine.is_full() ? BlockLevel::full(rows, columns, without_posts)
                                    : BlockLevel::bordered(rows, columns, fine.inside());
  const auto join = [&](int row, int column) { level.set(row, column, joined(fine, row, column)); };
  level.for_each_held(join);
  fine.for_each_set_inside([&](int row, int column) { join(row / 2, column / 2); });
  return level;
}

void build_upper_levels(TerrainTile& entry) {
  entry.levels.resize(1, entry.levels.front());
  while (entry.levels.back().rows() > 1 || entry.levels.back().columns() > 1) {
    entry.levels.push_back(coarser(entry.levels.back()));
  }
}

double metres_east(const Tile& tile, int row) {
  const double lat = (tile.south_deg + row * tile.lat_step_deg) * degree_rad;
  return std::max(1e-3, tile.lon_step_deg * degree_rad * semi_minor_m * std::cos(lat));
}

/// The steepest rise per run from a post to its neighbours in the east and north.
double steepest_at(const Tile& tile, int row, int column, double east_m) {
  const double north_m = tile.lat_step_deg * degree_rad * semi_minor_m;
  const auto post = static_cast<double>(tile.at(row, column));
  const auto slope = [&](int r, int c, double run_m) {
    if (r >= tile.rows || c >= tile.columns) return 0.0;
    const double rise = std::abs(static_cast<double>(tile.at(r, c)) - post);
    return rise >= 0 ? rise / run_m : 0.0;  // NaN beside a void
  };
  return std::max(slope(row, column + 1, east_m), slope(row + 1, column, north_m));
}

/// The steepest rise per run from a post to its neighbours on all sides.
double steepest_round(const Tile& tile, int row, int column) {
  double steepest = steepest_at(tile, row, column, metres_east(tile, row));
  if (row > 0) {
    steepest = std::max(steepest, steepest_at(tile, row - 1, column, metres_east(tile, row - 1)));
  }
  if (column > 0) {
    steepest = std::max(steepest, steepest_at(tile, row, column - 1, metres_east(tile, row)));
  }
  return steepest;
}

double steepest_of(const Tile& tile) {
  double steepest = 0;
  if (tile.sea) {
    const auto look_round = [&](int row, int column) {
      steepest = std::max(steepest, steepest_round(tile, row, column));
    };
    tile.sea->for_each_held(look_round);
    tile.sea->for_each_set_inside(look_round);
    return steepest;
  }
  for (int row = 0; row < tile.rows; ++row) {
    const double east_m = metres_east(tile, row);
    for (int column = 0; column < tile.columns; ++column) {
      steepest = std::max(steepest, steepest_at(tile, row, column, east_m));
    }
  }
  return steepest;
}

/// How much N can differ inside a box, from samples; twice their spread covers what lies between.
double undulation_spread_m(const Geoid& geoid, const GeoBox& box) {
  if (geoid.is_none()) return 0;
  const double south = std::max(-90.0, box.south_deg);
  const double north = std::min(90.0, box.north_deg);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  constexpr int steps = 4;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const double n = geoid.at(south + (north - south) * i / steps,
                                box.west_deg + (box.east_deg - box.west_deg) * j / steps);
      low = std::min(low, n);
      high = std::max(high, n);
    }
  }
  return 2 * (high - low);
}

/// All that the blocks of some alignment hold round the cells of a box. Beyond a pole a block has
/// no place of its own; everything round the pole is taken then.
GeoBox widened(const GeoBox& box, double lat_step_deg, double lon_step_deg) {
  GeoBox wide{box.south_deg - reach_cells * lat_step_deg,
              box.north_deg + reach_cells * lat_step_deg, box.west_deg - reach_cells * lon_step_deg,
              box.east_deg + reach_cells * lon_step_deg};
  if (wide.north_deg > 90 || wide.south_deg < -90 || wide.east_deg - wide.west_deg > 300) {
    const double middle = 0.5 * (box.west_deg + box.east_deg);
    wide.west_deg = middle - 360;
    wide.east_deg = middle + 360;
  }
  return wide;
}

bool overlap(const GeoBox& a, const GeoBox& b) {
  const double a_middle = 0.5 * (a.west_deg + a.east_deg);
  const double b_middle = 0.5 * (b.west_deg + b.east_deg);
  const double turn = 360.0 * std::round((a_middle - b_middle) / 360.0);
  return a.south_deg <= b.north_deg && a.north_deg >= b.south_deg &&
         a.west_deg <= b.east_deg + turn && a.east_deg >= b.west_deg + turn;
}

/// The ground of a block, its last partial one cut at the edge of its tile.
GeoBox block_box(const Tile& tile, int row, int column, double tile_west_deg) {
  const double lat_side = block_cells * tile.lat_step_deg;
  const double lon_side = block_cells * tile.lon_step_deg;
  const double east = tile_west_deg + tile.east_deg() - tile.west_deg;
  const double south = tile.south_deg + row * lat_side;
  const double west = tile_west_deg + column * lon_side;
  return {south, std::min(south + lat_side, tile.north_deg()), west,
          std::min(west + lon_side, east)};
}

}  // namespace

void Terrain::summarise() {
  for (TerrainTile& entry : tiles_) {
    entry.levels = {finest_level(entry.tile)};
    steepest_ = std::max(steepest_, steepest_of(entry.tile));
  }
  lowest_post_m_ = std::numeric_limits<double>::quiet_NaN();  // so that all thresholds are new
  summarise_whole({});
}

void Terrain::summarise_whole(const std::vector<GeoBox>& changed) {
  float lowest = infinity;
  float highest = -infinity;
  for (TerrainTile& entry : tiles_) {
    build_upper_levels(entry);
    const Block& whole = entry.levels.back().at(0, 0);
    lowest = std::min(lowest, whole.lowest_m);
    highest = std::max(highest, whole.highest_m);
  }
  const double lowest_before = lowest_post_m_;
  lowest_post_m_ = std::min(static_cast<double>(lowest), lowest_elsewhere_m_);
  highest_post_m_ = static_cast<double>(highest);
  for (TerrainTile& entry : tiles_) {
    if (!entry.levels.back().at(0, 0).has_unknown) continue;
    set_thresholds(entry, lowest_post_m_ == lowest_before ? &changed : nullptr);
    build_upper_levels(entry);
  }
}

void Terrain::set_thresholds(TerrainTile& entry, const std::vector<GeoBox>* changed) {
  const Tile& tile = entry.tile;
  BlockLevel& level = entry.levels.front();
  const auto set_threshold = [&](int row, int column) {
    Block block = level.at(row, column);
    if (!block.has_unknown) return;
    const GeoBox box = block_box(tile, row, column, tile.west_deg);
    const GeoBox wide = widened(box, tile.lat_step_deg, tile.lon_step_deg);
    const bool is_new = changed == nullptr ||
                        std::any_of(changed->begin(), changed->end(),
                                    [&](const GeoBox& other) { return overlap(wide, other); });
    if (!is_new) return;
    block.must_below_m =
        static_cast<float>(must_below_m(box, tile.lat_step_deg, tile.lon_step_deg));
    level.set(row, column, block);
  };
  level.for_each_held(set_threshold);
  level.for_each_set_inside(set_threshold);
}

double Terrain::must_below_m(const GeoBox& box, double lat_step_deg, double lon_step_deg) const {
  const GeoBox wide = widened(box, lat_step_deg, lon_step_deg);
  const GeoBox shared{box.north_deg - 64 * lat_step_deg, box.south_deg + 64 * lat_step_deg,
                      box.east_deg - 64 * lon_step_deg, box.west_deg + 64 * lon_step_deg};
  double lowest = std::numeric_limits<double>::infinity();
  bool always_known = false;
  for (const TerrainTile& entry : tiles_) {
    const Tile& tile = entry.tile;
    const double tile_west = west_on_turn(tile, 0.5 * (box.west_deg + box.east_deg));
    const double lat_side = block_cells * tile.lat_step_deg;
    const double lon_side = block_cells * tile.lon_step_deg;
    const BlockLevel& level = entry.levels.front();
    if (wide.north_deg < tile.south_deg || wide.south_deg > tile.north_deg()) continue;
    if (wide.east_deg < tile_west || wide.west_deg > tile_west + tile.east_deg() - tile.west_deg) {
      continue;
    }
    const auto first = [](double value, int count) {
      return static_cast<int>(std::clamp(std::floor(value - 1e-6), 0.0, count - 1.0));
    };
    const auto last = [](double value, int count) {
      return static_cast<int>(std::clamp(std::floor(value + 1e-6), 0.0, count - 1.0));
    };
    const int r1 = last((wide.north_deg - tile.south_deg) / lat_side, level.rows());
    const int c0 = first((wide.west_deg - tile_west) / lon_side, level.columns());
    const int c1 = last((wide.east_deg - tile_west) / lon_side, level.columns());
    for (int row = first((wide.south_deg - tile.south_deg) / lat_side, level.rows()); row <= r1;
         ++row) {
      for (int column = c0; column <= c1; ++column) {
        const Block& block = level.at(row, column);
        if (block.lowest_m > block.highest_m) continue;
        lowest = std::min(lowest, static_cast<double>(block.lowest_m));
        const GeoBox of_block = block_box(tile, row, column, tile_west);
        always_known =
            always_known ||
            (of_block.south_deg > shared.south_deg && of_block.north_deg < shared.north_deg &&
             of_block.west_deg > shared.west_deg && of_block.east_deg < shared.east_deg);
      }
    }
  }
  if (!always_known) return lowest_post_m_;
  return lowest - undulation_spread_m(geoid_, wide);
}

void Terrain::summarise_changed(const std::vector<ReplacedPosts::Post>& posts) {
  std::set<std::tuple<std::size_t, int, int>> blocks;
  for (const ReplacedPosts::Post& post : posts) {
    const Tile& tile = tiles_[post.tile].tile;
    steepest_ = std::max(steepest_, steepest_round(tile, post.row, post.column));
    for_each_block_round(tile, post.row, post.column,
                         [&](int row, int column) { blocks.emplace(post.tile, row, column); });
  }
  std::vector<GeoBox> changed;
  for (const auto& [index, row, column] : blocks) {
    TerrainTile& entry = tiles_[index];
    BlockLevel& level = entry.levels.front();
    Block block = post_block(entry.tile, row, column);
    if (block.has_unknown) block.must_below_m = level.at(row, column).must_below_m;
    level.set(row, column, block);
    changed.push_back(block_box(entry.tile, row, column, entry.tile.west_deg));
  }
  summarise_whole(changed);
}

}  // namespace ridgeline::oracle
