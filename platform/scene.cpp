#include "platform/scene.hpp"

#include <algorithm>
#include <utility>

namespace ridgeline {
namespace {

double lookup(const void* context, double latitude_deg, double longitude_deg) {
  return undulation_m(*static_cast<const GeoidGrid*>(context), latitude_deg, longitude_deg);
}

}  // namespace

FileProblem Scene::open_files(const SceneSettings& settings, const GeodeticPosition& first) {
  settings_ = settings;
  auto folder = TerrainFolder::open(settings.terrain_folder, settings.extra_tiles, settings.sea);
  if (!folder) return folder.problem();
  folder_ = std::move(folder).value();
  if (settings.geoid != "none") {
    auto geoid = load_geoid(settings.geoid);
    if (!geoid) return geoid.problem();
    geoid_ = std::move(geoid).value();
  }
  geoid_grid_ = geoid_.grid();
  settings_.frame.geoid = {geoid_.name() == "none" ? nullptr : lookup, &geoid_grid_};
  if (!folder_->any_usable()) return folder_->refused().front();
  size_window(first);
  const GeoBox near = range_box(first.latitude_deg, first.longitude_deg, settings_.frame.range_m);
  far_floor_m_ = ridgeline::far_floor_m(*folder_, near);
  if (!folder_->any_usable()) return folder_->refused().front();  // checksums are known by now
  // Nothing stays mapped: a program that locks its memory would read in every tile. The worker
  // chooses anew with its first order.
  constexpr GeoBox nowhere{1e3, 0.0, 1e3, 0.0};
  folder_->select(nowhere);
  return {};
}

void Scene::size_window(const GeodeticPosition& first) {
  const std::vector<PostGrid> grids = folder_->grids();
  lattice_ = lattice_of(grids, first);
  const double range_m = settings_.frame.range_m;
  const GeoBox cap = range_box(90.0 - polar_leave_deg(range_m), 0.0, range_m);
  polar_ = std::any_of(grids.begin(), grids.end(), [&](const PostGrid& grid) {
    return std::max(grid.north_deg(), -grid.south_deg) > cap.south_deg;
  });
  window_ =
      window_sizes(lattice_, first.latitude_deg, range_m, settings_.terrain_gpu_bytes, polar_);
}

Status Scene::open_renderer(const TimerFunctions& timer, ShaderLog log) {
  const ImageGeometry& image = settings_.frame.image;
  const RenderSizes sizes{image.width_px, image.height_px, window_, limits::max_planes,
                          limits::max_rows};
  auto renderer = Renderer::make(sizes, timer, log);
  if (!renderer) return renderer.fault();
  renderer_ = std::move(renderer).value();
  planes_.resize(sizes.planes);
  slopes_.resize(sizes.rows);
  text_.resize(static_cast<std::size_t>(image.width_px) * image.height_px);
  const auto tiles =
      static_cast<std::size_t>(most_tiles(image.width_px)) * most_tiles(image.height_px);
  ray_tiles_.resize(tiles);
  tile_steepness_.resize(tiles);
  tile_shapes_.resize(tiles);
  tile_looks_.resize(tiles);
  block_bearing_ = std::make_unique<BlockBearing>();
  range_words_.resize(Renderer::scratch_words(image.width_px, image.height_px));
  warm_up();
  return {};
}

void Scene::open_terrain(std::span<const TerrainEdit> edits) {
  worker_ = std::make_unique<BlockWorker>(
      *folder_, BlockWorker::Settings{lattice_, window_.levels, far_floor_m_, settings_.frame.geoid,
                                      settings_.arrival, polar_, settings_.read_delay_us});
  worker_->know_edits(edits);
  held_.resize(static_cast<std::size_t>(window_.levels) * window_.blocks());
  finest_posts_.resize(static_cast<std::size_t>(window_.columns()) * window_.rows());
  finest_rests_.resize(finest_posts_.size());
  terrain_.emplace(*worker_, lattice_, window_, held_, FinestPosts{finest_posts_, finest_rests_},
                   polar_ ? settings_.frame.range_m : 0.0);
}

void Scene::warm_up() {
  FrameBlocks nothing{};
  nothing.frame.ray_origin.w = -1.0f;  // a display range that every ray has left
  nothing.frame.window.z = 1;
  nothing.frame.level_size = {64.0f, 64.0f, 1.0f / 65.0f, 1.0f / 65.0f};
  renderer_->upload_block(TerrainBlock{}, BlockSlot{});
  for (RayTile& tile : std::span(ray_tiles_).first(2)) tile.size = RayTile::pair(1, 1);
  renderer_->draw_terrain(nothing, std::span(planes_).first(1), std::span(slopes_).first(1),
                          {std::span(ray_tiles_).first(2), 1});  // ground and plain sky
  std::fill(text_.begin(), text_.end(), static_cast<std::uint8_t>(shader::text_ink));
  renderer_->upload_text(text_);
  for (const Shading shading :
       {Shading::plain, Shading::facets, Shading::no_lines, Shading::full}) {
    for (const float kept : {0.5F, 1.0F}) {  // by night as well
      renderer_->shade(nothing, shader::StyleBlock{}, shading, Dimming{kept, kept});
    }
  }
  static_cast<void>(renderer_->read_counters());
}

double Scene::geoid_undulation_m(double latitude_deg, double longitude_deg) const {
  return geoid_.name() == "none" ? 0.0 : undulation_m(geoid_grid_, latitude_deg, longitude_deg);
}

}  // namespace ridgeline
