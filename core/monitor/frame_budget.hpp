#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/monitor/frame_work.hpp"

namespace ridgeline {

/// The stages of a frame, in their order; each ends with a reading of the clock.
enum class FrameStage : std::uint8_t { input, terrain, plan, cast, shade };
inline constexpr std::size_t frame_stage_count = 5;
using StageTimes = std::array<std::int64_t, frame_stage_count>;

/// Why a frame was not in time: the stage that took longer than its work explains, or the machine
/// where all did or the work itself is too much.
enum class OverrunCause : std::uint8_t { none, input, terrain, plan, cast, shade, machine };
inline constexpr std::size_t overrun_cause_count = 7;

[[nodiscard]] const char* stage_word(FrameStage stage);
[[nodiscard]] const char* cause_word(OverrunCause cause);

/// What is asked of every frame.
/// Domain: deadline_ns within limits::min_deadline_ns .. max_deadline_ns; 0 < wanted_px <= 64.
struct BudgetSettings {
  std::int64_t deadline_ns = limits::default_deadline_ns;
  double wanted_px = 1;                     ///< the configured bound
  double most_px = limits::budget_most_px;  ///< past it the terrain goes
};

/// What the next frame is drawn with. Steps count from the full picture on:
/// 0 everything; 1 without lines; 2 in facets; then larger bounds; the last without terrain.
struct FramePlan {
  int step = 0;
  bool terrain = true;
  bool on_trial = false;  ///< none was shown before: a frame that is late goes without
  ShadeDetail detail = ShadeDetail::full;
  double error_px = 1;  ///< the bound to promise
};

/// How often, and what was worst. Counters only grow.
struct BudgetCounters {
  std::uint64_t frames = 0;
  std::array<std::uint64_t, overrun_cause_count> overruns{};  ///< by OverrunCause
  std::uint64_t sheds = 0, restores = 0;                      ///< steps down and up between frames
  std::uint64_t late_finishes = 0;  ///< frames finished with a larger bound than planned
  std::uint64_t given_up = 0;       ///< trials that went without terrain after all
  std::uint64_t frames_without_terrain = 0;
  std::int64_t worst_ns = 0;  ///< of a frame
  OverrunCause worst_cause = OverrunCause::none;
  StageTimes worst_stage_ns{};
  double worst_px = 0;  ///< largest bound planned or reached for time's sake
};

/// What the monitor knows between two frames. Plain data, fixed size.
struct FrameBudget {
  BudgetSettings settings;
  int rungs = 0;     ///< bounds above the wanted one
  double ratio = 1;  ///< of one to the next
  int step = 0;
  bool on_trial = false;
  int calm_frames = 0, hold_frames = limits::budget_hold_frames;
  int since_better = 0;       ///< frames since the last better step
  bool better_lasts = false;  ///< it was not taken back yet
  /// Work of a step over that of step 0: a guess until two neighbouring frames have shown it.
  std::array<double, limits::budget_steps> relative{};
  std::array<bool, limits::budget_steps> relative_known{};
  double base_ns = 0;  ///< nominal work of step 0 where the aircraft is; 0: no frame drawn yet
  int last_step = -1;  ///< of the frame before, where it was drawn with terrain
  double last_planned_ns = 0;
  std::array<double, limits::budget_recent_frames> slowness{};     ///< time over nominal time
  std::array<double, limits::budget_recent_frames> overhead_ns{};  ///< before planning begins
  int recent = 0;  ///< frames in these two, and where the next one goes
  BudgetCounters counters;

  [[nodiscard]] int none_step() const { return rungs + 3; }
};

/// A monitor before its first frame: at the full picture.
[[nodiscard]] FrameBudget frame_budget(const BudgetSettings& settings);

/// What the next frame is drawn with.
[[nodiscard]] FramePlan next_plan(const FrameBudget& budget);

/// How much slower the machine is than the reference machine: the second largest of the last
/// frames, so that one stalled frame by itself changes nothing. 1 before the first.
[[nodiscard]] double slowness_of(const FrameBudget& budget);

/// What a frame at a step is predicted to take, ns; 0 before the first frame with terrain.
[[nodiscard]] double predicted_ns(const FrameBudget& budget, int step);

/// Asked inside a frame, after each stage and band.
struct LateQuestion {
  FramePlan plan;
  std::int64_t elapsed_ns = 0;
  std::int64_t left_ns = 0;  ///< nominal, of the work left as planned
  double cast_slowness = 0;  ///< of the rays cast so far; 0: none yet
  bool can_coarsen = false;  ///< a larger bound would save rays that are not cast yet
};
enum class LateVerdict : std::uint8_t {
  go_on,
  coarser,  ///< finish with the largest bound
  give_up,  ///< finish without terrain: only a frame on trial
};
[[nodiscard]] LateVerdict late_verdict(const FrameBudget& budget, const LateQuestion& question);

/// What a finished frame says about its time.
struct FrameTally {
  FramePlan plan;
  StageTimes spent_ns{}, nominal_ns{};
  std::int64_t planned_ns = 0;  ///< nominal, of all it was going to do; 0: nothing with terrain
  double reached_px = 0;        ///< its bound; 0: none
  bool coarser = false, given_up = false;
};

/// The monitor after a frame: counted, learnt from, and the next step chosen.
/// Cost: O(steps); no allocation, no clock.
[[nodiscard]] FrameBudget after_frame(const FrameBudget& before, const FrameTally& tally);

/// Why a frame took longer than its deadline; none where it did not.
[[nodiscard]] OverrunCause overrun_cause(const FrameBudget& before, const FrameTally& tally);

}  // namespace ridgeline
