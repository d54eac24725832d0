#include "platform/gpu_clock.hpp"

#include <GLES3/gl31.h>
#include <time.h>

namespace ridgeline {
namespace {

std::int64_t monotonic_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

void GpuClock::start_frame() {
  start_ns_ = monotonic_ns();
}

std::int64_t GpuClock::elapsed_ns(FrameStage stage, const FrameWork& /*done*/,
                                  ShadeDetail /*detail*/) {
  // Decoding and planning give the GPU nothing to do.
  if (stage != FrameStage::input && stage != FrameStage::plan) glFinish();
  return monotonic_ns() - start_ns_;
}

}  // namespace ridgeline
