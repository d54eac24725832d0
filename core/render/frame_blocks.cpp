#include "core/render/frame_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

// Derived in docs/error_bound.md, section 4, and attacked by gl.arithmetic.
constexpr double float_angle_rad = 5.5e-6;
constexpr double rounding_unit = 0x1p-24;
/// Of the relief of one cell: 26 u for sums and products, 2e-6 for posts at its edge.
constexpr double relief_share = 3.6e-6;
/// Of heights drawn about the eye: half a unit of TerrainBlock::rests; of the slope of a cell, 30 u
/// for sums and products and 5e-7 for the edge it begins at.
constexpr double near_rest_m = 0.5 * rest_unit_m, near_slope_share = 2.3e-6;
constexpr double straight_rad = 1.0e-6;  ///< how far a step within a cell may bend
constexpr double rad_per_deg = 0.017453292519943295;
constexpr double slip_posts = 0.1;  ///< how far a step's straight exit may miss the true track
constexpr double wedge_posts =
    0.85;  ///< half width of a wedge that the nodes' overlap still covers

float f(double value) {
  return static_cast<float>(value);
}

glm::vec4 vec4_of(const glm::dvec3& v, double w) {
  return {f(v.x), f(v.y), f(v.z), f(w)};
}

/// Bounds on how much the ground map bends along any straight way over its disc: the largest sums
/// of second derivatives. Units: degrees per (range)².
struct MapBend {
  double north_deg = 0, east_deg = 0;
};

MapBend bend_of(const GroundMap& map) {
  const auto& a = map.north_deg;
  const auto& b = map.east_deg;
  return {2 * std::abs(a[1]) + 6 * std::abs(a[2]) + 12 * std::abs(a[3]) + 20 * std::abs(a[4]) +
              2 * std::abs(a[5]) + 6 * std::abs(a[6]) + 12 * std::abs(a[7]) + 20 * std::abs(a[8]) +
              12 * std::abs(a[9]) + 20 * std::abs(a[10]),
          2 * std::abs(b[1]) + 6 * std::abs(b[2]) + 12 * std::abs(b[3]) + 20 * std::abs(b[4]) +
              6 * std::abs(b[5]) + 12 * std::abs(b[6]) + 20 * std::abs(b[7]) + 20 * std::abs(b[8])};
}

/// Longest step for which a straight exit stays within slip_posts of the true track.
double largest_step_m(const GroundMap& map, const PostLattice& window) {
  const MapBend map_bend = bend_of(map);
  const double rows = map_bend.north_deg / window.latitude_step_deg;
  const double columns = map_bend.east_deg / window.longitude_step_deg;
  // A polar chart is turned against the eye's axes: either bend may lie along any axis.
  const double bend = (window.polar() ? std::hypot(rows, columns) : std::max(rows, columns)) /
                      (map.range_m * map.range_m);  // posts per m²
  return std::sqrt(2.0 * slip_posts / std::max(bend, 1e-12));
}

/// How long the ground track counts as straight: from distance t on for A / 2 + sqrt(A t), A the
/// result. It then bends by at most `straight_rad` of the distance: sideways with the map, and
/// along itself where the ray looks down (over ground it has gone t cos d - t² sin d cos d / R).
/// Units: m.
double straight_m(const GroundMap& map, const LocalFrame& frame) {
  const MapBend bend = bend_of(map);
  const double parallel_m =
      map.chart == Chart::geographic
          ? frame.prime_vertical_radius_m * std::cos(frame.eye.latitude_deg * rad_per_deg)
          : frame.prime_vertical_radius_m;
  const double bend_m = rad_per_deg * std::hypot(bend.north_deg * frame.meridian_radius_m,
                                                 bend.east_deg * parallel_m);
  return 2.0 * straight_rad /
         (bend_m / (map.range_m * map.range_m) +
          std::max(map.inverse_meridian_radius, map.inverse_prime_vertical_radius));
}

/// The cells round a low eye, over the eye. Edges are rounded as what they are, distances from it.
void put_near_ground(const TerrainView& view, double eye_height_m, shader::FrameBlock& b) {
  const NearGround& near = view.near;
  const double x = view.eye_column - std::floor(view.eye_column);
  const double y = view.eye_row - std::floor(view.eye_row);
  b.near_edges = {f(-x), f(1.0 - x), f(-y), f(1.0 - y)};
  std::int32_t unknown = 0;
  for (std::size_t k = 0; k < near.cells.size(); ++k) {
    const NearCell& cell = near.cells[k];
    b.near_cells[k] = {f(cell.height_m - eye_height_m), f(cell.east_m), f(cell.north_m),
                       f(cell.twist_m)};
    unknown |= static_cast<std::int32_t>(cell.unknown) << k;
  }
  b.near = {near.used ? 1 : 0, unknown, 0, 0};
}

/// The window as the shaders address it: integers relative to the post south-west of the eye.
void put_window(const TerrainView& view, shader::FrameBlock& b) {
  constexpr std::int32_t low_bits = (1 << (block_levels + max_levels)) - 1;
  const double west = std::floor(view.eye_column), south = std::floor(view.eye_row);
  b.eye.x = f(view.eye_column - west);
  b.eye.y = f(view.eye_row - south);
  const auto column = static_cast<std::int32_t>(west), row = static_cast<std::int32_t>(south);
  b.window = {column & low_bits, row & low_bits, view.sizes.levels, 0};
  const int columns = view.sizes.columns(), rows = view.sizes.rows();
  b.level_size = {f(columns), f(rows), f(1.0 / (columns + 1)), f(1.0 / (rows + 1))};
  for (int l = 0; l < view.sizes.levels; ++l) {
    b.level_eye[l] = {wrapped(column >> l, columns), wrapped(row >> l, rows), 0, 0};
    const PostRect& rect = view.drawable[static_cast<std::size_t>(l)];
    b.level_rect[l] = {rect.west - column, rect.south - row, rect.east - column, rect.north - row};
  }
}

}  // namespace

double HeightRounding::of_distance() const {
  double result =
      rounding_unit * largest_m / std::max(distance_m, 1e-3) + relief_share * relief_of_distance;
  if (near_distance_m > 0) {
    result += near_rest_m / near_distance_m + near_slope_share * near_steepest;
  }
  return result;
}

ErrorBudget error_budget(const Camera& camera, const GroundMap& map, double level_px,
                         double steepest, const HeightRounding& rounding) {
  const double edge = std::cos(camera.half_diagonal_rad(0.0));
  const double px_per_rad = std::max(camera.fx, camera.fy) / (edge * edge);
  ErrorBudget budget;
  budget.level_px = level_px;
  // Ground moved by d in any direction is, over its old place, higher or lower by at most this.
  const double lift = std::hypot(1.0, steepest);
  budget.geometry_rad = lift * (map.error_rad + float_angle_rad) + rounding.of_distance();
  budget.geometry_px = px_per_rad * budget.geometry_rad;
  return budget;
}

double smallest_error_px(const Camera& camera) {
  const double edge = std::cos(camera.half_diagonal_rad(0.0));
  const double px_per_rad = std::max(camera.fx, camera.fy) / (edge * edge);
  return px_per_rad * float_angle_rad;
}

FrameBlocks frame_blocks(const LocalFrame& frame, const Camera& camera, const GroundMap& map,
                         const PolarGrid& grid, const TerrainView& view, double highest_m) {
  FrameBlocks blocks{};
  auto& b = blocks.frame;
  const glm::dmat3& axes = camera.enu_from_camera.columns;
  b.ray_dx = vec4_of(axes[0] / camera.fx, camera.width_px);
  b.ray_dy = vec4_of(axes[1] / camera.fy, camera.height_px);
  b.ray_origin = vec4_of(camera.ray(0.5, 0.5).xyz, map.range_m);
  put_window(view, b);
  put_near_ground(view, frame.eye.height_m, b);
  const float high = f(frame.eye.height_m);
  b.eye.z = high;
  b.eye.w = f(frame.eye.height_m - static_cast<double>(high));
  b.earth = {f(map.inverse_meridian_radius), f(map.inverse_prime_vertical_radius), 0.0f, high};
  const int largest_node = block_levels + view.sizes.levels - 1;
  b.heights = {f(highest_m), f(straight_m(map, frame)), f(largest_node),
               f(largest_step_m(map, view.lattice))};
  const double reach_m = grid.used ? wedge_limit_m(frame, grid, view.lattice, map.range_m) : 0.0;
  for (int l = 0; l < view.sizes.levels; ++l) b.level_reach[l].x = f(reach_m * (1 << l));
  const double sweep_end_m =
      std::min(reach_m * (1 << (view.sizes.levels - 1)), 1.003 * map.range_m);
  b.tolerance = {f(sweep_end_m), f(map.swell_m[0]), f(1.0 / map.range_m), f(map.swell_m[1])};
  for (int k = 0; k < 11; ++k) {
    b.latitude[k / 4][k % 4] = f(map.north_deg[k] / view.lattice.latitude_step_deg);
  }
  for (int k = 0; k < 9; ++k) {
    b.longitude[k / 4][k % 4] = f(map.east_deg[k] / view.lattice.longitude_step_deg);
  }
  const Turn turn = turn_of(view.lattice.chart, frame.eye);
  const glm::ivec2 nodes = nodes_texels(view.sizes.columns(), view.sizes.rows());
  b.turn = {f(turn.cosine), f(turn.sine), f(1.0 / nodes.x), f(1.0 / nodes.y)};
  auto& g = blocks.grid;
  g.grid = {grid.plane_count, grid.row_count, grid.used ? 1 : 0, 0};
  if (!grid.used) return blocks;
  const double segments = limits::grid_segments;
  g.azimuth = {f(grid.azimuth_start_rad), f(grid.azimuth_span_rad),
               f(segments / grid.azimuth_span_rad), grid.full_circle ? 1.0f : 0.0f};
  g.slope = {f(grid.slope_low), f(grid.slope_high),
             f(segments / (grid.slope_high - grid.slope_low)), 0.0f};
  for (int k = 0; k < limits::grid_segments; ++k) {
    g.planes[k] = {f(grid.planes[k].first_index), f(grid.planes[k].density), 0, 0};
    g.rows[k] = {f(grid.rows[k].first_index), f(grid.rows[k].density), 0, 0};
  }
  return blocks;
}

double wedge_limit_m(const LocalFrame& frame, const PolarGrid& grid, const PostLattice& lattice,
                     double range_m) {
  double widest_rad = 0;
  for (const PolarGrid::Segment& segment : grid.planes) {
    widest_rad = std::max(widest_rad, 1.0 / segment.density);
  }
  if (lattice.polar()) {
    constexpr double smallest_scale = 0.99;  // of a parallel, within 12 degrees of the pole
    const double post_m =
        smallest_scale * lattice.latitude_step_deg * rad_per_deg * frame.meridian_radius_m;
    return wedge_posts * post_m / (0.5 * widest_rad);
  }
  // The narrowest post within reach: that of the highest latitude looked at.
  const double reach_deg = 1.01 * range_m / frame.meridian_radius_m / rad_per_deg;
  const double north = std::abs(frame.eye.latitude_deg) + reach_deg;
  const double east_m = lattice.longitude_step_deg * rad_per_deg * frame.prime_vertical_radius_m *
                        std::cos(std::min(north, 89.9) * rad_per_deg);
  const double north_m = lattice.latitude_step_deg * rad_per_deg * frame.meridian_radius_m;
  return wedge_posts * std::min(east_m, 0.99 * north_m) / (0.5 * widest_rad);
}

std::int64_t fill_grid_tables(const Camera& camera, const GroundMap& map, const PolarGrid& grid,
                              std::span<PlaneRecord> planes, std::span<float> slopes) {
  std::int64_t nodes = 0;
  for (int i = 0; i < grid.plane_count; ++i) {
    const double azimuth = grid.plane_azimuth_rad(i);
    const double s = std::sin(azimuth), c = std::cos(azimuth);
    const RowRange rows = visible_rows(camera, grid, azimuth);
    planes[i].direction = {
        f(s), f(c),
        f(map.inverse_meridian_radius * c * c + map.inverse_prime_vertical_radius * s * s), 0.0f};
    planes[i].rows = {rows.first, rows.last, 0, 0};
    nodes += std::max(0, rows.last - rows.first + 1);
  }
  for (int j = 0; j < grid.row_count; ++j) {
    slopes[j] = f(grid.row_slope(j));
  }
  return nodes;
}

}  // namespace ridgeline
