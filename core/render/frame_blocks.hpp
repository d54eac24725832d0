#pragma once

#include "core/geo/camera.hpp"
#include "core/geo/ground_map.hpp"
#include "core/geo/polar_grid.hpp"
#include "core/terrain/terrain_window.hpp"
#include "shaders/frame_block.h"

namespace ridgeline {

/// One vertical plane of the grid as the sweep reads it (std430).
struct PlaneRecord {
  glm::vec4 direction{};  ///< sin, cos of the azimuth, 1/R
  glm::ivec4 rows{};      ///< first row, last row
};
static_assert(sizeof(PlaneRecord) == 32);

/// What the error of one frame may be, split by cause. All in pixels.
struct ErrorBudget {
  double epsilon_px = 0;   ///< promised: the wanted bound, or the smallest this pose allows
  double geometry_px = 0;  ///< what the drawn picture uses of it: ground map and float32 rounding
};

/// Everything the passes of one frame read. Plain data, made by frame_blocks() in double.
struct FrameBlocks {
  shader::FrameBlock frame;
  shader::GridBlock grid;
};

/// The bound a frame can promise, and what it is made of.
/// Units:  px. `eye_over_base_m` and `clearance_m` (distance to the nearest terrain, a lower bound)
///         set the float32 rounding term: docs/error_bound.md, section 4.
/// Errors: Fault::error_bound_out_of_range when the geometry term exceeds half the wanted error.
Result<ErrorBudget> error_budget(const Camera& camera, const GroundMap& map, double epsilon_px,
                                 double eye_over_base_m, double clearance_m);

/// Uniforms of one frame: double until here, float after.
FrameBlocks frame_blocks(const LocalFrame& frame, const Camera& camera, const GroundMap& map,
                         const PolarGrid& grid, const WindowGrid& window,
                         const WindowSummary& summary, double base_height_m);

/// Ground distance at which the half distance between two planes outgrows the overlap of the
/// pyramid's nodes: up to here the sweep proves whole wedges empty.
double wedge_limit_m(const LocalFrame& frame, const PolarGrid& grid, const WindowGrid& window);

/// Tables of the grid. Shape: planes.size() >= grid.plane_count, slopes.size() >= grid.row_count.
/// Result: nodes the sweep will write.
std::int64_t fill_grid_tables(const Camera& camera, const GroundMap& map, const PolarGrid& grid,
                              std::span<PlaneRecord> planes, std::span<float> slopes);

}  // namespace ridgeline
