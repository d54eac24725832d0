#include "platform/wayland_window.hpp"

#include <wayland-client.h>
#include <xdg-shell-client-protocol.h>

#include <cstdio>

namespace ridgeline {
struct WaylandWindow::Events {
  static WaylandWindow& window(void* data) { return *static_cast<WaylandWindow*>(data); }
  static void size(void* data, xdg_toplevel* /*toplevel*/, std::int32_t width, std::int32_t height,
                   wl_array* states) {
    WaylandWindow& self = window(data);
    self.wanted_width_ = width;
    self.wanted_height_ = height;
    self.maximized_ = self.fullscreen_ = false;
    const auto* state = static_cast<const std::uint32_t*>(states->data);
    for (std::size_t i = 0; i < states->size / sizeof *state; ++i) {
      self.maximized_ = self.maximized_ || state[i] == XDG_TOPLEVEL_STATE_MAXIMIZED;
      self.fullscreen_ = self.fullscreen_ || state[i] == XDG_TOPLEVEL_STATE_FULLSCREEN;
    }
  }
  static void closed(void* data, xdg_toplevel* /*toplevel*/) { window(data).closed_ = true; }
  static void configure(void* data, xdg_surface* /*surface*/, std::uint32_t serial) {
    window(data).take_size(serial);
  }
  static void enter(void* data, wl_surface* /*surface*/, wl_output* output) {
    window(data).link_->enter(output, true);
  }
  static void leave(void* data, wl_surface* /*surface*/, wl_output* output) {
    window(data).link_->enter(output, false);
  }

  static constexpr wl_surface_listener surface = {enter, leave};
  static constexpr xdg_surface_listener shell_surface = {configure};
  // Of version 3 at most, which is the one asked for.
  static constexpr xdg_toplevel_listener toplevel = {size, closed, nullptr, nullptr};
};

WaylandWindow::~WaylandWindow() {
  if (window_ != nullptr) xdg_toplevel_destroy(window_);
  if (shell_surface_ != nullptr) xdg_surface_destroy(shell_surface_);
  if (surface_ != nullptr) wl_surface_destroy(surface_);
}

Status WaylandWindow::open(WaylandLink& link, int width_px, int height_px, const char* title,
                           ScreenDetail& detail) {
  link_ = &link;
  width_px_ = width_px;
  height_px_ = height_px;
  surface_ = wl_compositor_create_surface(link.compositor());
  wl_surface_add_listener(surface_, &Events::surface, this);
  shell_surface_ = xdg_wm_base_get_xdg_surface(link.shell(), surface_);
  xdg_surface_add_listener(shell_surface_, &Events::shell_surface, this);
  window_ = xdg_surface_get_toplevel(shell_surface_);
  xdg_toplevel_add_listener(window_, &Events::toplevel, this);
  xdg_toplevel_set_title(window_, title);
  xdg_toplevel_set_app_id(window_, "ridgeline-display");
  xdg_toplevel_set_min_size(window_, width_px, height_px);
  xdg_toplevel_set_max_size(window_, width_px, height_px);
  wl_surface_commit(surface_);  // without a picture: asks what size the window may have
  if (link.wait([&] { return ready_; }, screen_time_ns() + WaylandLink::boot_limit_ns)) return {};
  if (link.lost()) {
    std::snprintf(detail.text, sizeof detail.text, "the compositor at \"%.60s\" has gone: %s",
                  link.name(), link.last_words());
    return Fault::screen_missing;
  }
  if (refused_) {
    std::snprintf(detail.text, sizeof detail.text,
                  "the compositor at \"%.60s\" insists on a %s window of %dx%d", link.name(),
                  fullscreen_ ? "fullscreen" : "maximized", wanted_width_, wanted_height_);
  } else {
    std::snprintf(detail.text, sizeof detail.text,
                  "the compositor at \"%.60s\" gives the window no place", link.name());
  }
  return Fault::screen_refused;
}

/// A size that only suggests is not taken. One that binds, and to which a picture of ours would be
/// an error of the protocol that ends the connection, is left unanswered, which the protocol allows
/// as long as a later one is answered; and the compositor is asked, once, to take it back.
void WaylandWindow::take_size(std::uint32_t serial) {
  if (size_fits(scale_)) {
    xdg_surface_ack_configure(shell_surface_, serial);
    ready_ = true;
    refused_ = false;
    return;
  }
  if (refused_) return;
  refused_ = true;
  if (maximized_) xdg_toplevel_unset_maximized(window_);
  if (fullscreen_) xdg_toplevel_unset_fullscreen(window_);
}

/// A maximized window has the very size it is told, a fullscreen one has at most that.
bool WaylandWindow::size_fits(int scale) const {
  const int width = width_px_ / scale, height = height_px_ / scale;
  if (wanted_width_ == 0 || wanted_height_ == 0) return true;
  if (maximized_ && (wanted_width_ != width || wanted_height_ != height)) return false;
  return !fullscreen_ || (wanted_width_ >= width && wanted_height_ >= height);
}

/// On an output of scale 2 a pixel of the picture is a pixel still, where the protocol lets it: it
/// takes no picture whose sides are no multiples of the scale, and the compositor then enlarges it.
void WaylandWindow::apply_scale() {
  int scale = link_->scale();
  if (width_px_ % scale != 0 || height_px_ % scale != 0) scale = 1;
  if (scale == scale_ || !size_fits(scale)) return;  // what the compositor was promised stands
  scale_ = scale;
  wl_surface_set_buffer_scale(surface_, scale);
  xdg_toplevel_set_min_size(window_, width_px_ / scale, height_px_ / scale);
  xdg_toplevel_set_max_size(window_, width_px_ / scale, height_px_ / scale);
}

void WaylandWindow::put(wl_buffer* picture) {
  apply_scale();
  wl_surface_attach(surface_, picture, 0, 0);
  wl_surface_damage_buffer(surface_, 0, 0, width_px_, height_px_);
  wl_surface_commit(surface_);
}

}  // namespace ridgeline
