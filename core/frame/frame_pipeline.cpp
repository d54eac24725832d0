#include "core/frame/frame_pipeline.hpp"

#include <algorithm>
#include <cmath>

#include "core/frame/level_error.hpp"
#include "core/frame/picture.hpp"

namespace ridgeline {
namespace {

constexpr int grid_attempts = 8;      ///< to fit the grid into its capacity
constexpr double coarser = 1.5;       ///< wider spacing for the next attempt
constexpr double bound_growth = 1.1;  ///< step by which a bound that cannot be met is raised

/// The smallest bound not below the wanted one that this pose and this terrain allow; where
/// completeness is what does not allow it, the smallest of a few steps.
Result<ErrorBudget> honest_budget(const FrameSettings& settings, const Camera& camera,
                                  const GroundMap& map, const LevelError& levels,
                                  const HeightRounding& rounding) {
  ErrorBudget budget = error_budget(camera, map, levels.angle_px, rounding);
  double bound_px = std::max(settings.error_px, budget.smallest_px());
  for (; bound_px <= limits::max_error_px; bound_px *= bound_growth) {
    if (!stays_complete(camera, bound_px, levels, budget.geometry_rad)) continue;
    budget.epsilon_px = bound_px;
    return budget;
  }
  return Fault::no_error_bound;
}

/// The grid as dense as wanted, or as its capacity allows: spacing costs time, never a pixel.
PolarGrid grid_for(const FrameSettings& settings, const RenderSizes& sizes, const Camera& camera) {
  PolarGrid grid;
  GridSpacing spacing = settings.node_spacing;
  for (int attempt = 0; attempt < grid_attempts && !settings.cast_every_pixel; ++attempt) {
    grid = polar_grid(camera, spacing);
    if (grid.plane_count <= sizes.planes && grid.row_count <= sizes.rows) return grid;
    if (grid.plane_count > sizes.planes) spacing.planes_px *= coarser;
    if (grid.row_count > sizes.rows) spacing.rows_px *= coarser;
  }
  grid.used = false;
  return grid;
}

FrameReport removed(FrameReport report, Reason reason) {
  add_reason(report.availability, reason);
  return report;
}

FrameReport draw_terrain(const FrameSettings& settings, const FrameInput& input,
                         TerrainKeeper& terrain, int refused_tiles, const FrameTables& tables,
                         Renderer& renderer, FrameBlocks& blocks, bool& attitude_valid) {
  FrameReport report;
  report.time_ns = input.time_ns;
  report.availability = input.availability;

  // Camera first: a frame without terrain still shows the attitude.
  const auto camera_made = camera(input.attitude, settings.image);
  // An attitude that is no attitude still needs a picture, which says so: a level camera's size.
  const auto any_camera = camera_made ? camera_made : camera({}, settings.image);
  RL_ASSERT(any_camera);  // the image geometry was checked at boot
  report.camera = any_camera.value();
  blocks = camera_blocks(report.camera);
  attitude_valid = attitude_valid && camera_made;
  if (!camera_made) return removed(report, Reason::attitude_invalid);
  if (report.availability.mode == Mode::removed) return report;

  // Local frame.
  const auto local = local_frame(input.eye);
  if (!local) return removed(report, Reason::position_invalid);
  report.local = local.value();

  // Terrain window.
  terrain.follow(input.eye, renderer);
  report.window = terrain.summary();
  report.range_m = terrain.covered_range_m(input.eye, settings.range_m);
  if (report.range_m < limits::min_range_m) {
    return removed(report,
                   report.window.complete ? Reason::terrain_missing : Reason::terrain_loading);
  }
  if (report.window.known_posts == 0) return removed(report, Reason::terrain_missing);
  const Clearance clearance = terrain.clearance(input.eye);
  if (clearance.kind == Clearance::Kind::below) return removed(report, Reason::below_terrain);
  if (clearance.kind == Clearance::Kind::undecided) return removed(report, Reason::terrain_loading);
  const LevelError levels =
      level_error(terrain, report.local, report.camera, report.range_m, clearance.distance_m);
  report.range_m = levels.clear_range_m;
  if (report.range_m < limits::min_range_m) return removed(report, Reason::no_bound);
  if (report.range_m < settings.range_m) add_reason(report.availability, Reason::range_reduced);

  // Ground map and error budget.
  const auto map = ground_map(report.local, report.range_m, terrain.lattice().chart,
                              {report.window.lowest_m, report.window.highest_m});
  const HeightRounding rounding{
      std::max(std::abs(report.window.highest_m), std::abs(report.window.lowest_m)),
      clearance.relief_m, clearance.distance_m};
  const auto budget = map ? honest_budget(settings, report.camera, map.value(), levels, rounding)
                          : Result<ErrorBudget>(map.fault());
  if (!budget) return removed(report, Reason::no_bound);
  report.budget = budget.value();
  report.bound_px = report.budget.epsilon_px;
  if (report.bound_px > settings.error_px) add_reason(report.availability, Reason::bound_exceeded);
  if (refused_tiles > 0) add_reason(report.availability, Reason::tile_refused);
  if (report.window.mismatched_tiles > 0) add_reason(report.availability, Reason::tile_refused);

  // Projected grid, error buffer, ray cast.
  PolarGrid grid = grid_for(settings, renderer.sizes(), report.camera);
  if (grid.used) {
    report.nodes = fill_grid_tables(report.camera, map.value(), grid, tables.planes, tables.slopes);
  }
  blocks = frame_blocks(report.local, report.camera, map.value(), grid, terrain.view(),
                        report.window.highest_m);
  report.planes = grid.used ? grid.plane_count : 0;
  report.rows = grid.used ? grid.row_count : 0;
  if (!grid.used) report.nodes = 0;
  renderer.draw_terrain(blocks, tables.planes.first(report.planes),
                        tables.slopes.first(report.rows));
  return report;
}

}  // namespace

FrameReport draw_frame(const FrameSettings& settings, const FrameInput& input,
                       TerrainKeeper& terrain, int refused_tiles, const FrameTables& tables,
                       Renderer& renderer) {
  FrameBlocks blocks{};
  bool attitude_valid = input.attitude_valid;
  FrameReport report = draw_terrain(settings, input, terrain, refused_tiles, tables, renderer,
                                    blocks, attitude_valid);
  if (report.availability.mode == Mode::removed) report.bound_px = 0;
  renderer.upload_text(text_layer(report, tables.text));
  renderer.shade(blocks, style_block(report, terrain.lattice(), settings.geoid, attitude_valid));
  return report;
}

FrameCounts finish_frame(Renderer& renderer, FrameReport& report, const FrameTables& tables) {
  FrameCounts counts;
  if (report.availability.mode == Mode::removed) return counts;
  counts.counters = renderer.read_counters();
  counts.pass_ms = renderer.timer().pass_ms();
  const double pixels = static_cast<double>(renderer.sizes().width_px) * renderer.sizes().height_px;
  counts.ray_cast_share = counts.counters.rays_cast / pixels;
  if (counts.counters.unresolved > 0) {
    add_reason(report.availability, Reason::no_bound);
    report.bound_px = 0;
    renderer.upload_text(text_layer(report, tables.text));
    renderer.shade(camera_blocks(report.camera),
                   style_block(report, PostLattice{}, GeoidLookup{}, true));
  }
  return counts;
}

}  // namespace ridgeline
