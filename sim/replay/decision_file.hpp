#pragma once
#include <string>
#include <vector>

#include "core/monitor/frame_pace.hpp"
#include "platform/block_worker.hpp"
#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// What made one frame what it is, besides log and options.
struct FrameDecisions {
  std::int64_t time_ns = 0;
  PaceRecord record;           ///< no reading: the frame had no monitor
  BlockWorker::Rounds blocks;  ///< of terrain that came in
  int line = 0;                ///< of the file
};

/// Everything that a run on a real clock decided: docs/monitor.md has the format.
struct Decisions {
  BudgetSettings settings;
  std::string arrival;  ///< of terrain: in-step or as-ready
  std::vector<FrameDecisions> frames;
};

/// The lines of the file, each with its end.
[[nodiscard]] std::string decisions_head(const BudgetSettings& settings,
                                         const std::string& arrival);
[[nodiscard]] std::string decisions_line(int index, const FrameDecisions& frame);

/// Outcome: the message names file and line and what is wrong there.
Outcome read_decisions(const std::string& path, Decisions& decisions);

/// The clock of a run that is done again: says what was read then.
class RecordedClock final : public FrameClock {
 public:
  void start_frame(const PaceRecord& record) {
    record_ = record;
    next_ = 0;
  }
  std::int64_t elapsed_ns(FrameStage stage, const FrameWork& done, ShadeDetail detail) override;

 private:
  PaceRecord record_;
  std::size_t next_ = 0;
};

/// Whether a frame decided as the recorded one did.
[[nodiscard]] bool same_decisions(const PaceRecord& a, const PaceRecord& b);

}  // namespace ridgeline::sim
