#pragma once
#include <cstdint>

#include "core/base/result.hpp"
#include "core/render/gpu_timer.hpp"

namespace ridgeline {

/// What a context is made for.
struct EglPlace {
  unsigned platform = 0;              ///< as eglGetPlatformDisplay() names it; 0: no window
  void* native = nullptr;             ///< the display or device of that platform
  const intptr_t* details = nullptr;  ///< attributes of that platform; read by make() only
  std::uint32_t visual = 0;           ///< of the window to come; 0: none, pictures go to textures
};

/// An OpenGL ES 3.1 context, current on the thread that made it until another is made there. Tells
/// of a reset where the driver can (EXT_create_context_robustness).
class EglContext {
 public:
  /// Without a window: surfaceless where the platform has it, else a pbuffer.
  /// Errors: Fault::egl_unavailable.
  [[nodiscard]] static Result<EglContext> make();
  /// For a place. Errors: Fault::egl_unavailable.
  [[nodiscard]] static Result<EglContext> make(const EglPlace& place);
  EglContext(EglContext&& other) noexcept;
  EglContext& operator=(EglContext&& other) noexcept;
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  /// A new context in place of this one, on the same display and window. Every GL object of the old
  /// one is gone. Errors: Fault::egl_unavailable.
  [[nodiscard]] Status renew();
  /// Draws to a native window from here on: framebuffer 0. `native_window` is what the platform's
  /// eglCreatePlatformWindowSurface() wants. Errors: Fault::egl_unavailable.
  [[nodiscard]] Status open_window(void* native_window);
  /// Shows what was drawn to the window. Errors: gl_context_lost, screen_lost.
  [[nodiscard]] Status swap();

  /// Makes the context current again on this thread, if it is not.
  void make_current() const;
  /// The driver was reset, and nothing drawn since counts. Stays true once it was. Cost: no wait.
  [[nodiscard]] bool lost();
  /// Timer query entry points; empty where the driver lacks the extension.
  [[nodiscard]] TimerFunctions timer_functions() const;
  /// EGLDisplay, for whoever makes images.
  [[nodiscard]] void* display() const { return display_; }
  /// "renderer, version" of the driver.
  [[nodiscard]] const char* description() const { return description_; }

  /// Asked instead of glGetGraphicsResetStatus, until renew().
  using ResetStatus = GLenum (*)();
  void ask_reset_status(ResetStatus instead) { reset_status_ = instead; }

 private:
  EglContext() = default;
  [[nodiscard]] Status choose_config(const EglPlace& place);
  [[nodiscard]] Status open_context();
  void close_context();
  void release();
  void* display_ = nullptr;
  void* config_ = nullptr;
  void* context_ = nullptr;
  void* surface_ =
      nullptr;  ///< a window, or the pbuffer of a platform without surfaceless contexts
  ResetStatus reset_status_ = nullptr;
  bool lost_ = false;
  char description_[160] = {};
};

}  // namespace ridgeline
