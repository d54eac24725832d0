#pragma once
#include <sys/types.h>
#include <xcb/xcb.h>

#include <cstdint>
#include <string>

#include "tests/screen/seen_pixels.hpp"

namespace ridgeline::test {

/// An X11 server of this test's own, without a monitor (Xvfb), and a second client to look at it.
class XServer {
 public:
  /// 640x480, 24 bits a pixel, at a free display number.
  XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;
  ~XServer();

  [[nodiscard]] const char* name() const { return name_.c_str(); }
  void kill();
  void stop() const;
  void go_on() const;

  using Pixels = SeenPixels;
  /// The only window.
  [[nodiscard]] Pixels window_pixels();
  /// A pixel of the window has this colour within a second; for what was asked without an answer.
  [[nodiscard]] bool becomes(int x, int y, std::uint32_t colour);
  void resize_window(int width_px, int height_px);
  /// What a window manager does when someone closes the window.
  void ask_to_close();
  /// Covers the window and uncovers it again.
  void cover_window();

 private:
  xcb_window_t window();
  void settle();
  pid_t process_ = -1;
  std::string name_;
  xcb_connection_t* client_ = nullptr;
  const xcb_screen_t* screen_ = nullptr;
};

}  // namespace ridgeline::test
