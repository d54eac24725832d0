#include "core/frame/frame_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/frame/cast_in_time.hpp"
#include "core/frame/level_error.hpp"
#include "core/frame/picture.hpp"

namespace ridgeline {
namespace {

constexpr int grid_attempts = 8;     ///< to fit the grid into its capacity
constexpr double coarser = 1.5;      ///< wider spacing for the next attempt
constexpr double least_share = 2.0;  ///< of the height over the lowest ground: a cut range's least
constexpr double most_of_distance = 8e-5;  ///< by which distances may be off where a ray looks down
constexpr double wider_from_px = 2.0;      ///< bound from which the grid may be wider
constexpr double widest = 2.0;             ///< and by how much at most
constexpr double bound_growth = 1.1;       ///< step by which a bound that cannot be met is raised

/// The display range of a frame, and what it can promise for it.
struct Promise {
  double range_m = 0;
  GroundMap map;
  ErrorBudget budget;
};

HeightRounding rounding_of(const WindowSummary& window, const Clearance& clearance) {
  HeightRounding rounding;
  rounding.largest_m = std::max(std::abs(window.highest_m), std::abs(window.lowest_m));
  rounding.relief_of_distance = clearance.relief_of_distance;
  rounding.distance_m = clearance.drawn_m;
  if (clearance.near_ground) {
    rounding.near_distance_m = clearance.near_m;
    rounding.near_steepest = clearance.near_steepest;
  }
  return rounding;
}

/// Sine of the angle by which the steepest ray of the picture looks down; 0 where none does.
double steepest_look(const Camera& camera) {
  const double down_rad = -std::asin(std::clamp(camera.enu_from_camera.columns[2].z, -1.0, 1.0)) +
                          camera.half_diagonal_rad(0.0);
  return std::sin(std::clamp(down_rad, 0.0, 0.5 * std::numbers::pi));
}

/// The smallest bound not below the wanted one that this pose and this terrain allow over a range;
/// where completeness is what does not allow it, the smallest of a few steps.
Result<Promise> promise_over(const FrameSettings& settings, const FrameReport& report,
                             const TerrainKeeper& terrain, const Clearance& clearance,
                             const LevelError& levels) {
  const auto map = ground_map(report.local, levels.clear_range_m, terrain.lattice().chart,
                              {report.window.lowest_m, report.window.highest_m});
  if (!map) return map.fault();
  const HeightRounding rounding = rounding_of(report.window, clearance);
  // What a height is off by is made up for by a turn, but for what shows along a ray that looks
  // down: the contract lets that go up to a part in ten thousand.
  if (rounding.of_distance() * steepest_look(report.camera) > most_of_distance) {
    return Fault::no_error_bound;
  }
  Promise promise{levels.clear_range_m, map.value(), {}};
  ErrorBudget& budget = promise.budget;
  budget = error_budget(report.camera, map.value(), levels.angle_px, levels.steepest, rounding);
  double bound_px = std::max(settings.error_px, budget.smallest_px());
  for (; bound_px <= limits::max_error_px; bound_px *= bound_growth) {
    if (!stays_complete(report.camera, bound_px, levels, budget.geometry_rad)) continue;
    budget.epsilon_px = bound_px;
    return promise;
  }
  return Fault::no_error_bound;
}

/// What this frame can promise: over as much of the range as can be drawn or, where that allows no
/// bound, over the part of it in which the posts themselves are drawn.
Result<Promise> honest_promise(const FrameSettings& settings, const FrameReport& report,
                               const TerrainKeeper& terrain, const Clearance& clearance) {
  LevelError levels =
      level_error(terrain, report.local, report.camera, report.range_m, clearance.distance_m);
  // A range that ends before the ground below would show sky where there is none.
  const double deep_m = report.local.eye.height_m - report.window.lowest_m;
  const double least_m =
      std::max(limits::min_range_m, std::min(levels.known_range_m, least_share * deep_m));
  Result<Promise> promise = Fault::no_error_bound;
  if (levels.clear_range_m >= least_m) {
    promise = promise_over(settings, report, terrain, clearance, levels);
  }
  const double exact_m = levels.exact_range_m;
  if (promise || exact_m < least_m || exact_m >= levels.clear_range_m) return promise;
  levels = level_error(terrain, report.local, report.camera, exact_m, clearance.distance_m);
  if (levels.clear_range_m < least_m) return promise;
  return promise_over(settings, report, terrain, clearance, levels);
}

/// The grid as dense as wanted, or as its capacity allows: spacing costs time, never a pixel.
/// Larger bounds have fewer rays for it to save steps for.
PolarGrid grid_for(const FrameSettings& settings, const RenderSizes& sizes, const Camera& camera) {
  PolarGrid grid;
  GridSpacing spacing = settings.node_spacing;
  const double wider = std::clamp(settings.error_px / wider_from_px, 1.0, widest);
  spacing.planes_px *= wider;
  spacing.rows_px *= wider;
  for (int attempt = 0; attempt < grid_attempts && !settings.cast_every_pixel; ++attempt) {
    grid = polar_grid(camera, spacing);
    if (grid.plane_count <= sizes.planes && grid.row_count <= sizes.rows) return grid;
    if (grid.plane_count > sizes.planes) spacing.planes_px *= coarser;
    if (grid.row_count > sizes.rows) spacing.rows_px *= coarser;
  }
  grid.used = false;
  return grid;
}

/// The frame of a method that promises nothing: no budget, no grid, the whole range.
FrameReport draw_instead(const FrameSettings& settings, FrameReport report,
                         const TerrainKeeper& terrain, Renderer& renderer, FrameBlocks& blocks) {
  add_reason(report.availability, Reason::unproven);
  const auto map = ground_map(report.local, report.range_m, terrain.lattice().chart,
                              {report.window.lowest_m, report.window.highest_m});
  if (!map) {
    add_reason(report.availability, Reason::no_bound);
    return report;
  }
  const TerrainView view = terrain.view();
  blocks = frame_blocks(report.local, report.camera, map.value(), PolarGrid{}, view,
                        report.window.highest_m);
  renderer.begin_range(blocks);
  settings.instead.draw(settings.instead.context, {report, map.value(), view, blocks, renderer});
  renderer.end_range();
  return report;
}

FrameReport removed(FrameReport report, Reason reason) {
  add_reason(report.availability, reason);
  return report;
}

/// Says what the picture lacks for the sake of time.
void tell_plan(const FrameSettings& settings, const FramePlan& plan, FrameReport& report) {
  if (report.availability.mode == Mode::removed) {
    report.bound_px = 0;
    report.rays = 0;
    return;
  }
  if (plan.detail != ShadeDetail::full) add_reason(report.availability, Reason::detail_shed);
  if (plan.error_px > settings.error_px) add_reason(report.availability, Reason::bound_for_time);
  if (report.bound_px > settings.error_px) add_reason(report.availability, Reason::bound_exceeded);
}

/// As the monitor planned it, and without lines where the pilot wants none. The monitor goes on as
/// if they were there: what it has learnt does not change with a switch.
Shading shading_of(const FrameReport& report) {
  if (report.availability.mode == Mode::removed) return Shading::plain;
  const ShadeDetail most = report.display.declutter ? ShadeDetail::no_lines : ShadeDetail::full;
  return static_cast<Shading>(std::max(report.detail, most));
}

FrameReport draw_terrain(const FrameSettings& settings, const FrameInput& input,
                         TerrainKeeper& terrain, int refused_tiles, const FrameTables& tables,
                         Renderer& renderer, FrameBlocks& blocks, bool& attitude_valid) {
  FrameReport report;
  report.time_ns = input.time_ns;
  report.availability = input.availability;
  report.display = input.display;
  report.work.frames = 1;
  report.work.bus_frames = input.bus_frames;

  // Camera first: a frame without terrain still shows the attitude.
  const auto camera_made = camera(input.attitude, settings.image);
  // An attitude that is no attitude still needs a picture, which says so: a level camera's size.
  const auto any_camera = camera_made ? camera_made : camera({}, settings.image);
  RL_ASSERT(any_camera);  // the image geometry was checked at boot
  report.camera = any_camera.value();
  blocks = camera_blocks(report.camera);
  renderer.use_single_rays();
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
  report.work.blocks = report.window.blocks_arrived;
  if (settings.pace != nullptr) {
    settings.pace->reached(FrameStage::terrain, report.work, {}, false);
    if (!settings.pace->plan().terrain) return removed(report, Reason::overload);
  }
  report.range_m = terrain.covered_range_m(input.eye, settings.range_m);
  if (report.range_m < limits::min_range_m) {
    return removed(report,
                   report.window.complete ? Reason::terrain_missing : Reason::terrain_loading);
  }
  if (report.window.known_posts == 0) return removed(report, Reason::terrain_missing);
  const Clearance clearance = terrain.clearance(input.eye);
  report.over_ground_m = clearance.over_m;
  if (clearance.kind == Clearance::Kind::below) return removed(report, Reason::below_terrain);
  if (clearance.kind == Clearance::Kind::undecided) return removed(report, Reason::terrain_loading);

  if (settings.instead.draw != nullptr) {
    return draw_instead(settings, report, terrain, renderer, blocks);
  }

  // Error budget: range, ground map and bound.
  const auto promise = honest_promise(settings, report, terrain, clearance);
  if (!promise) return removed(report, Reason::no_bound);
  const GroundMap& map = promise.value().map;
  report.range_m = promise.value().range_m;
  report.budget = promise.value().budget;
  if (report.range_m < settings.range_m) add_reason(report.availability, Reason::range_reduced);
  report.bound_px = report.budget.epsilon_px;
  if (report.bound_px > settings.error_px) add_reason(report.availability, Reason::bound_exceeded);
  if (refused_tiles > 0) add_reason(report.availability, Reason::tile_refused);
  if (report.window.mismatched_tiles > 0) add_reason(report.availability, Reason::tile_refused);

  // Projected grid, error buffer, ray cast.
  PolarGrid grid = grid_for(settings, renderer.sizes(), report.camera);
  if (grid.used) {
    report.nodes = fill_grid_tables(report.camera, map, grid, tables.planes, tables.slopes);
  }
  TerrainView view = terrain.view();
  if (clearance.near_ground) view.near = terrain.near_ground();
  blocks = frame_blocks(report.local, report.camera, map, grid, view, report.window.highest_m);
  report.planes = grid.used ? grid.plane_count : 0;
  report.rows = grid.used ? grid.row_count : 0;
  if (!grid.used) report.nodes = 0;
  if (!cast_in_time({settings, terrain, tables, blocks, renderer}, report)) {
    return removed(report, Reason::overload);
  }
  return report;
}

}  // namespace

FrameReport draw_frame(const FrameSettings& settings, const FrameInput& input,
                       TerrainKeeper& terrain, int refused_tiles, const FrameTables& tables,
                       Renderer& renderer) {
  FrameBlocks blocks{};
  bool attitude_valid = input.attitude_valid;
  FrameSettings planned = settings;
  FramePlan plan;
  plan.error_px = settings.error_px;
  if (settings.pace != nullptr) plan = settings.pace->begin(input.bus_frames);
  planned.error_px = plan.error_px;
  FrameReport report = draw_terrain(planned, input, terrain, refused_tiles, tables, renderer,
                                    blocks, attitude_valid);
  report.detail = plan.detail;
  tell_plan(settings, plan, report);
  if (report.availability.mode == Mode::removed) renderer.use_single_rays();
  renderer.upload_text(text_layer(report, tables.text));
  renderer.shade(blocks, style_block(report, terrain.lattice(), settings.geoid, attitude_valid),
                 shading_of(report), dimming_of(report.display, attitude_valid));
  const auto pixels = static_cast<std::int64_t>(report.camera.width_px) * report.camera.height_px;
  if (report.availability.mode == Mode::removed) report.work.shaded = 0;
  report.work.pixels = pixels;
  return report;
}

void end_pace(const FrameSettings& settings, const FrameReport& report) {
  if (settings.pace == nullptr) return;
  settings.pace->end(report.work, report.bound_px);
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
    renderer.use_single_rays();
    renderer.upload_text(text_layer(report, tables.text));
    renderer.shade(camera_blocks(report.camera),
                   style_block(report, PostLattice{}, GeoidLookup{}, true), Shading::plain,
                   dimming_of(report.display, true));
  }
  return counts;
}

}  // namespace ridgeline
