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
  for (const RayTile& tile : tiles) rays += tile.ray_count();
  return rays;
}

/// The cast of one frame as far as it is. The list of tiles: ground that is cast, ground that is
/// not, then all plain sky, whose few rays are cast with the last of the ground.
class PacedCast {
 public:
  PacedCast(const CastScene& scene, FrameReport& report)
      : scene_(scene), pace_(*scene.settings.pace), report_(report) {}

  bool run();

 private:
  /// Plans the picture from a row of tiles on, behind ground that is cast and sky that is kept.
  void plan(const TileCut& cut, int kept_sky);
  /// Tiles that make up the next band: whole rows.
  [[nodiscard]] int band_tiles() const;
  void cast_band();
  [[nodiscard]] FrameWork left() const;
  [[nodiscard]] bool can_coarsen() const;
  /// Plans what is not cast yet with the largest bound.
  void coarsen();
  [[nodiscard]] RayTiles shown() const { return {tiles_of(scene_.tables, 0, tiles_), ground_}; }
  [[nodiscard]] const RayTile& tile(int k) const {
    return scene_.tables.tiles.tiles[static_cast<std::size_t>(k)];
  }

  const CastScene& scene_;
  FramePace& pace_;
  FrameReport& report_;
  int ground_ = 0, tiles_ = 0;  ///< of the list
  int cast_ = 0;                ///< the first so many
  std::int64_t rays_cast_ = 0, rays_left_ = 0;
  std::int64_t band_rays_ = 0;  ///< about so many in a band
};

void PacedCast::plan(const TileCut& cut, int kept_sky) {
  RayTileTables below = scene_.tables.tiles;
  below.tiles = below.tiles.subspan(static_cast<std::size_t>(cast_ + kept_sky));
  RaySharing sharing = sharing_of(scene_.settings, report_);
  sharing.may_be_cut = report_.bound_px < pace_.budget().settings.most_px;
  const RayTilePlan plan =
      plan_ray_tiles(scene_.terrain, report_.local, report_.camera, sharing, below, cut);
  // The sky that is kept goes behind the ground that is new.
  const auto sky = scene_.tables.tiles.tiles.begin() + cast_;
  std::rotate(sky, sky + kept_sky, sky + kept_sky + plan.ground_tiles);
  ground_ = cast_ + plan.ground_tiles;
  tiles_ = cast_ + kept_sky + plan.tiles;
  rays_left_ = plan.rays + kept_sky;
  report_.rays = static_cast<int>(rays_cast_ + rays_left_);
  report_.shared_px = std::max(report_.shared_px, plan.shared_px);
  report_.work.plans += plan_of(static_cast<std::int64_t>(report_.camera.width_px) *
                                (report_.camera.height_px - cut.from_px));
}

FrameWork PacedCast::left() const {
  FrameWork work;
  const std::int64_t pixels =
      static_cast<std::int64_t>(report_.camera.width_px) * report_.camera.height_px;
  work.rays = rays_left_;
  work.shaded = rays_cast_ + rays_left_ - (tiles_ - ground_);
  work.pixels = pixels;
  return work;
}

bool PacedCast::can_coarsen() const {
  if (report_.finished_coarser || scene_.settings.cast_every_pixel || cast_ >= ground_ ||
      !(report_.bound_px < pace_.budget().settings.most_px)) {
    return false;
  }
  // Below a cut a picture needs room for its border, and polar charts share no rays.
  const int height_px = report_.camera.height_px - (cast_ > 0 ? tile(cast_).y() : 0);
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
  std::ptrdiff_t kept_sky = 0;
  if (cast_ > 0) {
    cut = {tile(cast_).rays_y() / ray_tile_px, tile(cast_).y()};
    // Plain sky above the cut stays what it is.
    const auto first = scene_.tables.tiles.tiles.begin();
    const auto sky = first + ground_;
    const auto below = std::partition(
        sky, first + tiles_, [&](const RayTile& sky_tile) { return sky_tile.y() < cut.from_px; });
    kept_sky = below - sky;
    std::copy(sky, below, first + cast_);
  }
  plan(cut, static_cast<int>(kept_sky));
  // So that a frame has no more bands than its record has room for.
  band_rays_ = std::max(band_rays_, rays_left_ / limits::budget_bands);
}

int PacedCast::band_tiles() const {
  std::int64_t rays = 0;
  int end = cast_;
  for (; end < ground_; ++end) {
    if (rays >= band_rays_ && tile(end).y() != tile(end - 1).y()) return end - cast_;
    rays += tile(end).ray_count();
  }
  return tiles_ - cast_;
}

void PacedCast::cast_band() {
  const int count = band_tiles();
  scene_.renderer.cast_tiles(cast_, count);
  const std::int64_t rays = rays_of(tiles_of(scene_.tables, cast_, count));
  cast_ += count;
  rays_cast_ += rays;
  rays_left_ -= rays;
  report_.work.rays = rays_cast_;
}

bool PacedCast::run() {
  plan({}, 0);
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
  scene_.renderer.begin_terrain(
      scene_.blocks, tables.planes.first(static_cast<std::size_t>(report_.planes)),
      tables.slopes.first(static_cast<std::size_t>(report_.rows)), shown());
  report_.work.nodes = report_.nodes;
  band_rays_ = std::max<std::int64_t>(1, rays_left_ / limits::budget_bands);
  while (cast_ < tiles_) {
    cast_band();
    verdict = pace_.reached(FrameStage::cast, report_.work, left(), can_coarsen());
    if (verdict == LateVerdict::give_up) return false;
    if (verdict == LateVerdict::coarser) {
      coarsen();
      scene_.renderer.replace_tiles(scene_.blocks, shown());
    }
  }
  report_.work.shaded = left().shaded;
  scene_.renderer.end_range();
  return true;
}

}  // namespace

RaySharing sharing_of(const FrameSettings& settings, const FrameReport& report) {
  constexpr double rounding_px = 1e-3;  // of the middle of a block
  const double left_px = report.bound_px - report.budget.smallest_px() - rounding_px;
  return {report.range_m, left_px, report.bound_px, report.budget.geometry_px,
          settings.cast_every_pixel};
}

bool cast_in_time(const CastScene& scene, FrameReport& report) {
  if (scene.settings.pace != nullptr) return PacedCast(scene, report).run();
  const FrameTables& tables = scene.tables;
  const RayTilePlan plan = plan_ray_tiles(scene.terrain, report.local, report.camera,
                                          sharing_of(scene.settings, report), tables.tiles);
  report.rays = plan.rays;
  report.work.rays = plan.rays;
  report.work.shaded = plan.rays - (plan.tiles - plan.ground_tiles);
  report.shared_px = plan.shared_px;
  scene.renderer.draw_terrain(scene.blocks,
                              tables.planes.first(static_cast<std::size_t>(report.planes)),
                              tables.slopes.first(static_cast<std::size_t>(report.rows)),
                              {tiles_of(tables, 0, plan.tiles), plan.ground_tiles});
  return true;
}

}  // namespace ridgeline
