#pragma once
#include <optional>
#include <string>

#include "platform/gpu_clock.hpp"
#include "sim/replay/decision_file.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// How a replay keeps the frame budget.
struct PaceOptions {
  enum class Kind : std::uint8_t {
    none,
    work,  ///< time is counted work: the same frames everywhere
    real,  ///< the machine's own clock
  };
  Kind kind = Kind::none;
  double deadline_ms = 1e-6 * static_cast<double>(limits::default_deadline_ns);
  double most_px = limits::budget_most_px;
  double cost_scale = 1;       ///< of `work`: so many times as slow as the reference machine
  std::string record_file;     ///< empty: not written
  std::string decisions_file;  ///< of a run that is to be done again; empty: none
};

/// The monitor of one replay, its clock, and the decisions written or read.
class ReplayPacing {
 public:
  /// Reads what is to be read. With a decisions file its settings count; it must be of a run with
  /// the same bound and arrival of terrain.
  Outcome open(const PaceOptions& options, const SceneOptions& scene);
  /// Null where no budget is kept.
  [[nodiscard]] FramePace* pace() { return pace_ ? &*pace_ : nullptr; }
  /// Before the bus frames of a frame are looked at.
  Outcome begin_frame(int index, std::int64_t time_ns, Session& session);
  Outcome end_frame(int index, std::int64_t time_ns, Session& session);
  /// Writes what was recorded.
  Outcome finish();

 private:
  PaceOptions options_;
  std::optional<WorkClock> work_clock_;
  GpuClock gpu_clock_;
  RecordedClock recorded_clock_;
  std::optional<FramePace> pace_;
  Decisions decisions_;
  std::string recorded_;
};

}  // namespace ridgeline::sim
