#include "core/terrain/terrain_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
constexpr double step_tolerance = 1e-7;   ///< relative difference of two steps that are the same
constexpr double phase_tolerance = 1e-4;  ///< posts; 1 cm at 3 arc seconds
constexpr int block_posts = 64;
constexpr int max_blocks = limits::max_window_posts / block_posts;

/// How one axis of a tile lies on the window: post k of the tile is window post first + k * ratio.
struct AxisFit {
  int first = 0;
  int ratio = 0;  ///< 0: does not fit
};

AxisFit fit_axis(double window_start, double window_step, double tile_start, double tile_step) {
  const double ratio = tile_step / window_step;
  const double whole = std::round(ratio);
  if (whole < 1 || std::abs(ratio - whole) > step_tolerance * ratio) return {};
  const double first = (tile_start - window_start) / window_step;
  if (std::abs(first - std::round(first)) > phase_tolerance) return {};
  return {static_cast<int>(std::round(first)), static_cast<int>(whole)};
}

void merge_post(float& post, float value) {
  if (std::isnan(value)) return;
  if (std::isnan(post) || value > post) post = value;
}

/// One row of the window from two rows of a tile; `upper` equals `lower` on a row of posts.
void merge_row(std::span<float> row, AxisFit columns, std::span<const float> lower,
               std::span<const float> upper, float weight, int tile_column) {
  for (std::size_t c = 0; c < row.size(); ++c) {
    const int offset = tile_column + static_cast<int>(c);
    const int k = offset / columns.ratio, part = offset % columns.ratio;
    const int first = tile_column / columns.ratio;
    const float fx = static_cast<float>(part) / static_cast<float>(columns.ratio);
    const auto at = [&](std::span<const float> source) {
      const float a = source[k - first];
      return part == 0 ? a : a + fx * (source[k - first + 1] - a);
    };
    merge_post(row[c], weight == 0.0f ? at(lower) : at(lower) + weight * (at(upper) - at(lower)));
  }
}

/// Copies one tile into the window; heights still above the tile's datum.
bool merge_tile(const WindowGrid& grid, const HeightTile& tile, std::span<float> posts,
                std::span<float> scratch) {
  const PostGrid& t = tile.grid;
  const AxisFit rows =
      fit_axis(grid.south_deg, grid.latitude_step_deg, t.south_deg, t.latitude_step_deg);
  double west = t.west_deg;  // the copy of the tile that overlaps the window
  while (west > grid.longitude_deg(grid.columns - 1)) west -= 360.0;
  while (west + 360.0 <= grid.longitude_deg(grid.columns - 1)) west += 360.0;
  while (west + (t.columns - 1) * t.longitude_step_deg < grid.west_deg) west += 360.0;
  const AxisFit columns =
      fit_axis(grid.west_deg, grid.longitude_step_deg, west, t.longitude_step_deg);
  if (rows.ratio == 0 || columns.ratio == 0) return false;
  const int row_end = std::min(grid.rows - 1, rows.first + (t.rows - 1) * rows.ratio);
  const int column0 = std::max(0, columns.first);
  const int column1 = std::min(grid.columns - 1, columns.first + (t.columns - 1) * columns.ratio);
  if (column0 > column1) return true;
  const int tile_column = column0 - columns.first;
  const int first = tile_column / columns.ratio;
  const int last = (column1 - columns.first + columns.ratio - 1) / columns.ratio;
  const auto count = static_cast<std::size_t>(last - first + 1);
  std::span<float> lower = scratch.subspan(0, count), upper = scratch.subspan(count, count);
  for (int r = std::max(0, rows.first); r <= row_end; ++r) {
    const int k = (r - rows.first) / rows.ratio, part = (r - rows.first) % rows.ratio;
    read_posts(tile, k, first, lower);
    if (part != 0) read_posts(tile, k + 1, first, upper);
    const float weight = static_cast<float>(part) / static_cast<float>(rows.ratio);
    const auto start = static_cast<std::size_t>(r) * grid.columns + column0;
    merge_row(posts.subspan(start, column1 - column0 + 1), columns, lower, upper, weight,
              tile_column);
  }
  return true;
}

/// Lowest and highest known post of each 64 x 64 block, relative to the base.
struct Blocks {
  std::array<float, max_blocks * max_blocks> lowest, highest;
  int columns = 0, rows = 0;
};
Blocks blocks;  // one window at a time; 128 KiB that need not be on the stack

void measure_blocks(const WindowGrid& grid, std::span<const float> posts, WindowSummary& summary) {
  blocks.columns = grid.columns / block_posts;
  blocks.rows = grid.rows / block_posts;
  float lowest = 1e9f, highest = -1e9f;
  for (int by = 0; by < blocks.rows; ++by) {
    for (int bx = 0; bx < blocks.columns; ++bx) {
      float low = 1e9f, high = -1e9f;
      for (int y = by * block_posts; y < (by + 1) * block_posts; ++y) {
        const float* row = &posts[static_cast<std::size_t>(y) * grid.columns + bx * block_posts];
        for (int x = 0; x < block_posts; ++x) {
          if (std::isnan(row[x])) continue;
          low = std::min(low, row[x]);
          high = std::max(high, row[x]);
          ++summary.known_posts;
        }
      }
      blocks.lowest[by * blocks.columns + bx] = low;
      blocks.highest[by * blocks.columns + bx] = high;
      lowest = std::min(lowest, low);
      highest = std::max(highest, high);
    }
  }
  summary.lowest_m = static_cast<double>(lowest);
  summary.highest_m = static_cast<double>(highest);
}

constexpr float none_known = -1e9f;

/// Highest known posts of the aligned blocks of 8, 16 and 32 posts inside one block of 64.
struct LocalHighest {
  std::array<std::array<float, 64>, 3> of{};  ///< by size; row-major, 8 x 8, 4 x 4, 2 x 2 of them
};

LocalHighest local_highest(const WindowGrid& grid, std::span<const float> posts, int bx, int by) {
  LocalHighest local;
  for (auto& blocks_of_size : local.of) blocks_of_size.fill(none_known);
  for (int y = 0; y < block_posts; ++y) {
    const auto row = static_cast<std::size_t>(by * block_posts + y) * grid.columns;
    for (int x = 0; x < block_posts; ++x) {
      const float h = posts[row + static_cast<std::size_t>(bx) * block_posts + x];
      if (std::isnan(h)) continue;
      for (int k = 0; k < 3; ++k) {
        float& highest = local.of[k][(y >> (3 + k)) * (8 >> k) + (x >> (3 + k))];
        highest = std::max(highest, h);
      }
    }
  }
  return local;
}

/// The floor of a block without a known post; see the comment at void_offset_m.
float bare_floor(int bx, int by, float far_floor) {
  float highest = none_known;
  for (int y = std::max(0, by - 2); y <= std::min(blocks.rows - 1, by + 2); ++y) {
    for (int x = std::max(0, bx - 2); x <= std::min(blocks.columns - 1, bx + 2); ++x) {
      highest = std::max(highest, blocks.highest[y * blocks.columns + x]);
    }
  }
  return highest > none_known ? highest : far_floor;
}

void mark_block(const WindowGrid& grid, int bx, int by, float far_floor, std::span<float> posts,
                WindowSummary& summary) {
  const float own = blocks.highest[by * blocks.columns + bx];
  const bool bare = !(own > none_known);
  const float outer = bare ? bare_floor(bx, by, far_floor) : own;
  const LocalHighest local = bare ? LocalHighest{} : local_highest(grid, posts, bx, by);
  for (int y = 0; y < block_posts; ++y) {
    const auto row = static_cast<std::size_t>(by * block_posts + y) * grid.columns;
    for (int x = 0; x < block_posts; ++x) {
      float& post = posts[row + static_cast<std::size_t>(bx) * block_posts + x];
      if (!std::isnan(post)) continue;
      float floor = none_known;
      for (int k = 0; k < 3 && !bare && !(floor > none_known); ++k) {
        floor = local.of[k][(y >> (3 + k)) * (8 >> k) + (x >> (3 + k))];
      }
      post = (floor > none_known ? floor : outer) - void_offset_m;
      ++summary.void_posts;
    }
  }
}

void mark_void_posts(const WindowGrid& grid, float far_floor, std::span<float> posts,
                     WindowSummary& summary) {
  for (int by = 0; by < blocks.rows; ++by) {
    for (int bx = 0; bx < blocks.columns; ++bx) {
      mark_block(grid, bx, by, far_floor, posts, summary);
    }
  }
}

}  // namespace

WindowGrid window_grid_at(double latitude_deg, double longitude_deg, double latitude_step_deg,
                          double longitude_step_deg, double phase_latitude_deg,
                          double phase_longitude_deg, int columns, int rows) {
  WindowGrid grid{0, 0, latitude_step_deg, longitude_step_deg, columns, rows};
  const auto start = [](double centre, double phase, double step, int count) {
    // Aligned to 64 posts, so that a small move of the eye does not shift every block.
    const double post = std::round((centre - phase) / step / block_posts) * block_posts;
    return phase + (post - count / 2) * step;
  };
  grid.south_deg = start(latitude_deg, phase_latitude_deg, latitude_step_deg, rows);
  grid.west_deg = start(longitude_deg, phase_longitude_deg, longitude_step_deg, columns);
  return grid;
}

GeoBox window_box(const WindowGrid& grid, int margin_posts) {
  return {grid.latitude_deg(margin_posts), grid.longitude_deg(margin_posts),
          grid.latitude_deg(grid.rows - 1 - margin_posts),
          grid.longitude_deg(grid.columns - 1 - margin_posts)};
}

GeoBox range_box(double latitude_deg, double longitude_deg, double range_m) {
  constexpr double deg = std::numbers::pi / 180.0;
  constexpr double smallest_radius_m = 6'335'000.0;  // meridian radius at the equator
  const double angle = 1.01 * range_m / smallest_radius_m;
  const double ratio = std::sin(angle) / std::cos(latitude_deg * deg);
  const double half_longitude = ratio < 1.0 ? std::asin(ratio) / deg : 180.0;
  return {latitude_deg - angle / deg, longitude_deg - half_longitude, latitude_deg + angle / deg,
          longitude_deg + half_longitude};
}

WindowSummary fill_window(const WindowGrid& grid, std::span<const HeightTile> tiles,
                          const GeoidLookup& geoid, double base_height_m, std::span<float> posts,
                          std::span<float> scratch) {
  RL_ASSERT(posts.size() == static_cast<std::size_t>(grid.rows) * grid.columns);
  RL_ASSERT(grid.columns <= limits::max_window_posts && grid.rows <= limits::max_window_posts);
  WindowSummary summary;
  std::fill(posts.begin(), posts.end(), nan_f);
  for (const HeightTile& tile : tiles) {
    if (merge_tile(grid, tile, posts, scratch)) {
      ++summary.tiles_used;
    } else {
      ++summary.tiles_mismatched;
    }
  }
  for (int r = 0; r < grid.rows; ++r) {
    float* row = &posts[static_cast<std::size_t>(r) * grid.columns];
    for (int c = 0; c < grid.columns; ++c) {
      if (std::isnan(row[c])) continue;
      const double undulation =
          geoid.undulation_m == nullptr
              ? 0.0
              : geoid.undulation_m(geoid.context, grid.latitude_deg(r), grid.longitude_deg(c));
      row[c] = static_cast<float>(static_cast<double>(row[c]) + undulation - base_height_m);
    }
  }
  measure_blocks(grid, posts, summary);
  if (summary.known_posts == 0) return summary;
  const double far_floor = summary.lowest_m + far_floor_m;
  mark_void_posts(grid, static_cast<float>(far_floor), posts, summary);
  summary.highest_m = std::max(summary.highest_m, far_floor) + base_height_m;
  summary.lowest_m += base_height_m;
  return summary;
}

double window_height_m(const WindowGrid& grid, std::span<const float> posts, double latitude_deg,
                       double longitude_deg) {
  double east = longitude_deg - grid.west_deg;
  east -= 360.0 * std::floor(east / 360.0);
  const double x = east / grid.longitude_step_deg;
  const double y = (latitude_deg - grid.south_deg) / grid.latitude_step_deg;
  if (!(x >= 0 && y >= 0 && x < grid.columns - 1 && y < grid.rows - 1)) return nan;
  const auto column = static_cast<int>(x), row = static_cast<int>(y);
  const auto at = [&](int dx, int dy) {
    const float h = posts[static_cast<std::size_t>(row + dy) * grid.columns + column + dx];
    return h < void_threshold_m || std::isnan(h) ? nan : static_cast<double>(h);
  };
  const double fx = x - column, fy = y - row;
  return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
         fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
}

}  // namespace ridgeline
