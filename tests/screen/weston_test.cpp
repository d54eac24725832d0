// A window of a real compositor, read back by a client of its own.
#include "tests/screen/weston.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

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

class WestonWindow : public testing::Test {
 protected:
  void SetUp() override {
    if (!weston_.problem().empty()) GTEST_SKIP() << weston_.problem();
    ScreenDetail detail;
    auto made = open_at(weston_, detail);
    ASSERT_TRUE(made) << detail.text;
    screen_.emplace(std::move(made).value());
    picture_.emplace(width, height);
  }

  Weston weston_;
  std::optional<Screen> screen_;
  std::optional<ShownPicture> picture_;  ///< of the screen's context
};

TEST_F(WestonWindow, shows_every_pixel_of_every_picture_and_tells_when) {
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    picture_->draw(frame);
    const std::int64_t before_ns = screen_time_ns();
    ASSERT_TRUE(screen_->present(picture_->texture())) << screen_->last_words();
    ASSERT_TRUE(screen_->wait_shown());
    EXPECT_EQ(screen_->shown().picture, frame);
    EXPECT_GE(screen_->shown().time_ns, before_ns);
    EXPECT_LE(screen_->shown().time_ns, screen_time_ns());
    ASSERT_TRUE(comes_to_show(frame, weston_));
    EXPECT_EQ(place_of(frame + 1, weston_.screenshot()).x, -1);
  }
  const Place place = place_of(3, weston_.screenshot());
  screen_->show_failed();
  bool failed = false;
  for (int wait = 0; wait < 50 && !failed; ++wait) {
    const SeenPixels seen = weston_.screenshot();
    failed = seen.at(place.x + width / 2, place.y + height / 2) == 0xE00000 &&
             seen.at(place.x + width / 2, place.y + 4) == 0;
  }
  EXPECT_TRUE(failed) << "no failure picture";
}

TEST_F(WestonWindow, takes_a_hundred_pictures_as_fast_as_they_come) {
  for (std::uint32_t frame = 1; frame <= 100; ++frame) {
    picture_->draw(frame);
    ASSERT_TRUE(screen_->present(picture_->texture())) << screen_->last_words();
  }
  ASSERT_TRUE(screen_->wait_shown());
  EXPECT_EQ(screen_->shown().picture, 100U);
  EXPECT_EQ(screen_->health().faults, 0U);
  EXPECT_TRUE(comes_to_show(100, weston_));
}

}  // namespace
}  // namespace ridgeline
