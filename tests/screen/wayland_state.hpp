#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/screen/wayland_server.hpp"

struct wl_client;
struct wl_display;
struct wl_global;
struct wl_resource;

namespace ridgeline::test {

/// What the compositor of WaylandServer knows and does, on its thread.
struct WaylandState {
  using Size = WaylandServer::Size;
  /// A size that the window was told, and whether it may have another.
  struct Told {
    std::uint32_t serial = 0;
    Size size;
    bool maximized = false, fullscreen = false;
  };

  explicit WaylandState(const WaylandServerSettings& how);
  WaylandState(const WaylandState&) = delete;
  WaylandState& operator=(const WaylandState&) = delete;
  ~WaylandState();

  void tell_size(Size size, bool maximized, bool fullscreen);
  void commit();
  void take_questions();
  void show();
  void break_rule(const std::string& what) { broken += what + "\n"; }
  void look_at_held();
  void kill();

  WaylandServerSettings settings;
  wl_display* display = nullptr;
  wl_global* output_global = nullptr;
  wl_resource *surface = nullptr, *shell = nullptr, *shell_surface = nullptr, *window = nullptr,
              *output = nullptr;
  std::string title, broken;
  Size least, largest;
  int output_scale = 1, scale = 1, next_scale = 1;

  std::vector<Told> told;
  Told agreed;
  bool has_agreed = false, mapped = false;
  std::uint32_t serial = 0;
  int asked_for_less = 0, pings = 0, pongs = 0, pictures = 0;
  bool hidden = false, keep_buffers = false, forgetful = false;

  wl_resource* attached = nullptr;  ///< by the client, not committed
  /// Buffers that the client may not touch, and what was in them when they came.
  struct Held {
    wl_resource* buffer = nullptr;
    SeenPixels pixels;
  };
  std::vector<Held> held;
  SeenPixels seen;
  std::vector<wl_resource*> asked_next, asked;  ///< when it is shown: with the next commit, since
};

/// What is in a buffer now.
[[nodiscard]] SeenPixels pixels_of(wl_resource* buffer);

}  // namespace ridgeline::test
