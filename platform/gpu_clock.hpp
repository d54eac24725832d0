#pragma once
#include "core/monitor/frame_pace.hpp"

namespace ridgeline {

/// The frame-budget monitor's clock of live runs: the monotonic clock, read once the GPU has
/// finished what it was given. A context must be current at the readings.
class GpuClock final : public FrameClock {
 public:
  /// The frame begins now: before its bus frames are decoded.
  void start_frame();
  std::int64_t elapsed_ns(FrameStage stage, const FrameWork& done, ShadeDetail detail) override;

 private:
  std::int64_t start_ns_ = 0;
};

}  // namespace ridgeline
