#include <algorithm>
#include <chrono>

#include "sim/session/session.hpp"

namespace ridgeline::sim {
namespace {

double now_ms() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace

Method& Session::keep(std::unique_ptr<Method> method) {
  methods_.push_back({std::move(method), std::nullopt, 0});
  return *methods_.back().method;
}

double Session::build_ms() const {
  for (const Kept& kept : methods_) {
    if (kept.method.get() == method_) return kept.build_ms;
  }
  return 0;
}

Session::WindowState Session::window_state() const {
  const TerrainView view = scene_.terrain().view();
  return {scene_.worker().blocks_taken(), edits_applied_, view.lattice.chart, view.drawable};
}

MethodTerrain Session::method_terrain() {
  const WindowState state = window_state();
  if (method_posts_of_ != state) {
    // From blocks of 64 x 64 posts, one after the other, to rows.
    const std::span<const float> posts = scene_.finest_posts_m();
    method_posts_.resize(posts.size());
    const auto columns = static_cast<std::size_t>(scene_.window().columns());
    for (std::size_t b = 0; b < static_cast<std::size_t>(scene_.window().blocks()); ++b) {
      const std::size_t row = b / scene_.window().column_blocks * block_posts;
      const std::size_t column = b % scene_.window().column_blocks * block_posts;
      const float* from = posts.data() + b * block_posts * block_posts;
      for (std::size_t r = 0; r < block_posts; ++r, from += block_posts) {
        std::copy(from, from + block_posts, &method_posts_[(row + r) * columns + column]);
      }
    }
    method_posts_of_ = state;
  }
  const WindowSummary summary = scene_.terrain().summary();
  return {scene_.terrain().view(), method_posts_, summary.lowest_m, summary.highest_m,
          scene_.settings().range_m};
}

void Session::warm_up(const FrameInput& input) {
  FrameSettings settings = scene_.settings();
  settings.pace = nullptr;
  const auto draw = [](void* method, const RangeScene& scene) {
    static_cast<Method*>(method)->warm_up(scene);
  };
  settings.instead = {draw, method_};
  FrameReport report = scene_.draw(settings, input);
  scene_.finish(report);
}

Outcome Session::prepare(const FrameInput& input) {
  if (method_ == nullptr) return {};
  if (input.availability.mode == Mode::removed || !local_frame(input.eye).ok()) return {};
  context_->make_current();
  apply_edits(static_cast<double>(input.time_ns) * 1e-9);
  scene_.settle(input.eye);
  settled_ = true;
  const WindowState state = window_state();
  const auto kept = std::find_if(methods_.begin(), methods_.end(),
                                 [&](const Kept& k) { return k.method.get() == method_; });
  RL_ASSERT(kept != methods_.end());
  if (kept->built == state || scene_.terrain().summary().known_posts == 0) return {};
  const MethodTerrain terrain = method_terrain();
  const double start_ms = now_ms();
  Outcome built = method_->build(terrain, scene_.renderer().sizes());
  kept->build_ms = now_ms() - start_ms;
  if (!built.ok()) return built;
  if (!kept->built) warm_up(input);
  kept->built = state;
  return built;
}

Outcome Session::use_counting(bool counting) {
  if (method_ != nullptr) return method_->use_counting(counting);
  step_counter_.exchange(scene_.renderer());
  return {};
}

Picture Session::draw_counting(const FrameInput& input, bool want_pixels,
                               std::optional<StepCounts>& steps) {
  const RaySteps rays = method_ == nullptr ? RaySteps::counted : method_->ray_steps();
  const auto draw_plain = [&](const std::optional<StepCounts>& told) {
    Picture picture = draw(input, want_pixels);
    steps = picture.report.availability.mode == Mode::removed ? std::nullopt : told;
    return picture;
  };
  context_->make_current();
  if (rays == RaySteps::no_rays) return draw_plain(StepCounts{});
  if (rays == RaySteps::not_counted || !StepCounter::possible()) return draw_plain(std::nullopt);
  Outcome ready = step_counter_.make(scene_.renderer());
  if (ready.ok()) ready = prepare(input);
  if (ready.ok()) ready = use_counting(true);
  if (!ready.ok()) {
    Picture none;
    none.report.availability.mode = Mode::removed;
    none.problem = ready;
    return none;
  }
  step_counter_.begin();
  Picture picture = draw_plain(std::nullopt);
  const StepCounts counted = step_counter_.end();
  if (picture.report.availability.mode != Mode::removed) steps = counted;
  const Outcome ended = use_counting(false);
  RL_ASSERT(ended.ok());
  return picture;
}

}  // namespace ridgeline::sim
