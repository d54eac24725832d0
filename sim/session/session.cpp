#include "sim/session/session.hpp"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "sim/terrain_input/coverage_list.hpp"

namespace ridgeline::sim {
namespace {

double now_ms() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(time).count();
}

double process_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

const double program_start_ms = now_ms();

void print_shader_log(std::string_view program, std::string_view log) {
  std::fprintf(stderr, "shader %.*s: %.*s\n", static_cast<int>(program.size()), program.data(),
               static_cast<int>(log.size()), log.data());
}

double lookup(const void* context, double latitude_deg, double longitude_deg) {
  return undulation_m(*static_cast<const GeoidGrid*>(context), latitude_deg, longitude_deg);
}

/// Whether the posts of an edit are posts of a tile of the same steps.
bool same_posts(const PostGrid& edit, const PostGrid& tile) {
  constexpr double same_step = 1e-6, same_post = 1e-3;
  const auto equal = [](double a, double b) { return std::abs(a / b - 1.0) < same_step; };
  if (!equal(edit.latitude_step_deg, tile.latitude_step_deg) ||
      !equal(edit.longitude_step_deg, tile.longitude_step_deg)) {
    return false;
  }
  const GeoBox box{edit.south_deg, edit.west_deg, edit.north_deg(), edit.east_deg()};
  const double row = (edit.south_deg - tile.south_deg) / tile.latitude_step_deg;
  const double column = (edit.west_deg - tile.west_deg) / tile.longitude_step_deg;
  return overlaps(box, tile) && std::abs(row - std::round(row)) < same_post &&
         std::abs(column - std::round(column)) < same_post;
}

void draw_with_method(void* method, const RangeScene& scene) {
  // No grid pass; a method with a ray cast of its own may stamp its start again.
  scene.renderer.timer().stamp(static_cast<int>(Pass::ray_cast));
  static_cast<Method*>(method)->draw(scene);
}

}  // namespace

Outcome Session::open(const SceneOptions& options, const GeodeticPosition& first) {
  options_ = options;
  std::vector<TileLocation> sea;
  if (!options.coverage_file.empty()) {
    auto list = coverage_list(options.coverage_file);
    if (!list) return {list.problem().fault, list.problem().message};
    sea = std::move(list).value();
  }
  auto folder = TerrainFolder::open(options.terrain_folder, &geotiff_, sea);
  if (!folder) return {folder.problem().fault, folder.problem().message};
  folder_ = std::move(folder).value();
  if (options.geoid != "none") {
    auto geoid = load_geoid(options.geoid);
    if (!geoid) return {geoid.problem().fault, geoid.problem().message};
    geoid_ = std::move(geoid).value();
  }
  geoid_grid_ = geoid_.grid();
  if (Outcome opened = open_folder(first); !opened.ok()) return opened;
  const GeoBox near = range_box(first.latitude_deg, first.longitude_deg, options.settings.range_m);
  const double far_floor = far_floor_m(*folder_, near);
  if (!folder_->any_usable()) {
    return {folder_->refused().front().fault, folder_->refused().front().message};
  }
  if (Outcome opened = open_edits(); !opened.ok()) return opened;
  if (Outcome opened = open_renderer(); !opened.ok()) return opened;
  open_terrain(far_floor);
  if (options.method.name.empty() || is_own_method(options.method)) return {};
  std::string problem;
  auto method = make_method(options.method, problem);
  if (method == nullptr) return {Fault::file_malformed, problem};
  use(&keep(std::move(method)));
  return {};
}

Outcome Session::open_folder(const GeodeticPosition& first) {
  if (!folder_->any_usable()) {
    const FileProblem& first_problem = folder_->refused().front();
    return {first_problem.fault, first_problem.message};
  }
  const std::vector<PostGrid> grids = folder_->grids();
  lattice_ = lattice_of(grids, first);
  const double range_m = options_.settings.range_m;
  const GeoBox cap = range_box(90.0 - polar_leave_deg(range_m), 0.0, range_m);
  polar_ = std::any_of(grids.begin(), grids.end(), [&](const PostGrid& grid) {
    return std::max(grid.north_deg(), -grid.south_deg) > cap.south_deg;
  });
  window_ = window_sizes(lattice_, first.latitude_deg, range_m, options_.terrain_gpu_bytes, polar_);
  return {};
}

/// Reads the edits and checks that each has the posts of some tile.
Outcome Session::open_edits() {
  if (options_.edit_file.empty()) return {};
  auto list = edit_list(options_.edit_file);
  if (!list) return {list.problem().fault, list.problem().message};
  edits_ = std::move(list).value();
  std::vector<PostGrid> tiles = folder_->grids();
  const std::vector<PostGrid> sea = folder_->sea_grids();
  tiles.insert(tiles.end(), sea.begin(), sea.end());
  for (const TerrainEdit& edit : edits_) {
    const bool on_posts = std::any_of(tiles.begin(), tiles.end(), [&](const PostGrid& tile) {
      return same_posts(edit.grid, tile);
    });
    if (!on_posts) {
      return {Fault::file_malformed, options_.edit_file + ":" + std::to_string(edit.line) +
                                         ": its posts are not those of any tile there"};
    }
    core_edits_.push_back({edit.grid, edit.heights_m});
    edit_grids_.push_back(edit.grid);
  }
  return {};
}

void Session::apply_edits(double time_s) {
  const std::size_t before = edits_applied_;
  while (edits_applied_ < edits_.size() && edits_[edits_applied_].time_s <= time_s) {
    ++edits_applied_;
  }
  if (edits_applied_ == before) return;
  terrain_->edit(std::span(edit_grids_).subspan(before, edits_applied_ - before), *renderer_);
}

void Session::open_terrain(double far_floor) {
  const GeoidLookup geoid{geoid_.name() == "none" ? nullptr : lookup, &geoid_grid_};
  options_.settings.geoid = geoid;
  const auto arrival = options_.arrival == SceneOptions::Arrival::as_ready
                           ? BlockWorker::Arrival::as_ready
                           : BlockWorker::Arrival::in_step;
  worker_ = std::make_unique<BlockWorker>(
      *folder_, BlockWorker::Settings{lattice_, window_.levels, far_floor, geoid, arrival, polar_,
                                      options_.read_delay_us});
  worker_->know_edits(core_edits_);
  held_.resize(static_cast<std::size_t>(window_.levels) * window_.blocks());
  finest_posts_.resize(static_cast<std::size_t>(window_.columns()) * window_.rows());
  finest_rests_.resize(finest_posts_.size());
  terrain_.emplace(*worker_, lattice_, window_, held_, FinestPosts{finest_posts_, finest_rests_},
                   polar_ ? options_.settings.range_m : 0.0);
}

Outcome Session::open_renderer() {
  auto surface = EglSurface::make();
  if (!surface) return {surface.fault(), "graphics: " + std::string(fault_text(surface.fault()))};
  surface_ = std::move(surface).value();
  const ImageGeometry& image = options_.settings.image;
  const RenderSizes sizes{image.width_px, image.height_px, window_, limits::max_planes,
                          limits::max_rows};
  auto renderer = Renderer::make(sizes, surface_->timer_functions(), print_shader_log);
  if (!renderer) {
    return {renderer.fault(), "graphics: " + std::string(fault_text(renderer.fault()))};
  }
  renderer_ = std::move(renderer).value();
  const auto pixels = static_cast<std::size_t>(image.width_px) * image.height_px;
  planes_.resize(sizes.planes);
  slopes_.resize(sizes.rows);
  text_.resize(pixels);
  const auto tiles =
      static_cast<std::size_t>(most_tiles(image.width_px)) * most_tiles(image.height_px);
  ray_tiles_.resize(tiles);
  tile_steepness_.resize(tiles);
  tile_shapes_.resize(tiles);
  tile_looks_.resize(tiles);
  block_bearing_ = std::make_unique<BlockBearing>();
  range_words_.resize(Renderer::scratch_words(image.width_px, image.height_px));
  rgba_.resize(4 * pixels);
  warm_up();
  return {};
}

/// Runs every shader once over nothing. A driver compiles a shader at its first use; that belongs
/// to boot, and its allocations are not the frame path's.
void Session::warm_up() {
  FrameBlocks nothing{};
  nothing.frame.ray_origin.w = -1.0f;  // a display range that every ray has left
  nothing.frame.window.z = 1;
  nothing.frame.level_size = {64.0f, 64.0f, 1.0f / 65.0f, 1.0f / 65.0f};
  renderer_->upload_block(TerrainBlock{}, BlockSlot{});
  renderer_->draw_terrain(nothing, std::span(planes_).first(1), std::span(slopes_).first(1),
                          {std::span(ray_tiles_).first(2), 1});  // ground and plain sky
  std::fill(text_.begin(), text_.end(), static_cast<std::uint8_t>(shader::text_ink));
  renderer_->upload_text(text_);
  renderer_->shade(nothing, shader::StyleBlock{});
  static_cast<void>(renderer_->read_counters());
}

void Session::settle_if_due(const FrameInput& input) {
  const bool placed = input.availability.mode != Mode::removed && local_frame(input.eye).ok();
  const bool always = options_.arrival == SceneOptions::Arrival::settled;
  const bool never = options_.arrival == SceneOptions::Arrival::as_ready;
  if (!placed || never || (settled_ && !always)) return;
  terrain_->settle(input.eye, *renderer_);
  settled_ = true;
}

Session::~Session() {
  if (surface_) surface_->make_current();  // its GL objects are deleted in its own context
}

Picture Session::draw(const FrameInput& input, bool want_pixels) {
  Picture picture;
  const FrameTables tables{planes_, slopes_, text_, ray_tiles()};
  double start_ms = 0, start_core_ms = 0;
  surface_->make_current();
  picture.problem = prepare(input);
  if (!picture.problem.ok()) {
    picture.report.availability.mode = Mode::removed;
    return picture;
  }
  FrameSettings settings = options_.settings;
  if (method_ != nullptr) settings.instead = {draw_with_method, method_};
  {
    const HeapSection no_heap;  // the frame path of the module; what follows is the desktop's
    const GlSection no_new_objects;
    apply_edits(static_cast<double>(input.time_ns) * 1e-9);
    settle_if_due(input);
    start_core_ms = process_ms();
    start_ms = now_ms();
    picture.report =
        draw_frame(settings, input, *terrain_, worker_->refused_count(), tables, *renderer_);
    picture.counts = finish_frame(*renderer_, picture.report, tables);
  }
  picture.cpu_ms = now_ms() - start_ms;
  picture.core_ms = process_ms() - start_core_ms;
  picture.since_start_ms = now_ms() - program_start_ms;
  picture.take = worker_->last_take();
  if (method_ != nullptr && picture.report.availability.mode != Mode::removed) {
    picture.method = method_->facts();
    picture.counts.ray_cast_share = picture.method.ray_cast_share;
  }
  picture.wanted_px = options_.settings.error_px;
  picture.wanted_range_m = options_.settings.range_m;
  if (!want_pixels) return picture;
  const auto pixels = text_.size();
  if (picture.report.availability.mode != Mode::removed) {
    picture.range_m.resize(pixels);
    renderer_->read_range(picture.range_m, range_words_);
    if (method_ != nullptr) method_->finish_picture(*renderer_);
  }
  renderer_->read_colour(rgba_);
  picture.rgb.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] = rgba_[4 * i + c];
  }
  return picture;
}

double Session::geoid_undulation_m(double latitude_deg, double longitude_deg) const {
  return geoid_.name() == "none" ? 0.0 : undulation_m(geoid_grid_, latitude_deg, longitude_deg);
}

}  // namespace ridgeline::sim
