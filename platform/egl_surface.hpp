#pragma once
#include "core/base/result.hpp"
#include "core/render/gpu_timer.hpp"

namespace ridgeline {

/// An OpenGL ES 3.1 context without a window: surfaceless where the platform has it, else a
/// pbuffer. The context is current on the thread that made it until
/// another is made there.
class EglSurface {
 public:
  /// Errors: Fault::egl_unavailable.
  static Result<EglSurface> make();
  EglSurface(EglSurface&& other) noexcept;
  EglSurface& operator=(EglSurface&& other) noexcept;
  EglSurface(const EglSurface&) = delete;
  EglSurface& operator=(const EglSurface&) = delete;
  ~EglSurface();

  /// Makes the context current again on this thread, if it is not.
  void make_current() const;
  /// Timer query entry points; empty where the driver lacks the extension.
  [[nodiscard]] TimerFunctions timer_functions() const;
  /// "renderer, version" of the driver.
  [[nodiscard]] const char* description() const { return description_; }

 private:
  EglSurface() = default;
  void release();
  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;
  char description_[160] = {};
};

}  // namespace ridgeline
