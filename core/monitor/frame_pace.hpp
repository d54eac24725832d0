#pragma once
#include <cstdint>

#include "core/base/fixed_vector.hpp"
#include "core/monitor/frame_budget.hpp"

namespace ridgeline {

/// Whoever knows how long the frame has taken; implemented outside core/.
class FrameClock {
 public:
  virtual ~FrameClock() = default;
  /// Time from the beginning of the frame until all of `done` is done, the GPU's part too.
  /// `stage`: what has just ended, or a band of it. Never goes back within a frame.
  virtual std::int64_t elapsed_ns(FrameStage stage, const FrameWork& done, ShadeDetail detail) = 0;
};

/// The clock of deterministic runs: a machine so many times as slow as the reference machine, on
/// which time is the work done and nothing else.
class WorkClock : public FrameClock {
 public:
  explicit WorkClock(double slowness) : slowness_(slowness) {}
  std::int64_t elapsed_ns(FrameStage /*stage*/, const FrameWork& done,
                          ShadeDetail detail) override {
    return static_cast<std::int64_t>(slowness_ * static_cast<double>(nominal_ns(done, detail)));
  }

 private:
  double slowness_;
};

/// One reading of the clock and what was decided from it.
struct PaceReading {
  FrameStage stage = FrameStage::input;
  std::int64_t elapsed_ns = 0;
  LateVerdict verdict = LateVerdict::go_on;
};

/// All that made the decisions of one frame: the same readings give the same frame.
struct PaceRecord {
  FramePlan plan;
  FixedVector<PaceReading, limits::budget_readings> readings;
};

/// Runs the monitor through the frames: asks the clock, judges, keeps the record.
/// Once a frame: begin(), reached() as the pipeline goes on, end() when the picture is finished.
class FramePace {
 public:
  FramePace(const BudgetSettings& settings, FrameClock& clock)
      : budget_(frame_budget(settings)), clock_(clock) {}

  /// Begins a frame; how to draw it. `bus_frames`: decoded for it.
  FramePlan begin(int bus_frames);
  /// A stage, or a band of the cast, is over. `done`: all work of the frame so far; `left`: what
  /// is still planned.
  LateVerdict reached(FrameStage stage, const FrameWork& done, const FrameWork& left,
                      bool can_coarsen);
  /// The picture is finished, the GPU's part too. `done`: all work; `reached_px`: its bound, or 0.
  void end(const FrameWork& done, double reached_px);

  [[nodiscard]] const FrameBudget& budget() const { return budget_; }
  [[nodiscard]] const PaceRecord& record() const { return record_; }
  [[nodiscard]] const FramePlan& plan() const { return record_.plan; }

 private:
  std::int64_t read(FrameStage stage, const FrameWork& done);

  FrameBudget budget_;
  FrameClock& clock_;
  PaceRecord record_;
  FrameTally tally_;
  FrameWork counted_;  ///< of the frame, up to the last reading
  std::int64_t last_ns_ = 0;
};

}  // namespace ridgeline
