// The screen that is none, and what all screens have in common.
#include <gtest/gtest.h>

#include <string>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "platform/screen.hpp"
#include "platform/screen_output.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline {
namespace {

using test::ShownPicture;

Screen open_surfaceless(ScreenSettings settings = {}) {
  settings.width_px = 320;
  settings.height_px = 200;
  ScreenDetail detail;
  auto made = Screen::make(settings, detail);
  EXPECT_TRUE(made) << detail.text;
  return std::move(made).value();
}

TEST(Surfaceless, a_picture_counts_as_shown_when_it_is_finished) {
  Screen screen = open_surfaceless();
  EXPECT_STREQ(screen.description(), "surfaceless 320x200");
  EXPECT_EQ(screen.width_px(), 320);
  EXPECT_EQ(screen.height_px(), 200);
  EXPECT_EQ(screen.shown().picture, 0U);
  ShownPicture picture(320, 200);
  std::int64_t before_ns = screen_time_ns();
  for (std::uint32_t frame = 1; frame <= 3; ++frame) {
    picture.draw(frame);
    ASSERT_TRUE(screen.present(picture.texture()));
    ASSERT_TRUE(screen.wait_shown());
    EXPECT_EQ(screen.shown().picture, frame);
    EXPECT_GE(screen.shown().time_ns, before_ns);
    before_ns = screen.shown().time_ns;
  }
  EXPECT_LE(before_ns, screen_time_ns());
  EXPECT_EQ(screen.health().presented, 3U);
  EXPECT_EQ(screen.health().faults, 0U);
}

TEST(Surfaceless, presenting_allocates_nothing_and_makes_no_gl_object) {
  Screen screen = open_surfaceless();
  ShownPicture picture(320, 200);
  picture.draw(0);  // the driver's compiler allocates at a first draw, with what it shares with us
  ASSERT_TRUE(screen.present(picture.texture()));
  const std::uint64_t heap = heap_allocations_counted(), objects = gl_creations_counted();
  {
    const HeapSection no_heap;
    const GlSection no_objects;
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
      picture.draw(frame);
      ASSERT_TRUE(screen.present(picture.texture()));
    }
    screen.show_failed();
  }
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
  EXPECT_GT(heap_allocations_seen(), 0U);
  EXPECT_GT(gl_creations_seen(), 0U);
}

TEST(Surfaceless, the_failure_picture_is_noted_until_a_picture_follows) {
  Screen screen = open_surfaceless();
  ShownPicture picture(320, 200);
  screen.show_failed();
  EXPECT_TRUE(screen.health().failed_shown);
  picture.draw(1);
  ASSERT_TRUE(screen.present(picture.texture()));
  EXPECT_FALSE(screen.health().failed_shown);
}

TEST(Surfaceless, a_screen_that_moves_keeps_working) {
  Screen first = open_surfaceless();
  Screen second = std::move(first);
  ShownPicture picture(320, 200);
  ASSERT_TRUE(second.present(picture.texture()));
  second.make_current();
  EXPECT_NE(std::string(second.gl_description()).find("OpenGL ES 3"), std::string::npos);
}

}  // namespace
}  // namespace ridgeline
