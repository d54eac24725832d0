#include "core/frame/frame_pipeline.hpp"

#include <algorithm>
#include <cmath>

#include "core/frame/picture.hpp"

namespace ridgeline {
namespace {

constexpr double rebase_px = 0.1;     ///< float32 height rounding that is worth a refill
constexpr int grid_attempts = 8;      ///< to fit the grid into its capacity
constexpr double coarser = 1.5;       ///< wider spacing for the next attempt
constexpr double bound_growth = 1.5;  ///< step by which a bound that cannot be met is raised

/// The smallest bound not below the wanted one that this pose allows.
Result<ErrorBudget> honest_budget(const FrameSettings& settings, const Camera& camera,
                                  const GroundMap& map, TerrainKeeper& terrain,
                                  const GeodeticPosition& eye, bool& refilled) {
  const double clearance_m = terrain.clearance_m(eye);
  const double over_base_m = eye.height_m - terrain.base_height_m();
  auto budget = error_budget(camera, map, settings.error_px, over_base_m, clearance_m);
  const auto still = error_budget(camera, map, limits::max_error_px, 0.0, clearance_m);
  if (still && (!budget || budget.value().geometry_px > still.value().geometry_px + rebase_px)) {
    terrain.rebase(eye);
    refilled = true;
  }
  for (double wanted = settings.error_px; wanted <= limits::max_error_px; wanted *= bound_growth) {
    budget = error_budget(camera, map, wanted, eye.height_m - terrain.base_height_m(), clearance_m);
    if (budget) return budget;
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
  report.window_loaded = terrain.follow(input.eye, settings.range_m);
  report.window = terrain.summary();
  if (report.window.known_posts == 0) {
    if (report.window_loaded) renderer.upload_window(terrain.posts());
    return removed(report, Reason::terrain_missing);
  }
  report.range_m = terrain.covered_range_m(input.eye, settings.range_m);
  if (report.range_m < limits::min_range_m) return removed(report, Reason::terrain_missing);
  if (report.range_m < settings.range_m) add_reason(report.availability, Reason::range_reduced);
  if (terrain.height_over_terrain_m(input.eye) <= 0.0) {
    if (report.window_loaded) renderer.upload_window(terrain.posts());
    return removed(report, Reason::below_terrain);
  }

  // Ground map and error budget.
  const auto map = ground_map(report.local, report.range_m);
  bool refilled = report.window_loaded;
  const auto budget =
      map ? honest_budget(settings, report.camera, map.value(), terrain, input.eye, refilled)
          : Result<ErrorBudget>(map.fault());
  if (refilled) renderer.upload_window(terrain.posts());
  report.window_loaded = refilled;
  if (!budget) return removed(report, Reason::no_bound);
  report.budget = budget.value();
  report.bound_px = report.budget.epsilon_px;
  if (report.bound_px > settings.error_px) add_reason(report.availability, Reason::bound_exceeded);
  if (refused_tiles > 0) add_reason(report.availability, Reason::tile_refused);
  if (report.window.tiles_mismatched > 0) add_reason(report.availability, Reason::tile_refused);

  // Projected grid, error buffer, ray cast.
  PolarGrid grid = grid_for(settings, renderer.sizes(), report.camera);
  if (grid.used) {
    report.nodes = fill_grid_tables(report.camera, map.value(), grid, tables.planes, tables.slopes);
  }
  blocks = frame_blocks(report.local, report.camera, map.value(), grid, terrain.grid(),
                        terrain.summary(), terrain.base_height_m());
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
  renderer.shade(blocks, style_block(report, terrain.grid(), terrain.geoid(), attitude_valid));
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
                   style_block(report, WindowGrid{}, GeoidLookup{}, true));
  }
  return counts;
}

}  // namespace ridgeline
