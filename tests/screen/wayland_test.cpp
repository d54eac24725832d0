// A window of a Wayland compositor of the tests' own.
#include <cstdlib>
#include <ctime>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "platform/screen_output.hpp"
#include "tests/screen/wayland_fixture.hpp"

namespace ridgeline::test {
namespace {

TEST_F(WaylandWindow, is_black_until_there_is_a_picture_and_of_its_size) {
  open();
  const SeenPixels seen = server->window_pixels();
  EXPECT_EQ(seen.width_px, width);
  EXPECT_EQ(seen.height_px, height);
  for (const std::uint32_t pixel : seen.rows) ASSERT_EQ(pixel & 0xFFFFFF, black);
  const WaylandServer::Size size{width, height};
  EXPECT_EQ(server->least_size(), size);
  EXPECT_EQ(server->largest_size(), size);
  EXPECT_EQ(server->title(), "Ridgeline");
  EXPECT_EQ(std::string(screen->description()),
            "wayland window 300x170 at " + std::string(server->name()).substr(0, 60));
}

TEST_F(WaylandWindow, shows_every_pixel_of_every_picture_top_row_up) {
  open();
  for (std::uint32_t frame = 1; frame <= 7; ++frame) {
    ASSERT_TRUE(present(frame));
    EXPECT_EQ(wrong(frame), 0) << frame;
    EXPECT_GT(wrong(frame + 1), width * height / 2);
    EXPECT_EQ(screen->shown().picture, frame);
  }
  EXPECT_EQ(screen->health().faults, 0U);
}

TEST_F(WaylandWindow, presenting_allocates_nothing_and_makes_no_gl_object) {
  open();
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

TEST_F(WaylandWindow, when_a_picture_was_shown_is_told_by_the_compositor_on_our_clock) {
  for (const clockid_t clock : {CLOCK_MONOTONIC, CLOCK_REALTIME, clockid_t{99}}) {
    WaylandServerSettings how;
    how.clock = clock == 99 ? CLOCK_MONOTONIC : static_cast<std::uint32_t>(clock);
    if (clock == 99) how.told_clock = 99;
    open(how);
    const std::int64_t before_ns = screen_time_ns();
    ASSERT_TRUE(give(1));
    const std::int64_t given_ns = screen_time_ns();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ASSERT_TRUE(screen->wait_shown());
    const ShownStamp stamp = screen->shown();
    EXPECT_EQ(stamp.picture, 1U);
    EXPECT_EQ(stamp.vertical_blank, 2U) << "its second picture: the first is the black one";
    EXPECT_GE(stamp.time_ns, before_ns) << clock;
    if (clock == 99) {
      EXPECT_GE(stamp.time_ns, given_ns + 200 * ms_ns) << "of a clock unknown: when it was told";
    } else {
      EXPECT_LT(stamp.time_ns, given_ns + 150 * ms_ns) << "when it was shown, not when it was told";
    }
    picture.reset();
    screen.reset();
  }
}

TEST_F(WaylandWindow, where_the_compositor_does_not_tell_taken_is_shown) {
  WaylandServerSettings how;
  how.presentation = false;
  open(how);
  ASSERT_TRUE(present(1));
  EXPECT_EQ(screen->shown().picture, 1U);
  EXPECT_EQ(wrong(1), 0);
  server->stop();
  ASSERT_TRUE(give(2));
  EXPECT_EQ(screen->shown().picture, 1U) << "not before the compositor has it";
  server->go_on();
  EXPECT_TRUE(screen->wait_shown());
  EXPECT_EQ(screen->shown().picture, 2U);
  EXPECT_NE(std::string(screen->description()).find("does not tell when it shows"),
            std::string::npos);
}

TEST_F(WaylandWindow, that_is_told_another_size_keeps_that_of_the_picture) {
  open();
  for (const auto& size : {WaylandServer::Size{width + 40, height + 20}, {80, 60}, {0, 0}}) {
    server->size_window(size.width, size.height);
    ASSERT_TRUE(present(2));
    EXPECT_EQ(wrong(2), 0);
  }
  server->size_window(width + 1, height + 1, false, true);
  ASSERT_TRUE(present(3)) << "the compositor puts it in the middle of its screen";
  EXPECT_EQ(wrong(3), 0);
  server->size_window(width, height, true, false);
  ASSERT_TRUE(present(4));
  EXPECT_EQ(wrong(4), 0);
  EXPECT_EQ(server->asked_for_less(), 0);
}

/// A picture of another size in a maximized window is an error of the protocol: the end.
TEST_F(WaylandWindow, answers_whether_the_program_lives) {
  open();
  server->ping();
  ASSERT_TRUE(present(1));
  EXPECT_TRUE(server->has_answered());
  server->ping();
  ASSERT_TRUE(present(2));
  EXPECT_TRUE(server->has_answered());
}

TEST_F(WaylandWindow, on_an_output_with_a_scale_keeps_its_pixels_where_it_divides_them) {
  open();
  server->show_on_output_of_scale(2);
  ASSERT_TRUE(present(1));
  ASSERT_TRUE(present(2));
  EXPECT_EQ(server->scale_of_window(), 2);
  EXPECT_EQ(wrong(2), 0);
  const WaylandServer::Size half{width / 2, height / 2};
  EXPECT_EQ(server->least_size(), half);
  EXPECT_EQ(server->largest_size(), half);
  server->show_on_output_of_scale(3);  // 170 is no multiple of it
  ASSERT_TRUE(present(3));
  ASSERT_TRUE(present(4));
  EXPECT_EQ(server->scale_of_window(), 1);
  EXPECT_EQ(wrong(4), 0);
  server->show_on_output_of_scale(2);
  server->unplug_output();
  ASSERT_TRUE(present(5));
  ASSERT_TRUE(present(6));
  EXPECT_EQ(server->scale_of_window(), 1);
}

/// The third question of a picture is whether its bytes survived being read.
/// The name of the display as it is told everywhere else: WAYLAND_DISPLAY in XDG_RUNTIME_DIR.

}  // namespace
}  // namespace ridgeline::test
