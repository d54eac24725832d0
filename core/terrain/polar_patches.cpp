#include "core/terrain/polar_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/fixed_vector.hpp"
#include "core/terrain/post_index.hpp"

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double slack_cells = 1e-6;  ///< rounding of places
constexpr double outside_deg = 1e-6;  ///< a step over the edge of a tile
constexpr double same_step = 1e-6;
constexpr int chunk_cells = 64;  ///< read at once along a row
constexpr double widest_run_deg = 30.0;
constexpr float geoid_slack_m = 0.1F;  ///< between the corners of a patch, kinks included
constexpr int most_neighbours = 24;

struct Range {
  int first = 0, end = 0;
};

class Walk {
 public:
  Walk(const TerrainSource& source, const PostBox& cells, PatchUser& user)
      : source_(source),
        cells_(cells),
        user_(user),
        place_(geo_box(source.lattice,
                       {cells.column, cells.row, cells.columns + 1, cells.rows + 1})) {}

  void walk(const HeightTile& tile);

 private:
  using Posts = std::array<float, chunk_cells + 1>;
  /// One row of posts: the lower and the taller height where two tiles disagree on a shared post.
  struct Row {
    Posts low, high;
  };

  [[nodiscard]] Footprint footprint(const PolarPatch& patch) const;
  void find_neighbours(const HeightTile& tile);
  [[nodiscard]] Range wanted_rows(const PostGrid& grid) const;
  [[nodiscard]] Range wanted_columns(const PostGrid& grid) const;
  [[nodiscard]] PolarPatch patch_of(const PostGrid& grid, int row, const Range& run) const;
  void walk_row(const HeightTile& tile, int row, const Range& columns);
  void use_run(PolarPatch patch, const Footprint& at, const Range& run, int start, const Row& lower,
               const Row& upper) const;
  void use_columns(const PostGrid& grid, int row, const Range& run, int start, const Row& lower,
                   const Row& upper) const;
  [[nodiscard]] bool add_undulation(PolarPatch& patch) const;
  void read_row(const HeightTile& tile, int row, int column, int count, Row& out) const;
  void share_post(const PostGrid& grid, int row, int column, float& low, float& high) const;
  void mark_gaps(const HeightTile& tile) const;
  [[nodiscard]] bool covered(double latitude_deg, double longitude_deg) const;
  void mark_gap(const PolarPatch& edge, double north, double east) const;

  const TerrainSource& source_;
  const PostBox& cells_;
  PatchUser& user_;
  GeoBox place_;
  FixedVector<const HeightTile*, most_neighbours> neighbours_;
  bool too_many_ = false;
};

Footprint Walk::footprint(const PolarPatch& patch) const {
  const PostLattice& lattice = source_.lattice;
  const double west = patch.west_deg, east = patch.east_deg;
  double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300, farthest = 0;
  for (const double longitude : {west, east}) {
    const double s = std::sin(longitude * rad_per_deg);
    const double c =
        std::cos(longitude * rad_per_deg) * (lattice.chart == Chart::north_polar ? -1.0 : 1.0);
    for (const double latitude : {patch.south_deg, patch.north_deg}) {
      const double p = (lattice.chart == Chart::north_polar ? 90.0 - latitude : 90.0 + latitude) /
                       lattice.latitude_step_deg;
      farthest = std::max(farthest, p);
      low_x = std::min(low_x, p * s);
      high_x = std::max(high_x, p * s);
      low_y = std::min(low_y, p * c);
      high_y = std::max(high_y, p * c);
    }
  }
  // The outer parallel is an arc over its chord; a patch more than half round is the whole disc.
  const double half = 0.5 * (east - west) * rad_per_deg;
  const double bulge =
      (half < 0.5 * std::numbers::pi ? farthest * (1.0 - std::cos(half)) : 2.0 * farthest) +
      slack_cells;
  const auto cells_of = [bulge](double low, double high, std::int32_t origin, int count) {
    const double first = std::floor(low - bulge) - origin, last = std::floor(high + bulge) - origin;
    return Range{static_cast<int>(std::clamp(first, 0.0, static_cast<double>(count))),
                 static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(count)))};
  };
  const Range x = cells_of(low_x, high_x, cells_.column, cells_.columns);
  const Range y = cells_of(low_y, high_y, cells_.row, cells_.rows);
  return {x.first, x.end, y.first, y.end};
}

double on_turn(double longitude_deg, double near_deg) {
  return longitude_deg + 360.0 * std::round((near_deg - longitude_deg) / 360.0);
}

double middle_deg(const PostGrid& grid) {
  return 0.5 * (grid.west_deg + grid.east_deg());
}

/// Tiles whose posts may be posts of this one: they touch it along an edge or overlap it with the
/// same steps.
void Walk::find_neighbours(const HeightTile& tile) {
  neighbours_.clear();
  too_many_ = false;
  const PostGrid& own = tile.grid;
  const double slack = same_post_steps * own.latitude_step_deg;
  for (const HeightTile& other : source_.tiles) {
    const PostGrid& grid = other.grid;
    if (&other == &tile) continue;
    const double west =
        grid.west_deg + on_turn(middle_deg(grid), middle_deg(own)) - middle_deg(grid);
    const double east = west + (grid.columns - 1) * grid.longitude_step_deg;
    const double tall =
        std::min(grid.north_deg(), own.north_deg()) - std::max(grid.south_deg, own.south_deg);
    const double wide = std::min(east, own.east_deg()) - std::max(west, own.west_deg);
    if (tall < -slack || wide < -slack) continue;
    const bool same = std::abs(grid.latitude_step_deg / own.latitude_step_deg - 1.0) < same_step &&
                      std::abs(grid.longitude_step_deg / own.longitude_step_deg - 1.0) < same_step;
    if (!same && tall > slack && wide > slack) continue;
    if (!neighbours_.push_back(&other)) too_many_ = true;
  }
}

Range Walk::wanted_rows(const PostGrid& grid) const {
  const double south = (place_.south_deg - grid.south_deg) / grid.latitude_step_deg;
  const double north = (place_.north_deg - grid.south_deg) / grid.latitude_step_deg;
  const double most = grid.rows - 1;
  return {static_cast<int>(std::clamp(std::floor(south) - 1, 0.0, most)),
          static_cast<int>(std::clamp(std::ceil(north) + 1, 0.0, most))};
}

Range Walk::wanted_columns(const PostGrid& grid) const {
  const int most = grid.columns - 1;
  const double width = place_.east_deg - place_.west_deg;
  if (width + grid.east_deg() - grid.west_deg >= 360.0) return {0, most};
  const double middle = on_turn(0.5 * (place_.west_deg + place_.east_deg), middle_deg(grid));
  const double west = (middle - 0.5 * width - grid.west_deg) / grid.longitude_step_deg;
  const double east = (middle + 0.5 * width - grid.west_deg) / grid.longitude_step_deg;
  return {static_cast<int>(std::clamp(std::floor(west) - 1, 0.0, static_cast<double>(most))),
          static_cast<int>(std::clamp(std::ceil(east) + 1, 0.0, static_cast<double>(most)))};
}

void Walk::share_post(const PostGrid& grid, int row, int column, float& low, float& high) const {
  const double latitude = grid.south_deg + row * grid.latitude_step_deg;
  const double longitude = grid.west_deg + column * grid.longitude_step_deg;
  for (const HeightTile* other : neighbours_.view()) {
    const PostGrid& there = other->grid;
    const int r = post_index(latitude, there.south_deg, there.latitude_step_deg, there.rows);
    if (r < 0) continue;
    const int c = post_index(on_turn(longitude, middle_deg(there)), there.west_deg,
                             there.longitude_step_deg, there.columns);
    if (c < 0) continue;
    float post = 0;
    read_posts(*other, r, c, std::span(&post, 1));
    if (!source_.edits.empty()) apply_edits(source_.edits, there, r, c, std::span(&post, 1));
    if (std::isnan(post)) continue;
    if (std::isnan(high)) {
      low = high = post;
    } else {
      low = std::min(low, post);
      high = std::max(high, post);
    }
  }
}

void Walk::read_row(const HeightTile& tile, int row, int column, int count, Row& out) const {
  const std::span<float> posts(out.low.data(), static_cast<std::size_t>(count));
  read_posts(tile, row, column, posts);
  if (!source_.edits.empty()) apply_edits(source_.edits, tile.grid, row, column, posts);
  out.high = out.low;
  if (neighbours_.empty()) return;
  const bool edge_row = row == 0 || row == tile.grid.rows - 1;
  for (int k = 0; k < count; ++k) {
    const int c = column + k;
    if (!edge_row && c != 0 && c != tile.grid.columns - 1) continue;
    const auto at = static_cast<std::size_t>(k);
    share_post(tile.grid, row, c, out.low[at], out.high[at]);
  }
}

PolarPatch Walk::patch_of(const PostGrid& grid, int row, const Range& run) const {
  PolarPatch patch;
  patch.south_deg = grid.south_deg + row * grid.latitude_step_deg;
  patch.north_deg = patch.south_deg + grid.latitude_step_deg;
  patch.west_deg = grid.west_deg + run.first * grid.longitude_step_deg;
  patch.east_deg = grid.west_deg + run.end * grid.longitude_step_deg;
  return patch;
}

/// Adds the undulation to the corners; false where there is none.
bool Walk::add_undulation(PolarPatch& patch) const {
  const GeoidLookup& geoid = source_.geoid;
  if (geoid.undulation_m == nullptr) return true;
  for (int k = 0; k < 4; ++k) {
    const double latitude = k < 2 ? patch.south_deg : patch.north_deg;
    const double longitude = k % 2 == 0 ? patch.west_deg : patch.east_deg;
    const double n = geoid.undulation_m(geoid.context, std::clamp(latitude, -90.0, 90.0),
                                        std::remainder(longitude, 360.0));
    if (std::isnan(n)) return false;
    patch.corner_m[static_cast<std::size_t>(k)] += static_cast<float>(n);
  }
  patch.below_m += geoid_slack_m;
  patch.above_m += geoid_slack_m;
  return true;
}

/// Hands out the cells of one run as one patch, or one by one where some are unknown; `start` is
/// the tile column of the first post read.
void Walk::use_run(PolarPatch patch, const Footprint& at, const Range& run, int start,
                   const Row& lower, const Row& upper) const {
  const auto first = static_cast<std::size_t>(run.first - start);
  const auto last = static_cast<std::size_t>(run.end - start);
  const auto middle = [](const Row& row, std::size_t k) {
    return 0.5F * (row.low[k] + row.high[k]);
  };
  patch.corner_m = {middle(lower, first), middle(lower, last), middle(upper, first),
                    middle(upper, last)};
  const float unit = 1.0F / static_cast<float>(last - first);
  for (std::size_t k = first; k <= last; ++k) {
    const float share = static_cast<float>(k - first) * unit;
    for (int side = 0; side < 2; ++side) {
      const Row& row = side == 0 ? lower : upper;
      const auto corner = static_cast<std::size_t>(2 * side);
      const float on_line =
          patch.corner_m[corner] + (patch.corner_m[corner + 1] - patch.corner_m[corner]) * share;
      patch.below_m = std::max(patch.below_m, on_line - row.low[k]);
      patch.above_m = std::max(patch.above_m, row.high[k] - on_line);
    }
  }
  patch.known = add_undulation(patch);
  user_.use(patch, at);
}

void Walk::use_columns(const PostGrid& grid, int row, const Range& run, int start, const Row& lower,
                       const Row& upper) const {
  const auto known = [&](int post) {
    const auto k = static_cast<std::size_t>(post - start);
    return !std::isnan(lower.high[k]) && !std::isnan(upper.high[k]);
  };
  bool all = true;
  for (int c = run.first; c <= run.end; ++c) all = all && known(c);
  if (all) {
    const PolarPatch patch = patch_of(grid, row, run);
    use_run(patch, footprint(patch), run, start, lower, upper);
    return;
  }
  for (int c = run.first; c < run.end; ++c) {
    const Range one{c, c + 1};
    const PolarPatch patch = patch_of(grid, row, one);
    const Footprint at = footprint(patch);
    if (at.empty()) continue;
    if (known(c) && known(c + 1)) {
      use_run(patch, at, one, start, lower, upper);
    } else {
      user_.use(patch, at);
    }
  }
}

void Walk::walk_row(const HeightTile& tile, int row, const Range& columns) {
  const PostGrid& grid = tile.grid;
  const double south = grid.south_deg + row * grid.latitude_step_deg;
  const bool at_north = source_.lattice.chart == Chart::north_polar;
  const double p = std::max(at_north ? 90.0 - south : 90.0 + south + grid.latitude_step_deg, 1e-9);
  // Near the pole columns crowd: as many as half a lattice cell holds are one patch.
  const double in_a_cell =
      0.5 * source_.lattice.latitude_step_deg / (p * rad_per_deg * grid.longitude_step_deg);
  const double most = std::min<double>(chunk_cells, widest_run_deg / grid.longitude_step_deg);
  const int run = static_cast<int>(std::max(1.0, std::floor(std::min(in_a_cell, most))));
  const int chunk = run * (chunk_cells / run);
  Row lower, upper;
  for (int start = columns.first / chunk * chunk; start < columns.end; start += chunk) {
    bool have_posts = false;
    const int end = std::min(start + chunk, grid.columns - 1);
    for (int c = start; c < end; c += run) {
      const Range cells{c, std::min(c + run, end)};
      if (footprint(patch_of(grid, row, cells)).empty()) continue;
      if (!have_posts) {
        read_row(tile, row, start, end - start + 1, lower);
        read_row(tile, row + 1, start, end - start + 1, upper);
        have_posts = true;
      }
      use_columns(grid, row, cells, start, lower, upper);
    }
  }
}

/// Whether some tile holds a place in its inside.
bool Walk::covered(double latitude_deg, double longitude_deg) const {
  return std::any_of(source_.tiles.begin(), source_.tiles.end(), [&](const HeightTile& tile) {
    const PostGrid& grid = tile.grid;
    const double longitude = on_turn(longitude_deg, middle_deg(grid));
    return latitude_deg >= grid.south_deg && latitude_deg <= grid.north_deg() &&
           longitude >= grid.west_deg && longitude <= grid.east_deg();
  });
}

/// Marks one step of a tile's edge unknown unless tiles lie on its other side all along.
void Walk::mark_gap(const PolarPatch& edge, double north, double east) const {
  const Footprint at = footprint(edge);
  if (at.empty()) return;
  bool whole = true;
  for (const double share : {1e-4, 0.5, 1.0 - 1e-4}) {
    const double latitude = edge.south_deg + share * (edge.north_deg - edge.south_deg);
    const double longitude = edge.west_deg + share * (edge.east_deg - edge.west_deg);
    whole = whole && covered(latitude + north * outside_deg, longitude + east * outside_deg);
  }
  if (!whole) user_.use(edge, at);
}

/// Ground beyond the edges of a tile where no other tile is.
void Walk::mark_gaps(const HeightTile& tile) const {
  const PostGrid& g = tile.grid;
  const double south = g.south_deg, north = g.north_deg(), west = g.west_deg, east = g.east_deg();
  const auto one_tile_covers = [&](double south_end, double north_end, double west_end,
                                   double east_end) {
    return std::any_of(source_.tiles.begin(), source_.tiles.end(), [&](const HeightTile& other) {
      const PostGrid& grid = other.grid;
      const double shift = on_turn(middle_deg(grid), middle_deg(g)) - middle_deg(grid);
      return south_end >= grid.south_deg - 1e-9 && north_end <= grid.north_deg() + 1e-9 &&
             west_end >= grid.west_deg + shift - 1e-9 && east_end <= grid.east_deg() + shift + 1e-9;
    });
  };
  const Range rows = wanted_rows(g), columns = wanted_columns(g);
  for (const double side : {-1.0, 1.0}) {
    const double latitude = side < 0 ? south : north;
    const double over = latitude + side * outside_deg;
    if (std::abs(latitude) < 90.0 - 1e-9 && !one_tile_covers(over, over, west, east)) {
      for (int c = columns.first; c < columns.end; ++c) {
        mark_gap({latitude, latitude, west + c * g.longitude_step_deg,
                  west + (c + 1) * g.longitude_step_deg},
                 side, 0.0);
      }
    }
    const double longitude = side < 0 ? west : east;
    const double beside = longitude + side * outside_deg;
    if (one_tile_covers(south, north, beside, beside)) continue;
    for (int r = rows.first; r < rows.end; ++r) {
      mark_gap({south + r * g.latitude_step_deg, south + (r + 1) * g.latitude_step_deg, longitude,
                longitude},
               0.0, side);
    }
  }
}

void Walk::walk(const HeightTile& tile) {
  if (!overlaps(place_, tile.grid)) return;
  find_neighbours(tile);
  const Range rows = wanted_rows(tile.grid), columns = wanted_columns(tile.grid);
  for (int row = rows.first; row < rows.end; ++row) walk_row(tile, row, columns);
  mark_gaps(tile);
  if (!too_many_) return;
  // Which of its edge posts are known cannot be told: none of it is drawn.
  const PostGrid& g = tile.grid;
  const PolarPatch whole{g.south_deg, g.north_deg(), g.west_deg, g.east_deg()};
  user_.use(whole, footprint(whole));
}

}  // namespace

void walk_patches(const TerrainSource& source, const PostBox& cells, PatchUser& user) {
  Walk walk(source, cells, user);
  for (const HeightTile& tile : source.tiles) walk.walk(tile);
}

}  // namespace ridgeline
