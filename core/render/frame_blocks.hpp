#pragma once
#include <algorithm>

#include "core/geo/camera.hpp"
#include "core/geo/ground_map.hpp"
#include "core/geo/polar_grid.hpp"
#include "core/terrain/terrain_levels.hpp"
#include "shaders/frame_block.h"

namespace ridgeline {

/// One vertical plane of the grid as the sweep reads it (std430).
struct PlaneRecord {
  glm::vec4 direction{};  ///< sin, cos of the azimuth, 1/R
  glm::ivec4 rows{};      ///< first row, last row
};
static_assert(sizeof(PlaneRecord) == 32);

/// What the error of one frame may be, split by cause.
struct ErrorBudget {
  double epsilon_px = 0;    ///< promised: the wanted bound, or the smallest this pose allows
  double geometry_px = 0;   ///< what the drawn picture uses of it: ground map and float32 rounding
  double geometry_rad = 0;  ///< the same as an angle
  double level_px = 0;      ///< and what coarser levels of the window use of it

  /// The smallest bound these terms allow.
  [[nodiscard]] double smallest_px() const { return geometry_px + level_px; }
};

/// What rounding of heights in float32 depends on.
struct HeightRounding {
  double largest_m = 0;           ///< largest magnitude of a height in the window
  double distance_m = 0;          ///< lower bound on the distance to terrain drawn from its posts
  double relief_of_distance = 0;  ///< of such cells: difference of heights inside one / distance
  /// Of cells drawn about the eye, where there are any: lower bound on the distance, and the
  /// largest difference of heights inside one over a post.
  double near_distance_m = 0, near_steepest = 0;

  /// Largest error of a height over its distance.
  [[nodiscard]] double of_distance() const;
};

/// Everything the passes of one frame read. Plain data, made by frame_blocks() in double.
struct FrameBlocks {
  shader::FrameBlock frame;
  shader::GridBlock grid;
};

/// What the error of a frame is made of; the promise itself is still to be chosen.
/// Units:  px. `level_px`: what the levels of the window add. `steepest`: largest slope of the
///         ground in view. docs/error_bound.md, section 4.
ErrorBudget error_budget(const Camera& camera, const GroundMap& map, double level_px,
                         double steepest, const HeightRounding& rounding);

/// Texels of the texture that holds the nodes of a level of so many columns and rows of posts: the
/// smallest nodes at the left, the larger ones above each other to their right.
constexpr glm::ivec2 nodes_texels(int columns, int rows) {
  return {columns / 2 + columns / 4, rows / 2};
}

/// What no frame of this camera can promise less than, wherever it is: rounding alone.
double smallest_error_px(const Camera& camera);

/// Uniforms of one frame: double until here, float after.
/// `highest_m`: of everything the window holds, floors of unknown ground too.
FrameBlocks frame_blocks(const LocalFrame& frame, const Camera& camera, const GroundMap& map,
                         const PolarGrid& grid, const TerrainView& view, double highest_m);

/// Ground distance at which the half distance between two planes outgrows the overlap of the nodes
/// of the finest level: up to here they prove whole wedges empty; those of level l up to 2^l times
/// that. `range_m`: how far posts are looked at, which narrow towards the poles.
double wedge_limit_m(const LocalFrame& frame, const PolarGrid& grid, const PostLattice& lattice,
                     double range_m);

/// Tables of the grid. Shape: planes.size() >= grid.plane_count, slopes.size() >= grid.row_count.
/// Result: nodes the sweep will write.
std::int64_t fill_grid_tables(const Camera& camera, const GroundMap& map, const PolarGrid& grid,
                              std::span<PlaneRecord> planes, std::span<float> slopes);

}  // namespace ridgeline
