// What TerrainKeeper knows of the ground near the eye: how far it is, and how it is drawn exactly.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/frame/terrain_keeper.hpp"

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double least_height_m = 0.05;  ///< over the ground; lower counts as below it
constexpr double least_clearance_m = 1e-3;
constexpr int clearance_cells = 8;
/// An eye nearer to the ground than this, or than a post, looks at NearGround. From here on half a
/// millimetre is a third of what the contract lets go along a ray.
constexpr double near_ground_m = 16.0;
constexpr double metres_per_degree = 110'574.0;  ///< of latitude at the equator, the smallest

/// Cells near the eye, added up.
struct NearCells {
  double distance_m = 0, relief_of_distance = 0, steepest = 0;

  void add(double relief_m, double cell_distance_m, double post_m) {
    distance_m = std::min(distance_m, cell_distance_m);
    relief_of_distance = std::max(relief_of_distance, relief_m / cell_distance_m);
    steepest = std::max(steepest, relief_m / post_m);
  }
};

}  // namespace

/// Where the copy of the finest level keeps a post. Domain: its block is held.
std::size_t TerrainKeeper::finest_index(std::int32_t column, std::int32_t row) const {
  const BlockSlot slot = levels_.slot({0, column >> block_levels, row >> block_levels});
  const auto block =
      static_cast<std::size_t>(slot.row * levels_.sizes().column_blocks + slot.column);
  const int inside = (row & (block_posts - 1)) * block_posts + (column & (block_posts - 1));
  return block * block_posts * block_posts + static_cast<std::size_t>(inside);
}

float TerrainKeeper::finest_post(std::int32_t column, std::int32_t row) const {
  const BlockId id{0, column >> block_levels, row >> block_levels};
  if (levels_.find(id) == nullptr) return -2 * void_offset_m;
  return finest_.heights_m[finest_index(column, row)];
}

/// The same to a few millionths of a metre. Domain: its block is held.
double TerrainKeeper::exact_post(std::int32_t column, std::int32_t row) const {
  const std::size_t k = finest_index(column, row);
  return static_cast<double>(finest_.heights_m[k]) + rest_unit_m * finest_.rests[k];
}

NearCell TerrainKeeper::near_cell(std::int32_t column, std::int32_t row) const {
  NearCell cell;
  double top_m = 0;
  const std::array<double, 4> posts{exact_post(column, row), exact_post(column + 1, row),
                                    exact_post(column, row + 1), exact_post(column + 1, row + 1)};
  for (const double post : posts) {
    if (post > static_cast<double>(void_threshold_m)) continue;
    const double floor_m = post + static_cast<double>(void_offset_m);
    top_m = cell.unknown ? std::max(top_m, floor_m) : floor_m;
    cell.unknown = true;
  }
  if (cell.unknown) {
    cell.height_m = top_m;
    return cell;
  }
  const double x = eye_column_ - column, y = eye_row_ - row;
  const double dx = posts[1] - posts[0], dy = posts[2] - posts[0];
  cell.twist_m = (posts[3] - posts[2]) - dx;
  cell.height_m = posts[0] + dx * x + dy * y + cell.twist_m * x * y;
  cell.east_m = dx + cell.twist_m * y;
  cell.north_m = dy + cell.twist_m * x;
  return cell;
}

NearGround TerrainKeeper::near_ground() const {
  NearGround near;
  near.used = true;
  const auto column = static_cast<std::int32_t>(std::floor(eye_column_));
  const auto row = static_cast<std::int32_t>(std::floor(eye_row_));
  for (std::int32_t k = 0; k < 9; ++k) {
    near.cells[static_cast<std::size_t>(k)] = near_cell(column - 1 + k % 3, row - 1 + k / 3);
  }
  return near;
}

/// Height of the known surface, NaN where it is unknown.
double TerrainKeeper::height_below_m(double column, double row) const {
  const auto c = static_cast<std::int32_t>(std::floor(column));
  const auto r = static_cast<std::int32_t>(std::floor(row));
  const double fx = column - c, fy = row - r;
  const float sw = finest_post(c, r), se = finest_post(c + 1, r);
  const float nw = finest_post(c, r + 1), ne = finest_post(c + 1, r + 1);
  if (std::min({sw, se, nw, ne}) < void_threshold_m) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return (static_cast<double>(sw) * (1 - fx) + static_cast<double>(se) * fx) * (1 - fy) +
         (static_cast<double>(nw) * (1 - fx) + static_cast<double>(ne) * fx) * fy;
}

double TerrainKeeper::residual_near_m(const BlockId& id) const {
  const HeldBlock* block = levels_.find(id);
  return block == nullptr ? 0.0 : static_cast<double>(block->facts.residual_m);
}

/// Lower bound on the distance from the eye to the known ground of one cell, whatever is round it.
double TerrainKeeper::cell_distance_m(const GeodeticPosition& eye, std::int32_t c, std::int32_t r,
                                      double post_x, double post_y) const {
  const std::array<float, 4> posts{finest_post(c, r), finest_post(c + 1, r), finest_post(c, r + 1),
                                   finest_post(c + 1, r + 1)};
  const float highest = *std::max_element(posts.begin(), posts.end());
  if (highest < void_threshold_m) return std::numeric_limits<double>::infinity();
  const double x = post_x * std::max({0.0, c - eye_column_, eye_column_ - (c + 1)});
  const double y = post_y * std::max({0.0, r - eye_row_, eye_row_ - (r + 1)});
  const double away2 = x * x + y * y;
  double over = std::max(0.0, eye.height_m - static_cast<double>(highest));
  if (*std::min_element(posts.begin(), posts.end()) > void_threshold_m) {
    // From the point of the cell nearest to the eye the ground rises by its slope at most.
    const auto post = [&](std::size_t k) { return static_cast<double>(posts[k]); };
    const double fx = std::clamp(eye_column_ - c, 0.0, 1.0);
    const double fy = std::clamp(eye_row_ - r, 0.0, 1.0);
    const double nearest_m =
        (post(0) * (1 - fx) + post(1) * fx) * (1 - fy) + (post(2) * (1 - fx) + post(3) * fx) * fy;
    const double east = std::max(std::abs(post(1) - post(0)), std::abs(post(3) - post(2))) / post_x;
    const double north =
        std::max(std::abs(post(2) - post(0)), std::abs(post(3) - post(1))) / post_y;
    const double gap_m = std::max(0.0, eye.height_m - nearest_m);
    over = std::max(over, gap_m / std::sqrt(1.0 + east * east + north * north));
  }
  return std::sqrt(away2 + over * over);
}

/// Between the lowest and the highest post of a known cell; 0 for an unknown one, which is flat.
double TerrainKeeper::cell_relief_m(std::int32_t c, std::int32_t r) const {
  const auto [low, high] = std::minmax(
      {finest_post(c, r), finest_post(c + 1, r), finest_post(c, r + 1), finest_post(c + 1, r + 1)});
  return low < void_threshold_m ? 0.0 : static_cast<double>(high) - static_cast<double>(low);
}

Clearance TerrainKeeper::near_clearance(const GeodeticPosition& eye) const {
  const auto column = static_cast<std::int32_t>(std::floor(eye_column_));
  const auto row = static_cast<std::int32_t>(std::floor(eye_row_));
  const double post_y = lattice_.latitude_step_deg * metres_per_degree;
  const double narrow =
      lattice_.polar() ? 1.0 : std::max(std::cos(eye.latitude_deg * deg) - 1e-4, 1e-3);
  const double post_x = lattice_.longitude_step_deg * metres_per_degree * narrow;
  const double post_m = std::min(post_x, post_y);
  NearCells nine, others;
  nine.distance_m = others.distance_m = (clearance_cells - 1) * post_m;  // to what is not looked at
  for (std::int32_t r = row - clearance_cells; r <= row + clearance_cells; ++r) {
    for (std::int32_t c = column - clearance_cells; c <= column + clearance_cells; ++c) {
      const double distance_m =
          std::max(cell_distance_m(eye, c, r, post_x, post_y), least_clearance_m);
      NearCells& part = std::abs(r - row) <= 1 && std::abs(c - column) <= 1 ? nine : others;
      part.add(cell_relief_m(c, r), distance_m, post_m);
    }
  }
  double residual = 0;  // what the truth may be nearer by
  for (const std::int32_t c : {column - clearance_cells, column + clearance_cells + 1}) {
    for (const std::int32_t r : {row - clearance_cells, row + clearance_cells + 1}) {
      residual = std::max(residual, residual_near_m({0, c >> block_levels, r >> block_levels}));
    }
  }
  const double below = height_below_m(eye_column_, eye_row_);
  const double over = eye.height_m - below;
  Clearance result;
  result.over_m = over;
  result.kind = over + residual <= least_height_m ? Clearance::Kind::below : Clearance::Kind::above;
  const double nearest_m = std::min(nine.distance_m, others.distance_m);
  result.distance_m = std::max(nearest_m - residual, least_clearance_m);
  const PostRect drawn = levels_.drawable(0);
  result.near_ground = nearest_m < std::max(post_m, near_ground_m) && column > drawn.west &&
                       column + 2 <= drawn.east && row > drawn.south && row + 2 <= drawn.north;
  result.drawn_m = result.near_ground ? others.distance_m : nearest_m;
  result.relief_of_distance = others.relief_of_distance;
  if (result.near_ground) {
    result.near_m = nine.distance_m;
    result.near_steepest = nine.steepest;
  } else {
    result.relief_of_distance = std::max(result.relief_of_distance, nine.relief_of_distance);
  }
  return result;
}

Clearance TerrainKeeper::clearance(const GeodeticPosition& eye) const {
  const auto column = static_cast<std::int32_t>(std::floor(eye_column_));
  const auto row = static_cast<std::int32_t>(std::floor(eye_row_));
  const PostRect near = levels_.drawable(0);
  const bool drawn = !near.empty() && column >= near.west && column < near.east &&
                     row >= near.south && row < near.north;
  if (drawn) return near_clearance(eye);
  // Ground outside a block and one cell of its level round it may stand higher than the block says.
  const double north_deg = std::min(std::abs(eye.latitude_deg) + 1.0, 90.0);
  const double narrow = lattice_.polar() ? 1.0 : std::cos(north_deg * deg);
  const double post_m = metres_per_degree *
                        std::min(lattice_.latitude_step_deg, lattice_.longitude_step_deg * narrow);
  Clearance result;
  double least = 0, relief_m = 0;
  for (int level = 1; level < levels_.sizes().levels; ++level) {
    const HeldBlock* block = levels_.find({level, column >> (6 + level), row >> (6 + level)});
    if (block == nullptr) continue;
    const double over = eye.height_m - static_cast<double>(block->facts.highest_m);
    least = std::max(least, std::min(over, post_m * (1 << level)));
    relief_m = std::max(relief_m, static_cast<double>(block->facts.highest_m) -
                                      static_cast<double>(block->facts.lowest_m));
  }
  if (!(least > 0)) return result;
  result.kind = Clearance::Kind::above;
  result.distance_m = std::max(least, least_clearance_m);
  result.drawn_m = result.distance_m;
  result.relief_of_distance = relief_m / result.distance_m;
  return result;
}

}  // namespace ridgeline
