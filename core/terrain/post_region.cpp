#include "core/terrain/post_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/assert.hpp"
#include "core/terrain/shared_posts.hpp"

namespace ridgeline {
namespace {

constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
constexpr int most_steps = 16;  ///< different steps among the tiles of one box
constexpr double step_tolerance = 1e-6;
/// A post that a tile has and does not know, as against NaN, which no tile has. Becomes NaN.
constexpr float tile_void = -std::numeric_limits<float>::infinity();

/// A tile laid over a box: which of its posts are wanted, and where they go.
struct Overlay {
  const HeightTile& tile;
  AxisFit rows, columns;
  std::int32_t row0 = 0, row1 = -1, column0 = 0, column1 = -1;  ///< lattice posts, both included
  std::int32_t last_row = 0, last_column = 0;                   ///< of the tile on the lattice
};

/// How the posts of one tile come to posts that tiles before it have set.
struct Merge {
  bool over_coarser = false;  ///< coarser tiles came before: inside its edge this one is the truth
  double apart_m = 0;         ///< largest difference between two known heights of one post
  bool half_known = false;    ///< one of them was void and the other known

  /// `inside`: not on the tile's own edge. Whether the post is now the value.
  bool put(float& post, float value, bool inside) {
    if ((over_coarser && inside) || std::isnan(post)) {
      post = std::isnan(value) ? tile_void : value;
      return true;
    }
    if (std::isnan(value) || post == tile_void) {
      half_known = half_known || std::isnan(value) != (post == tile_void);
      if (std::isnan(value)) return false;
      post = value;
      return true;
    }
    if (value == post) return false;
    apart_m = std::max(apart_m, static_cast<double>(std::abs(value - post)));
    if (value < post) return false;
    post = value;
    return true;
  }
};

/// The posts of a region and, where wanted, what rounding took from each of them.
struct Posts {
  std::span<float> heights_m;
  std::span<float> rests_m;  ///< as many, or none

  void put(std::size_t k, double value_m, bool inside, Merge& merge) const {
    const auto rounded = static_cast<float>(value_m);
    if (!merge.put(heights_m[k], rounded, inside) || rests_m.empty()) return;
    rests_m[k] = static_cast<float>(value_m - static_cast<double>(rounded));
  }
  void add(std::size_t k, double more_m) const {
    const double rest = rests_m.empty() ? 0.0 : static_cast<double>(rests_m[k]);
    const double exact = static_cast<double>(heights_m[k]) + (rest + more_m);
    heights_m[k] = static_cast<float>(exact);
    if (!rests_m.empty()) {
      rests_m[k] = static_cast<float>(exact - static_cast<double>(heights_m[k]));
    }
  }
};

double cell_size(const HeightTile& tile) {
  return tile.grid.latitude_step_deg * tile.grid.longitude_step_deg;
}

/// The largest cells below a size; 0 when there are none.
double next_step(std::span<const HeightTile> tiles, double below) {
  double next = 0;
  for (const HeightTile& tile : tiles) {
    const double own = cell_size(tile);
    if (own < below * (1 - step_tolerance)) next = std::max(next, own);
  }
  return next;
}

bool lay(const PostLattice& lattice, const PostBox& box, Overlay& o) {
  o.rows = fit_rows(lattice, o.tile.grid);
  o.columns = fit_columns(lattice, o.tile.grid, box.column + 0.5 * box.columns);
  if (o.rows.ratio == 0 || o.columns.ratio == 0) return false;
  o.last_row = o.rows.first + (o.tile.grid.rows - 1) * o.rows.ratio;
  o.last_column = o.columns.first + (o.tile.grid.columns - 1) * o.columns.ratio;
  o.row0 = std::max(box.row, o.rows.first);
  o.row1 = std::min(box.row + box.rows - 1, o.last_row);
  o.column0 = std::max(box.column, o.columns.first);
  o.column1 = std::min(box.column + box.columns - 1, o.last_column);
  return true;
}

/// Merges one lattice row; `lower` and `upper` hold tile posts from tile column `first` on.
void merge_row(const Overlay& o, int first, std::span<const float> lower,
               std::span<const float> upper, double weight, bool edge_row, Merge& merge,
               const Posts& posts, std::size_t start) {
  const int ratio = o.columns.ratio;
  int k = (o.column0 - o.columns.first) / ratio - first;
  int part = (o.column0 - o.columns.first) % ratio;
  const auto blended = [&](int index) {
    const auto a = static_cast<double>(lower[static_cast<std::size_t>(index)]);
    if (weight == 0.0) return a;
    return a + weight * (static_cast<double>(upper[static_cast<std::size_t>(index)]) - a);
  };
  for (std::int32_t column = o.column0; column <= o.column1; ++column) {
    double value = blended(k);
    if (part != 0) value += static_cast<double>(part) / ratio * (blended(k + 1) - value);
    const bool inside = !edge_row && column != o.columns.first && column != o.last_column;
    posts.put(start + static_cast<std::size_t>(column - o.column0), value, inside, merge);
    if (++part == ratio) {
      part = 0;
      ++k;
    }
  }
}

void merge_tile(const TerrainSource& source, const PostBox& box, const Overlay& o, Merge& merge,
                const Posts& posts, std::span<float> scratch) {
  const int first = (o.column0 - o.columns.first) / o.columns.ratio;
  const int last = (o.column1 - o.columns.first + o.columns.ratio - 1) / o.columns.ratio;
  const auto count = static_cast<std::size_t>(last - first + 1);
  std::span<float> lower = scratch.first(count), upper = scratch.subspan(count, count);
  int lower_row = -1, upper_row = -1;
  for (std::int32_t r = o.row0; r <= o.row1; ++r) {
    const int k = (r - o.rows.first) / o.rows.ratio, part = (r - o.rows.first) % o.rows.ratio;
    if (k == upper_row) {
      std::swap(lower, upper);
      std::swap(lower_row, upper_row);
    }
    if (k != lower_row) read_shared_posts(source, o.tile, k, first, lower);
    lower_row = k;
    if (part != 0 && k + 1 != upper_row) {
      read_shared_posts(source, o.tile, k + 1, first, upper);
      upper_row = k + 1;
    }
    const bool edge_row = r == o.rows.first || r == o.last_row;
    const auto start =
        static_cast<std::size_t>(r - box.row) * static_cast<std::size_t>(box.columns) +
        static_cast<std::size_t>(o.column0 - box.column);
    merge_row(o, first, lower, upper, static_cast<double>(part) / o.rows.ratio, edge_row, merge,
              posts, start);
  }
}

void add_undulation(const TerrainSource& source, const PostBox& box, int stride,
                    const Posts& posts) {
  const GeoidLookup& geoid = source.geoid;
  if (geoid.undulation_m == nullptr) return;
  const auto at = [&](std::int32_t column, std::int32_t row) {
    const double latitude = std::clamp(source.lattice.latitude_deg(row), -90.0, 90.0);
    return geoid.undulation_m(geoid.context, latitude, source.lattice.longitude_deg(column));
  };
  for (int r0 = 0; r0 < box.rows; r0 += stride) {
    for (int c0 = 0; c0 < box.columns; c0 += stride) {
      const std::int32_t row = box.row + r0, column = box.column + c0;
      const double sw = at(column, row), se = stride > 1 ? at(column + stride, row) : sw;
      const double nw = stride > 1 ? at(column, row + stride) : sw;
      const double ne = stride > 1 ? at(column + stride, row + stride) : sw;
      for (int r = r0; r < std::min(r0 + stride, box.rows); ++r) {
        const double y = static_cast<double>(r - r0) / stride;
        for (int c = c0; c < std::min(c0 + stride, box.columns); ++c) {
          const double x = static_cast<double>(c - c0) / stride;
          const double n = (sw * (1 - x) + se * x) * (1 - y) + (nw * (1 - x) + ne * x) * y;
          posts.add(static_cast<std::size_t>(r) * static_cast<std::size_t>(box.columns) +
                        static_cast<std::size_t>(c),
                    n);
        }
      }
    }
  }
}

}  // namespace

namespace {

/// Latitudes and longitudes of a box in a polar chart, rounded outwards.
GeoBox polar_geo_box(const PostLattice& lattice, const PostBox& box) {
  constexpr double slack_deg = 1e-9;
  const double west = box.column, east = box.column + box.columns - 1;
  const double south = box.row, north = box.row + box.rows - 1;
  const double farthest = std::hypot(std::max(std::abs(west), std::abs(east)),
                                     std::max(std::abs(south), std::abs(north)));
  const double nearest = std::hypot(std::max({0.0, west, -east}), std::max({0.0, south, -north}));
  const double far_deg = std::min(farthest * lattice.latitude_step_deg + slack_deg, 180.0);
  const double near_deg = std::max(nearest * lattice.latitude_step_deg - slack_deg, 0.0);
  GeoBox result;
  const bool at_north = lattice.chart == Chart::north_polar;
  result.south_deg = at_north ? 90.0 - far_deg : near_deg - 90.0;
  result.north_deg = at_north ? 90.0 - near_deg : far_deg - 90.0;
  if (near_deg <= 0.0) {
    result.west_deg = -180.0;
    result.east_deg = 180.0;
    return result;
  }
  const double middle = lattice.place_of(0.5 * (west + east), 0.5 * (south + north)).longitude_deg;
  double half = 0;
  for (const double column : {west, east}) {
    for (const double row : {south, north}) {
      const double longitude = lattice.place_of(column, row).longitude_deg;
      half = std::max(half, std::abs(std::remainder(longitude - middle, 360.0)));
    }
  }
  result.west_deg = middle - half - slack_deg;
  result.east_deg = middle + half + slack_deg;
  return result;
}

}  // namespace

GeoBox geo_box(const PostLattice& lattice, const PostBox& box) {
  if (lattice.polar()) return polar_geo_box(lattice, box);
  GeoBox result;
  result.south_deg = lattice.latitude_deg(box.row);
  result.west_deg = lattice.longitude_deg(box.column);
  result.north_deg = lattice.latitude_deg(box.row + box.rows - 1);
  result.east_deg = lattice.longitude_deg(box.column + box.columns - 1);
  return result;
}

RegionFacts read_region(const TerrainSource& source, const PostBox& box, int geoid_stride,
                        std::span<float> posts, std::span<float> scratch, std::span<float> rests) {
  RL_ASSERT(!source.lattice.polar());
  RL_ASSERT(rests.empty() || rests.size() == posts.size());
  RL_ASSERT(posts.size() ==
            static_cast<std::size_t>(box.rows) * static_cast<std::size_t>(box.columns));
  RL_ASSERT(scratch.size() >= 4 * static_cast<std::size_t>(box.columns) + 8);
  RegionFacts facts;
  std::fill(posts.begin(), posts.end(), nan_f);
  std::fill(rests.begin(), rests.end(), 0.0F);
  const Posts region{posts, rests};
  const GeoBox place = geo_box(source.lattice, box);
  // Coarsest tiles first, so that each finer one has the last word; within a step, file order.
  double step = std::numeric_limits<double>::infinity();
  bool interpolated = false;
  for (int turn = 0; turn < most_steps; ++turn) {
    step = next_step(source.tiles, step);
    if (step == 0) break;
    const bool over_coarser = facts.tiles > 0;
    for (const HeightTile& tile : source.tiles) {
      const double own = cell_size(tile);
      if (std::abs(own - step) > step_tolerance * step || !overlaps(place, tile.grid)) continue;
      Overlay overlay{tile, {}, {}};
      if (!lay(source.lattice, box, overlay)) {
        ++facts.mismatched_tiles;
        continue;
      }
      if (overlay.row0 > overlay.row1 || overlay.column0 > overlay.column1) continue;
      ++facts.tiles;
      interpolated = interpolated || overlay.rows.ratio > 1 || overlay.columns.ratio > 1;
      Merge merge{over_coarser};
      merge_tile(source, box, overlay, merge, region, scratch);
      // Posts that coincide agree by now. Where one side of an edge is interpolated between coarser
      // posts, the truth has two sides and this region only one.
      if (!interpolated) continue;
      facts.seam_m = std::max(facts.seam_m, merge.apart_m);
      facts.seam_void = facts.seam_void || merge.half_known;
    }
  }
  std::replace(posts.begin(), posts.end(), tile_void, nan_f);
  add_undulation(source, box, geoid_stride, region);
  return facts;
}

}  // namespace ridgeline
