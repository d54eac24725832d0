// A window of a real compositor, read back by a client of its own.
#include "tests/screen/weston.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "platform/screen.hpp"
#include "platform/screen_output.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline {
namespace {

using test::SeenPixels;
using test::ShownPicture;
using test::Weston;

constexpr int width = 300, height = 170;

Result<Screen> open_at(const Weston& weston, ScreenDetail& detail) {
  ScreenSettings settings;
  settings.kind = ScreenKind::window;
  settings.window_system = WindowSystem::wayland;
  settings.width_px = width;
  settings.height_px = height;
  settings.wayland_display = weston.name();
  settings.gpu_timeout_ns = 5'000'000'000;
  settings.flip_timeout_ns = 2'000'000'000;  // tests run on busy machines
  return Screen::make(settings, detail);
}

struct Place {
  int x = -1, y = -1;
};

/// Where a frame stands on the output, pixel for pixel.
Place place_of(std::uint32_t frame, const SeenPixels& seen) {
  for (int y = 0; y + height <= seen.height_px; ++y) {
    for (int x = 0; x + width <= seen.width_px; ++x) {
      if (seen.at(x, y) != ShownPicture::pixel(frame, 0, 0)) continue;
      if (ShownPicture::wrong_pixels(frame, seen.rows.data() + y * seen.width_px + x,
                                     static_cast<std::size_t>(seen.width_px), width, height) == 0) {
        return {x, y};
      }
    }
  }
  return {};
}

/// Its own client for that draws when it comes to it; the desktop fades in first.
bool comes_to_show(std::uint32_t frame, const Weston& weston) {
  for (int wait = 0; wait < 50; ++wait) {
    if (place_of(frame, weston.screenshot()).x >= 0) return true;
  }
  return false;
}

TEST(WestonWindow, shows_every_pixel_of_every_picture_and_tells_when) {
  const Weston weston;
  if (!weston.problem().empty()) GTEST_SKIP() << weston.problem();
  ScreenDetail detail;
  auto screen = open_at(weston, detail);
  ASSERT_TRUE(screen) << detail.text;
  ShownPicture picture(width, height);
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    picture.draw(frame);
    const std::int64_t before_ns = screen_time_ns();
    ASSERT_TRUE(screen.value().present(picture.texture())) << screen.value().last_words();
    ASSERT_TRUE(screen.value().wait_shown());
    EXPECT_EQ(screen.value().shown().picture, frame);
    EXPECT_GE(screen.value().shown().time_ns, before_ns);
    EXPECT_LE(screen.value().shown().time_ns, screen_time_ns());
    ASSERT_TRUE(comes_to_show(frame, weston));
    EXPECT_EQ(place_of(frame + 1, weston.screenshot()).x, -1);
  }
  const Place place = place_of(3, weston.screenshot());
  screen.value().show_failed();
  bool failed = false;
  for (int wait = 0; wait < 50 && !failed; ++wait) {
    const SeenPixels seen = weston.screenshot();
    failed = seen.at(place.x + width / 2, place.y + height / 2) == 0xE00000 &&
             seen.at(place.x + width / 2, place.y + 4) == 0;
  }
  EXPECT_TRUE(failed) << "no failure picture";
}

TEST(WestonWindow, takes_a_hundred_pictures_as_fast_as_they_come) {
  const Weston weston;
  if (!weston.problem().empty()) GTEST_SKIP() << weston.problem();
  ScreenDetail detail;
  auto screen = open_at(weston, detail);
  ASSERT_TRUE(screen) << detail.text;
  ShownPicture picture(width, height);
  for (std::uint32_t frame = 1; frame <= 100; ++frame) {
    picture.draw(frame);
    ASSERT_TRUE(screen.value().present(picture.texture())) << screen.value().last_words();
  }
  ASSERT_TRUE(screen.value().wait_shown());
  EXPECT_EQ(screen.value().shown().picture, 100U);
  EXPECT_EQ(screen.value().health().faults, 0U);
  EXPECT_TRUE(comes_to_show(100, weston));
}

}  // namespace
}  // namespace ridgeline
