#pragma once
#include <cstdint>
#include <memory>

#include "core/base/result.hpp"
#include "platform/egl_context.hpp"
#include "platform/screen.hpp"

namespace ridgeline {

/// Where the next picture is drawn.
struct PictureTarget {
  bool none = false;  ///< nowhere: the picture stays where the renderer drew it
  GLuint framebuffer = 0;
  /// A pixel pack buffer of the picture's size that takes its bytes (R, G, B, A; bottom row first)
  /// in place of a framebuffer; 0: none.
  GLuint bytes = 0;
  int x = 0, y = 0;        ///< of the picture's lower left corner
  bool clear = false;      ///< there is a border, which is black
  bool top_first = false;  ///< the target's row 0 is the top of the screen
};

/// One kind of screen. Calls come in this order: make (of each kind), place, attach; then begin,
/// show for each picture; detach and attach around a new context.
class ScreenOutput {
 public:
  ScreenOutput() = default;
  ScreenOutput(const ScreenOutput&) = delete;
  ScreenOutput& operator=(const ScreenOutput&) = delete;
  virtual ~ScreenOutput() = default;

  /// What the context is made for.
  [[nodiscard]] virtual EglPlace place() const = 0;
  /// Makes what this screen has in the current context; the first time the screen then is black.
  [[nodiscard]] virtual Status attach(EglContext& context, ScreenDetail& detail) = 0;
  /// Gives that up again, with its context current.
  virtual void detach() = 0;
  /// The buffer that is not shown, once it is free.
  [[nodiscard]] virtual Result<PictureTarget> begin() = 0;
  /// Shows what was drawn there and is finished; `picture` is its number.
  [[nodiscard]] virtual Status show(std::uint64_t picture) = 0;
  [[nodiscard]] virtual Status wait_shown() = 0;
  [[nodiscard]] virtual ShownStamp shown() = 0;
  virtual void show_failed() = 0;
  /// What the system said of a screen that is lost, in words; empty: nothing.
  [[nodiscard]] virtual const char* last_words() const { return ""; }

  [[nodiscard]] virtual int width_px() const = 0;
  [[nodiscard]] virtual int height_px() const = 0;
  [[nodiscard]] virtual const char* description() const = 0;
};

/// Settings have passed Screen::make()'s checks. Errors: of Screen::make(), told in `detail`.
using ScreenMade = Result<std::unique_ptr<ScreenOutput>>;
[[nodiscard]] ScreenMade make_surfaceless_output(const ScreenSettings& settings);
[[nodiscard]] ScreenMade make_x11_output(const ScreenSettings& settings, ScreenDetail& detail);
[[nodiscard]] ScreenMade make_wayland_output(const ScreenSettings& settings, ScreenDetail& detail);
[[nodiscard]] ScreenMade make_kms_output(const ScreenSettings& settings, ScreenDetail& detail);

/// The failure picture: a cross from corner to corner on black; red, as XRGB8888.
inline constexpr std::uint32_t failure_colour = 0x00E00000;
[[nodiscard]] constexpr int failure_line_px(int width_px) {
  return width_px / 64 > 3 ? width_px / 64 : 3;
}
/// Draws it by the CPU. Shape: height_px rows of width_px pixels, `stride` pixels apart.
void draw_failure_picture(std::uint32_t* pixels, std::size_t stride, int width_px, int height_px);

/// The clock that stamps pictures.
[[nodiscard]] std::int64_t screen_time_ns();

}  // namespace ridgeline
