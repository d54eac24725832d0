#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "platform/screen.hpp"
#include "tests/screen/wayland_server.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline::test {

inline constexpr int width = 300, height = 170;
inline constexpr std::uint32_t red = 0xE00000, black = 0;
inline constexpr std::int64_t ms_ns = 1'000'000;

inline ScreenSettings at(const char* compositor) {
  ScreenSettings settings;
  settings.kind = ScreenKind::window;
  settings.window_system = WindowSystem::wayland;
  settings.width_px = width;
  settings.height_px = height;
  settings.wayland_display = compositor;
  settings.gpu_timeout_ns = 5'000'000'000;
  settings.flip_timeout_ns = 2'000 * ms_ns;  // tests run on busy machines
  return settings;
}

/// A screen in a window of a compositor that is looked at, and whose rules it may not break.
class WaylandWindow : public testing::Test {
 protected:
  void open(const WaylandServerSettings& how = {}, std::int64_t flip_timeout_ns = 2'000 * ms_ns) {
    server = std::make_unique<WaylandServer>(how);
    ScreenSettings settings = at(server->name());
    settings.flip_timeout_ns = flip_timeout_ns;
    ScreenDetail detail;
    auto made = Screen::make(settings, detail);
    ASSERT_TRUE(made) << detail.text;
    screen.emplace(std::move(made).value());
    picture.emplace(width, height);
  }
  ~WaylandWindow() override {
    if (server != nullptr) {
      EXPECT_EQ(server->broken_rules(), "");
    }
    picture.reset();
  }

  Status give(std::uint32_t frame) {
    picture->draw(frame);
    return screen->present(picture->texture());
  }
  Status present(std::uint32_t frame) {
    const Status presented = give(frame);
    return presented ? screen->wait_shown() : presented;
  }
  /// Pixels of the window that are not the frame's.
  int wrong(std::uint32_t frame) {
    const SeenPixels seen = server->window_pixels();
    if (seen.width_px != width || seen.height_px != height) return width * height;
    return ShownPicture::wrong_pixels(frame, seen.rows.data(), width, width, height);
  }

  std::unique_ptr<WaylandServer> server;
  std::optional<Screen> screen;
  std::optional<ShownPicture> picture;
};

}  // namespace ridgeline::test
