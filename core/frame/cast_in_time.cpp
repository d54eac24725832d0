#include "core/frame/cast_in_time.hpp"

#include <algorithm>

namespace ridgeline {
namespace {

/// A plan in thousandths of that of the reference picture: most of it goes by the tiles.
std::int64_t plan_of(std::int64_t pixels) {
  constexpr std::int64_t reference_pixels = 1024 * 800;
  return 100 + 900 * pixels / reference_pixels;
}

std::span<const RayTile> tiles_of(const FrameTables& tables, int first, int count) {
  return std::span<const RayTile>(tables.tiles.tiles)
      .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
}

std::int64_t rays_of(std::span<const RayTile> tiles) {
  std::int64_t rays = 0;
  for (const RayTile& tile : tiles) {
    const BlockShape shape = tile.shape();
    rays += static_cast<std::int64_t>((tile.width() + shape.width - 1) / shape.width) *
            ((tile.height() + shape.height - 1) / shape.height);
  }
  return rays;
}

/// The cast of one frame as far as it is.
class PacedCast {
 public:
  PacedCast(const CastScene& scene, FrameReport& report)
      : scene_(scene), pace_(*scene.settings.pace), report_(report) {}

  bool run();

 private:
  /// Plans the picture from a row of tiles on.
  void plan(const TileCut& cut);
  /// Rows of tiles that make up the next band.
  [[nodiscard]] int band_rows() const;
  [[nodiscard]] FrameWork left() const;
  [[nodiscard]] bool can_coarsen() const;
  /// Plans what is not cast yet with the largest bound.
  void coarsen();

  const CastScene& scene_;
  FramePace& pace_;
  FrameReport& report_;
  RayTilePlan plan_;  ///< of the rows of tiles below the cut
  TileCut cut_;
  int kept_tiles_ = 0;  ///< above the cut, all of them cast
  int rows_cast_ = 0;   ///< below the cut
  std::int64_t rays_cast_ = 0, rays_left_ = 0;
  std::int64_t band_rays_ = 0;  ///< about so many in a band
};

void PacedCast::plan(const TileCut& cut) {
  const RayTileTables& tables = scene_.tables.tiles;
  const RayTileTables below{tables.tiles.subspan(static_cast<std::size_t>(kept_tiles_)),
                            tables.steepness, tables.shapes};
  plan_ = plan_ray_tiles(scene_.terrain, report_.local, report_.camera,
                         sharing_of(scene_.settings, report_), below, cut);
  cut_ = cut;
  rows_cast_ = 0;
  rays_left_ = plan_.rays;
  report_.rays = static_cast<int>(rays_cast_ + rays_left_);
  report_.shared_px = std::max(report_.shared_px, plan_.shared_px);
  report_.work.plans += plan_of(static_cast<std::int64_t>(report_.camera.width_px) *
                                (report_.camera.height_px - cut.from_px));
}

FrameWork PacedCast::left() const {
  FrameWork work;
  const std::int64_t pixels =
      static_cast<std::int64_t>(report_.camera.width_px) * report_.camera.height_px;
  work.rays = rays_left_;
  work.shaded = rays_cast_ + rays_left_;
  work.pixels = pixels;
  return work;
}

bool PacedCast::can_coarsen() const {
  const double most_px = pace_.budget().settings.most_px;
  if (report_.finished_coarser || scene_.settings.cast_every_pixel ||
      !(report_.bound_px < most_px)) {
    return false;
  }
  // Below a cut a picture needs room for its border, and polar charts share no rays.
  const int from_px = scene_.tables.tiles
                          .tiles[static_cast<std::size_t>(
                              kept_tiles_ + std::min(rows_cast_, plan_.rows - 1) * plan_.columns)]
                          .y();
  const int height_px = report_.camera.height_px - from_px;
  FrameWork rays, plan;
  rays.rays = rays.shaded = rays_left_;
  plan.plans = plan_of(static_cast<std::int64_t>(report_.camera.width_px) * height_px);
  // Less than two plans' worth of rays is not worth another plan.
  const bool worth_it =
      nominal_ns(rays, pace_.plan().detail) > 2 * nominal_ns(plan, pace_.plan().detail);
  return worth_it && !scene_.terrain.lattice().polar() && height_px >= 4 * cut_ring_px;
}

void PacedCast::coarsen() {
  report_.bound_px = report_.budget.epsilon_px = pace_.budget().settings.most_px;
  report_.finished_coarser = true;
  add_reason(report_.availability, Reason::bound_for_time);
  TileCut cut;
  if (rows_cast_ > 0) {
    kept_tiles_ += rows_cast_ * plan_.columns;
    cut = {rows_cast_, scene_.tables.tiles.tiles[static_cast<std::size_t>(kept_tiles_)].y()};
  }
  plan(cut);
  // So that a frame has no more bands than its record has room for.
  band_rays_ = std::max(band_rays_, rays_left_ / limits::budget_bands);
}

int PacedCast::band_rows() const {
  std::int64_t rays = 0;
  int rows = 0;
  while (rows_cast_ + rows < plan_.rows && rays < band_rays_) {
    const int first = kept_tiles_ + (rows_cast_ + rows) * plan_.columns;
    rays += rays_of(tiles_of(scene_.tables, first, plan_.columns));
    ++rows;
  }
  return rows;
}

bool PacedCast::run() {
  plan({});
  FrameWork ahead = left();
  ahead.nodes = report_.nodes;
  LateVerdict verdict = pace_.reached(FrameStage::plan, report_.work, ahead, can_coarsen());
  if (verdict == LateVerdict::give_up) return false;
  if (verdict == LateVerdict::coarser) {
    coarsen();
    ahead = left();
    ahead.nodes = report_.nodes;
    verdict = pace_.reached(FrameStage::plan, report_.work, ahead, false);
    if (verdict == LateVerdict::give_up) return false;
  }
  const FrameTables& tables = scene_.tables;
  scene_.renderer.begin_terrain(scene_.blocks,
                                tables.planes.first(static_cast<std::size_t>(report_.planes)),
                                tables.slopes.first(static_cast<std::size_t>(report_.rows)),
                                tiles_of(tables, 0, plan_.tiles));
  report_.work.nodes = report_.nodes;
  band_rays_ = std::max<std::int64_t>(1, rays_left_ / limits::budget_bands);
  while (rows_cast_ < plan_.rows) {
    const int rows = band_rows(), first = kept_tiles_ + rows_cast_ * plan_.columns;
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(plan_.columns);
    scene_.renderer.cast_tiles(static_cast<std::size_t>(first), count);
    const std::int64_t rays = rays_of(tiles_of(tables, first, static_cast<int>(count)));
    rows_cast_ += rows;
    rays_cast_ += rays;
    rays_left_ -= rays;
    report_.work.rays = rays_cast_;
    verdict = pace_.reached(FrameStage::cast, report_.work, left(), can_coarsen());
    if (verdict == LateVerdict::give_up) return false;
    if (verdict == LateVerdict::coarser) {
      coarsen();
      scene_.renderer.replace_tiles(scene_.blocks, tiles_of(tables, 0, kept_tiles_ + plan_.tiles));
    }
  }
  scene_.renderer.end_range();
  return true;
}

}  // namespace

RaySharing sharing_of(const FrameSettings& settings, const FrameReport& report) {
  constexpr double rounding_px = 1e-3;  // of the middle of a block
  const double left_px = report.bound_px - report.budget.smallest_px() - rounding_px;
  return {report.range_m, settings.cast_every_pixel ? 0.0 : left_px, report.bound_px,
          report.budget.geometry_px};
}

bool cast_in_time(const CastScene& scene, FrameReport& report) {
  if (scene.settings.pace != nullptr) return PacedCast(scene, report).run();
  const FrameTables& tables = scene.tables;
  const RayTilePlan rays = plan_ray_tiles(scene.terrain, report.local, report.camera,
                                          sharing_of(scene.settings, report), tables.tiles);
  report.rays = rays.rays;
  report.shared_px = rays.shared_px;
  scene.renderer.draw_terrain(
      scene.blocks, tables.planes.first(static_cast<std::size_t>(report.planes)),
      tables.slopes.first(static_cast<std::size_t>(report.rows)), tiles_of(tables, 0, rays.tiles));
  return true;
}

}  // namespace ridgeline
