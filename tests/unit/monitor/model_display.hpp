#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/monitor/frame_pace.hpp"

namespace ridgeline::testing {

/// A machine that is so many times as slow as the reference machine, and what else it does: a stage
/// may take longer by itself.
class ModelMachine : public FrameClock {
 public:
  double slowness = 1;
  std::function<std::int64_t(FrameStage)> extra_ns = [](FrameStage) { return 0; };

  std::int64_t elapsed_ns(FrameStage stage, const FrameWork& done, ShadeDetail detail) override {
    if (stage == FrameStage::input) now_ns_ = counted_ns_ = 0;
    const std::int64_t all_ns = nominal_ns(done, detail);
    now_ns_ += static_cast<std::int64_t>(slowness * static_cast<double>(all_ns - counted_ns_));
    counted_ns_ = all_ns;
    return now_ns_ += extra_ns(stage);
  }

 private:
  std::int64_t now_ns_ = 0, counted_ns_ = 0;
};

/// What became of one frame of the model.
struct ModelFrame {
  FramePlan plan;
  std::int64_t elapsed_ns = 0;
  double bound_px = 0;  ///< 0: no terrain
  bool coarser = false;

  [[nodiscard]] bool in_time(std::int64_t deadline_ns) const { return elapsed_ns <= deadline_ns; }
};

/// Draws nothing, but does the work of a display in the same stages and asks the same questions.
class ModelDisplay {
 public:
  ModelDisplay(const BudgetSettings& settings, ModelMachine& machine) : pace(settings, machine) {}

  static constexpr std::int64_t pixels = 819'200, nodes = 317'000;
  FramePace pace;
  /// Share of the pixels that has a ray of its own for a bound.
  std::function<double(double)> ray_share = [](double error_px) {
    return std::clamp(0.44 * std::pow(error_px, -0.6), 0.10, 1.0);
  };
  int bus_frames = 20;

  /// What a frame takes on the reference machine with a bound.
  [[nodiscard]] std::int64_t nominal_frame_ns(double error_px) const {
    FrameWork work{1, bus_frames, 0, 1000, nodes, rays_of(error_px), rays_of(error_px), pixels};
    return nominal_ns(work, ShadeDetail::full);
  }

  ModelFrame frame() {
    ModelFrame result;
    result.plan = pace.begin(bus_frames);
    FrameWork done;
    done.frames = 1;
    done.bus_frames = bus_frames;
    pace.reached(FrameStage::terrain, done, {}, false);
    if (result.plan.terrain) cast(done, result);
    done.shaded = result.bound_px > 0 ? done.rays : 0;
    done.pixels = pixels;
    pace.end(done, result.bound_px);
    result.elapsed_ns = pace.record().readings[pace.record().readings.size() - 1].elapsed_ns;
    return result;
  }

  std::vector<ModelFrame> frames(int count) {
    std::vector<ModelFrame> all;
    for (int k = 0; k < count; ++k) all.push_back(frame());
    return all;
  }

 private:
  [[nodiscard]] std::int64_t rays_of(double error_px) const {
    return static_cast<std::int64_t>(ray_share(error_px) * static_cast<double>(pixels));
  }
  static FrameWork left(std::int64_t cast, std::int64_t to_cast, std::int64_t nodes_left) {
    FrameWork work;
    work.nodes = nodes_left;
    work.rays = to_cast;
    work.shaded = cast + to_cast;
    work.pixels = pixels;
    return work;
  }

  void cast(FrameWork& done, ModelFrame& result) {
    const double most_px = pace.budget().settings.most_px;
    result.bound_px = result.plan.error_px;
    std::int64_t to_cast = rays_of(result.bound_px), cast = 0;
    const auto coarsen = [&] {
      const double rest = 1.0 - static_cast<double>(cast) / static_cast<double>(cast + to_cast);
      result.coarser = true;
      result.bound_px = most_px;
      to_cast = static_cast<std::int64_t>(rest * static_cast<double>(rays_of(most_px)));
      done.plans += static_cast<std::int64_t>(1000 * rest);
    };
    done.plans = 1000;
    const auto can_coarsen = [&] { return !result.coarser && result.bound_px < most_px; };
    LateVerdict verdict =
        pace.reached(FrameStage::plan, done, left(0, to_cast, nodes), can_coarsen());
    if (verdict == LateVerdict::coarser) {
      coarsen();
      verdict = pace.reached(FrameStage::plan, done, left(0, to_cast, nodes), false);
    }
    done.nodes = nodes;
    const std::int64_t band = std::max<std::int64_t>(to_cast / limits::budget_bands, 1);
    while (to_cast > 0 && verdict != LateVerdict::give_up) {
      const std::int64_t now = std::min(band, to_cast);
      cast += now;
      to_cast -= now;
      done.rays = cast;
      verdict = pace.reached(FrameStage::cast, done, left(cast, to_cast, 0),
                             can_coarsen() && to_cast > 0);
      if (verdict == LateVerdict::coarser) coarsen();
    }
    if (verdict == LateVerdict::give_up) result.bound_px = 0;
  }
};

}  // namespace ridgeline::testing
