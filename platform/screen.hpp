#pragma once
#include <cstdint>
#include <memory>

#include "core/base/result.hpp"
#include "core/render/gpu_timer.hpp"

namespace ridgeline {

class ScreenOutput;
class EglContext;
class PictureCopy;

/// What the picture is shown on.
enum class ScreenKind : std::uint8_t {
  surfaceless,  ///< nowhere: the picture stays in the renderer's target, to be read
  window,       ///< a window, see WindowSystem
  kms,          ///< a monitor, without any display server
};

/// Whose window it is; never guessed from what runs.
enum class WindowSystem : std::uint8_t { x11, wayland };

/// What an installer says about the screen. Texts are read by Screen::make() only.
struct ScreenSettings {
  ScreenKind kind = ScreenKind::surfaceless;
  int width_px = 0;   ///< of the picture and of the mode; 0 with kms: the monitor's preferred mode
  int height_px = 0;  ///< 0 when, and only when, width_px is
  double refresh_hz = 0;                ///< kms: of the mode, within 0.5; 0: the fastest
  const char* card = "/dev/dri/card0";  ///< kms: the graphics card
  const char* connector = "";  ///< kms: such as "HDMI-A-1"; empty: the first with a monitor
  WindowSystem window_system = WindowSystem::x11;
  const char* x_display = "";        ///< x11: such as ":0"; empty: what DISPLAY says
  const char* wayland_display = "";  ///< wayland: such as "wayland-0" or the path of a socket;
                                     ///< empty: what WAYLAND_DISPLAY says
  const char* title = "Ridgeline";   ///< window
  std::int64_t gpu_timeout_ns = 500'000'000;   ///< until a picture must be finished
  std::int64_t flip_timeout_ns = 100'000'000;  ///< until the picture before must be shown
};

/// In words what make() or present() was refused: the name of the card, the modes there are, what
/// the system said.
struct ScreenDetail {
  char text[200] = {};
};

/// The last picture known to be on the screen.
struct ShownStamp {
  std::uint64_t picture = 0;  ///< which present() it was, from 1; 0: none yet
  std::int64_t time_ns = 0;   ///< CLOCK_MONOTONIC; kms: of the vertical blank, as the kernel says;
                              ///< wayland: of the presentation, as the compositor says
  std::uint32_t vertical_blank = 0;  ///< its number, where the kernel or compositor counts them
};

/// What the screen has done since it was made; counters only grow.
struct ScreenHealth {
  Fault fault = Fault::none;  ///< of the last present(), renew() or wait_shown()
  std::uint64_t presented = 0;
  std::uint64_t faults = 0;
  bool failed_shown = false;  ///< the failure picture stands, since show_failed()
};

/// An OpenGL ES 3.1 context and the place its pictures go to.
/// Rules: one thread. Everything is made by make(): present() allocates nothing of ours and makes
///        no GL object; two buffers of fixed size take turns.
/// Picture: bytes as the renderer writes them (sRGB encoded, no conversion), one texel one pixel,
///        never scaled or cut; top row at the top of the screen.
class Screen {
 public:
  /// Opens the screen, black, with its context current on this thread. `detail` says more of a
  /// fault. Errors: screen_settings, screen_missing, screen_no_monitor, screen_no_mode,
  /// screen_not_ours, screen_refused, egl_unavailable, gl_out_of_memory.
  [[nodiscard]] static Result<Screen> make(const ScreenSettings& settings, ScreenDetail& detail);
  Screen(Screen&& other) noexcept;
  Screen& operator=(Screen&& other) noexcept;
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  /// Gives the screen back as it was found.
  ~Screen();

  /// Makes the context current again on this thread, if it is not.
  void make_current() const;
  /// Timer query entry points; empty where the driver lacks the extension.
  [[nodiscard]] TimerFunctions timer_functions() const;

  /// Puts the picture in `colour` (RGBA8 texture of width_px() x height_px(), row 0 at the bottom)
  /// on the screen: copies it into the buffer that is not shown, waits until the GPU has finished,
  /// and asks for the flip, which may then happen later (see shown()). With a fault the screen
  /// keeps what it showed.
  /// Passing: gl_late, gl_error, screen_flip_late (the picture before is not shown yet; nothing is
  ///          drawn), screen_no_monitor, screen_not_ours, screen_refused, screen_small: call again.
  /// Final:   gl_context_lost (renew() next), screen_lost, screen_closed.
  /// Hidden windows: pictures go on being taken; shown() stands still meanwhile.
  /// Cost:    blocks at most 2 flip_timeout_ns + gpu_timeout_ns; no allocation.
  [[nodiscard]] Status present(GLuint colour);

  /// Waits until the picture presented last is on the screen. Errors: screen_flip_late,
  /// screen_lost, screen_closed.
  [[nodiscard]] Status wait_shown();
  /// The last picture known to be shown; takes in what the kernel has told, without waiting.
  [[nodiscard]] ShownStamp shown();

  /// Shows the failure picture, a red cross on black, without OpenGL: the screen when nothing else
  /// can be trusted. Best effort; surfaceless: only noted in health(). Cost: no allocation; with a
  /// flip that never came the kernel may hold this call for seconds.
  void show_failed();

  /// Makes a new context in place of one that is lost; the screen keeps what it shows. Every GL
  /// object of the old context is gone: drop the Renderer before, make one after. May allocate.
  /// Errors: egl_unavailable, gl_out_of_memory.
  [[nodiscard]] Status renew();

  [[nodiscard]] int width_px() const;
  [[nodiscard]] int height_px() const;
  [[nodiscard]] const ScreenHealth& health() const { return health_; }
  /// "renderer, version" of the driver.
  [[nodiscard]] const char* gl_description() const;
  /// Such as "kms /dev/dri/card0 Virtual-1 1024x768 60.00 Hz".
  [[nodiscard]] const char* description() const;
  /// What the system said of a screen that is lost, in words; empty: nothing.
  [[nodiscard]] const char* last_words() const;

  /// For tests on drivers that never lose a context: asked instead of glGetGraphicsResetStatus.
  using ResetStatus = GLenum (*)();
  void ask_reset_status(ResetStatus instead);

 private:
  Screen();
  void close();
  Status keep(Status status);
  Status attach(ScreenDetail& detail);

  std::unique_ptr<ScreenOutput> output_;
  std::unique_ptr<EglContext> context_;
  std::unique_ptr<PictureCopy> copy_;
  ScreenHealth health_;
  std::int64_t gpu_timeout_ns_ = 0;
};

}  // namespace ridgeline
