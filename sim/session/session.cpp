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
  SceneSettings settings;
  settings.terrain_folder = options.terrain_folder;
  settings.geoid = options.geoid;
  settings.extra_tiles = &geotiff_;
  settings.frame = options.settings;
  using From = SceneOptions::Arrival;
  settings.arrival = options.arrival == From::as_ready      ? BlockWorker::Arrival::as_ready
                     : options.arrival == From::as_recorded ? BlockWorker::Arrival::as_recorded
                                                            : BlockWorker::Arrival::in_step;
  settings.terrain_gpu_bytes = options.terrain_gpu_bytes;
  settings.read_delay_us = options.read_delay_us;
  if (!options.coverage_file.empty()) {
    auto list = coverage_list(options.coverage_file);
    if (!list) return {list.problem().fault, list.problem().message};
    settings.sea = std::move(list).value();
  }
  if (const FileProblem problem = scene_.open_files(settings, first);
      problem.fault != Fault::none) {
    return {problem.fault, problem.message};
  }
  if (Outcome opened = open_edits(); !opened.ok()) return opened;
  if (Outcome opened = open_renderer(); !opened.ok()) return opened;
  scene_.open_terrain(core_edits_);
  if (options.method.name.empty() || is_own_method(options.method)) return {};
  std::string problem;
  auto method = make_method(options.method, problem);
  if (method == nullptr) return {Fault::file_malformed, problem};
  use(&keep(std::move(method)));
  return {};
}

/// Reads the edits and checks that each has the posts of some tile.
Outcome Session::open_edits() {
  if (options_.edit_file.empty()) return {};
  auto list = edit_list(options_.edit_file);
  if (!list) return {list.problem().fault, list.problem().message};
  edits_ = std::move(list).value();
  std::vector<PostGrid> tiles = scene_.folder().grids();
  const std::vector<PostGrid> sea = scene_.folder().sea_grids();
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
  scene_.terrain().edit(std::span(edit_grids_).subspan(before, edits_applied_ - before),
                        scene_.renderer());
}

Outcome Session::open_renderer() {
  auto context = EglContext::make();
  if (!context) return {context.fault(), "graphics: " + std::string(fault_text(context.fault()))};
  context_ = std::move(context).value();
  const Status made = scene_.open_renderer(context_->timer_functions(), print_shader_log);
  if (!made) return {made.fault(), "graphics: " + std::string(fault_text(made.fault()))};
  rgba_.resize(4 * scene_.pixels());
  return {};
}

void Session::settle_if_due(const FrameInput& input) {
  const bool placed = input.availability.mode != Mode::removed && local_frame(input.eye).ok();
  const bool always = options_.arrival == SceneOptions::Arrival::settled;
  const bool never = options_.arrival == SceneOptions::Arrival::as_ready ||
                     options_.arrival == SceneOptions::Arrival::as_recorded;
  if (!placed || never || (settled_ && !always)) return;
  scene_.settle(input.eye);
  settled_ = true;
}

Session::~Session() {
  if (context_) context_->make_current();  // its GL objects are deleted in its own context
}

Picture Session::draw(const FrameInput& input, bool want_pixels) {
  Picture picture;
  double start_ms = 0, start_core_ms = 0;
  context_->make_current();
  picture.problem = prepare(input);
  if (!picture.problem.ok()) {
    picture.report.availability.mode = Mode::removed;
    return picture;
  }
  FrameSettings settings = scene_.settings();
  if (method_ != nullptr) settings.instead = {draw_with_method, method_};
  {
    const HeapSection no_heap;  // the frame path of the module; what follows is the desktop's
    const GlSection no_new_objects;
    apply_edits(static_cast<double>(input.time_ns) * 1e-9);
    settle_if_due(input);
    start_core_ms = process_ms();
    start_ms = now_ms();
    picture.report = scene_.draw(settings, input);
    picture.counts = scene_.finish(picture.report);
    end_pace(settings, picture.report);
  }
  picture.cpu_ms = now_ms() - start_ms;
  picture.core_ms = process_ms() - start_core_ms;
  picture.since_start_ms = now_ms() - program_start_ms;
  picture.take = scene_.worker().last_take();
  if (settings.pace != nullptr) {
    const PaceRecord& record = settings.pace->record();
    picture.plan = record.plan;
    picture.elapsed_ns = record.readings[record.readings.size() - 1].elapsed_ns;
  }
  if (method_ != nullptr && picture.report.availability.mode != Mode::removed) {
    picture.method = method_->facts();
    picture.counts.ray_cast_share = picture.method.ray_cast_share;
  }
  picture.wanted_px = scene_.settings().error_px;
  picture.wanted_range_m = scene_.settings().range_m;
  if (!want_pixels) return picture;
  const std::size_t pixels = scene_.pixels();
  if (picture.report.availability.mode != Mode::removed) {
    picture.range_m.resize(pixels);
    scene_.read_range(picture.range_m);
    if (method_ != nullptr) method_->finish_picture(scene_.renderer());
  }
  scene_.read_colour(rgba_);
  picture.rgb.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] = rgba_[4 * i + c];
  }
  return picture;
}

}  // namespace ridgeline::sim
