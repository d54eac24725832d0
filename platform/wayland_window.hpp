#pragma once
#include <cstdint>

#include "core/base/result.hpp"
#include "platform/wayland_link.hpp"

struct wl_buffer;
struct wl_surface;
struct xdg_surface;
struct xdg_toplevel;

namespace ridgeline {

/// A window of a Wayland compositor, as large as the picture whatever the compositor would like.
/// Rules: stays where it was opened, for libwayland knows its address; goes before its link.
class WaylandWindow {
 public:
  WaylandWindow() = default;
  WaylandWindow(const WaylandWindow&) = delete;
  WaylandWindow& operator=(const WaylandWindow&) = delete;
  ~WaylandWindow();

  /// Waits until the compositor is ready for its first picture. Owner: uses `link` until it goes.
  /// Errors: screen_refused, screen_missing.
  [[nodiscard]] Status open(WaylandLink& link, int width_px, int height_px, const char* title,
                            ScreenDetail& detail);

  /// Shows a whole new picture from here on: in one step for the compositor, whenever it draws.
  void put(wl_buffer* picture);
  [[nodiscard]] wl_surface* surface() const { return surface_; }
  /// Someone has closed it.
  [[nodiscard]] bool closed() const { return closed_; }

 private:
  struct Events;
  void take_size(std::uint32_t serial);
  [[nodiscard]] bool size_fits(int scale) const;
  void apply_scale();

  WaylandLink* link_ = nullptr;
  wl_surface* surface_ = nullptr;
  xdg_surface* shell_surface_ = nullptr;
  xdg_toplevel* window_ = nullptr;
  int width_px_ = 0, height_px_ = 0;
  int scale_ = 1;  ///< pixels of the picture for one unit of the compositor's
  // What the compositor wants the window to be, in its units; 0: as the window likes.
  int wanted_width_ = 0, wanted_height_ = 0;
  bool maximized_ = false, fullscreen_ = false;
  bool ready_ = false;    ///< it has been told a size that is agreed to
  bool refused_ = false;  ///< the last size it was told was not
  bool closed_ = false;
};

}  // namespace ridgeline
