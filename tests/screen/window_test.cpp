// A window, looked at by a second client of the same X11 server.
#include <gtest/gtest.h>

#include <string>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "platform/screen.hpp"
#include "tests/screen/x_server.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline {
namespace {

using test::ShownPicture;
using test::XServer;

constexpr int width = 300, height = 170;
constexpr std::uint32_t red = 0xE00000, black = 0;

Result<Screen> open_at(const char* server, ScreenDetail& detail) {
  ScreenSettings settings;
  settings.kind = ScreenKind::window;
  settings.width_px = width;
  settings.height_px = height;
  settings.x_display = server;
  settings.gpu_timeout_ns = 5'000'000'000;
  settings.flip_timeout_ns = 2'000'000'000;  // tests run on busy machines
  return Screen::make(settings, detail);
}

class Window : public testing::Test {
 protected:
  Window() {
    ScreenDetail detail;
    auto made = open_at(server.name(), detail);
    EXPECT_TRUE(made) << detail.text;
    screen.emplace(std::move(made).value());
    picture.emplace(width, height);
  }
  ~Window() override { picture.reset(); }

  Status present(std::uint32_t frame) {
    picture->draw(frame);
    const Status presented = screen->present(picture->texture());
    return presented ? screen->wait_shown() : presented;
  }
  /// Pixels of the window that are not the frame's; the picture's top left corner at (x, y).
  int wrong(std::uint32_t frame, int x = 0, int y = 0) {
    const XServer::Pixels seen = server.window_pixels();
    return ShownPicture::wrong_pixels(frame, seen.rows.data() + y * seen.width_px + x,
                                      static_cast<std::size_t>(seen.width_px), width, height);
  }

  XServer server;
  std::optional<Screen> screen;
  std::optional<ShownPicture> picture;
};

TEST_F(Window, is_black_until_there_is_a_picture) {
  const XServer::Pixels seen = server.window_pixels();
  EXPECT_EQ(seen.width_px, width);
  EXPECT_EQ(seen.height_px, height);
  for (const std::uint32_t pixel : seen.rows) ASSERT_EQ(pixel & 0xFFFFFF, black);
}

TEST_F(Window, shows_every_pixel_of_every_picture_top_row_up) {
  for (std::uint32_t frame = 1; frame <= 5; ++frame) {
    ASSERT_TRUE(present(frame));
    EXPECT_EQ(wrong(frame), 0) << frame;
    EXPECT_GT(wrong(frame + 1), width * height / 2);
    EXPECT_EQ(screen->shown().picture, frame);
  }
  EXPECT_EQ(std::string(screen->description()),
            "x11 window 300x170 at " + std::string(server.name()));
}

TEST_F(Window, presenting_allocates_nothing_and_makes_no_gl_object) {
  ASSERT_TRUE(present(1));
  const std::uint64_t heap = heap_allocations_counted(), objects = gl_creations_counted();
  {
    const HeapSection no_heap;
    const GlSection no_objects;
    for (std::uint32_t frame = 0; frame < 10; ++frame) ASSERT_TRUE(present(frame));
    screen->show_failed();
    ASSERT_TRUE(present(1));
  }
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
}

TEST_F(Window, a_larger_one_has_the_picture_in_the_middle_of_black) {
  server.resize_window(width + 40, height + 20);
  ASSERT_TRUE(present(1));
  ASSERT_TRUE(present(2));  // Mesa takes in a new size with the next picture
  EXPECT_EQ(wrong(2, 20, 10), 0);
  const XServer::Pixels seen = server.window_pixels();
  EXPECT_EQ(seen.at(19, 10), black);
  EXPECT_EQ(seen.at(20 + width, 10 + height - 1), black);
  EXPECT_EQ(seen.at(20, 9), black);
  EXPECT_EQ(seen.at(20, 10 + height), black);
}

TEST_F(Window, a_smaller_one_is_a_fault_until_it_is_large_enough) {
  server.resize_window(width, height - 1);
  EXPECT_EQ(present(1).fault(), Fault::screen_small);
  server.resize_window(width, height);
  ASSERT_TRUE(present(2));
  ASSERT_TRUE(present(3));
  EXPECT_EQ(wrong(3), 0);
}

TEST_F(Window, the_failure_picture_stands_until_a_picture_follows) {
  ASSERT_TRUE(present(1));
  screen->show_failed();
  for (int covered = 0; covered < 2; ++covered) {
    EXPECT_TRUE(server.becomes(width / 2, height / 2, red));
    const XServer::Pixels seen = server.window_pixels();
    EXPECT_EQ(seen.at(0, 0), red);
    EXPECT_EQ(seen.at(width - 1, 1), red);
    EXPECT_EQ(seen.at(1, height - 1), red);
    EXPECT_EQ(seen.at(width / 2, 4), black);
    EXPECT_EQ(seen.at(4, height / 2), black);
    for (const std::uint32_t pixel : seen.rows) {
      ASSERT_TRUE((pixel & 0xFFFFFF) == red || (pixel & 0xFFFFFF) == black);
    }
    server.cover_window();
  }
  ASSERT_TRUE(present(2));
  EXPECT_EQ(wrong(2), 0);
}

TEST_F(Window, a_new_context_draws_to_the_same_window) {
  ASSERT_TRUE(present(1));
  screen->ask_reset_status([]() -> GLenum { return 0x8255; });  // GL_UNKNOWN_CONTEXT_RESET
  EXPECT_EQ(present(2).fault(), Fault::gl_context_lost);
  EXPECT_EQ(wrong(1), 0);
  screen->show_failed();
  picture.reset();
  ASSERT_TRUE(screen->renew());
  EXPECT_TRUE(server.becomes(width / 2, height / 2, red));
  picture.emplace(width, height);
  ASSERT_TRUE(present(3));
  EXPECT_EQ(wrong(3), 0);
}

TEST_F(Window, closing_it_is_told_and_final) {
  ASSERT_TRUE(present(1));
  server.ask_to_close();
  EXPECT_EQ(present(2).fault(), Fault::screen_closed);
  EXPECT_EQ(screen->wait_shown().fault(), Fault::screen_closed);
}

TEST_F(Window, a_server_that_hangs_is_late_and_may_come_back) {
  ASSERT_TRUE(present(1));
  server.stop();
  EXPECT_EQ(screen->present(picture->texture()).fault(), Fault::screen_flip_late);
  EXPECT_EQ(screen->present(picture->texture()).fault(), Fault::screen_flip_late);
  EXPECT_EQ(screen->shown().picture, 1U);
  server.go_on();
  EXPECT_TRUE(present(7));
  EXPECT_EQ(wrong(7), 0);
}

TEST_F(Window, a_server_that_dies_is_a_lost_screen_not_the_end_of_the_program) {
  ASSERT_TRUE(present(1));
  server.kill();
  Status status;
  for (int frame = 2; frame < 100 && status; ++frame) status = present(frame);
  EXPECT_EQ(status.fault(), Fault::screen_lost);
  EXPECT_EQ(present(100).fault(), Fault::screen_lost);
  EXPECT_EQ(screen->wait_shown().fault(), Fault::screen_lost);
  screen->show_failed();
}

TEST(NoWindow, without_a_server_there_is_no_screen) {
  ScreenDetail detail;
  EXPECT_EQ(open_at(":987", detail).fault(), Fault::screen_missing);
  EXPECT_NE(std::string(detail.text).find("\":987\""), std::string::npos) << detail.text;
}

}  // namespace
}  // namespace ridgeline
