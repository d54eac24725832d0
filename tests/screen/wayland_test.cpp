// A window of a Wayland compositor: one of the tests' own, which does wrong when told to.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <string>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "platform/screen.hpp"
#include "platform/screen_output.hpp"
#include "tests/screen/wayland_server.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline {
namespace {

using test::SeenPixels;
using test::ShownPicture;
using test::WaylandServer;
using test::WaylandServerSettings;

constexpr int width = 300, height = 170;
constexpr std::uint32_t red = 0xE00000, black = 0;
constexpr std::int64_t ms_ns = 1'000'000;

ScreenSettings at(const char* compositor) {
  ScreenSettings settings;
  settings.kind = ScreenKind::window;
  settings.window_system = WindowSystem::wayland;
  settings.width_px = width;
  settings.height_px = height;
  settings.wayland_display = compositor;
  settings.flip_timeout_ns = 2'000 * ms_ns;  // tests run on busy machines
  return settings;
}

struct Refusal {
  Fault fault = Fault::none;
  std::string detail;
};

Refusal refusal(const WaylandServerSettings& how) {
  WaylandServer server(how);
  ScreenDetail detail;
  const auto made = Screen::make(at(server.name()), detail);
  return {made.fault(), detail.text};
}

bool says(const Refusal& refused, const char* words) {
  return refused.detail.find(words) != std::string::npos;
}

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

TEST_F(WaylandWindow, that_is_hidden_takes_pictures_without_a_fault_and_tells_of_none) {
  open({}, 200 * ms_ns);
  ASSERT_TRUE(present(1));
  server->hide_window(true);
  const std::int64_t before_ns = screen_time_ns();
  for (std::uint32_t frame = 2; frame <= 40; ++frame) ASSERT_TRUE(give(frame)) << frame;
  EXPECT_LT(screen_time_ns() - before_ns, 38 * 200 * ms_ns) << "no time limit ran out";
  EXPECT_EQ(screen->health().faults, 0U);
  EXPECT_EQ(screen->health().presented, 40U);
  EXPECT_EQ(screen->shown().picture, 1U);
  EXPECT_EQ(screen->wait_shown().fault(), Fault::screen_flip_late) << "who asks is told";
  server->hide_window(false);
  EXPECT_TRUE(screen->wait_shown());
  EXPECT_EQ(screen->shown().picture, 40U);
  EXPECT_EQ(wrong(40), 0);
  ASSERT_TRUE(present(41));
  EXPECT_EQ(wrong(41), 0);
}

TEST_F(WaylandWindow, of_a_compositor_that_answers_no_question_asks_no_more_of_them) {
  open();
  server->forget_questions(true);
  for (std::uint32_t frame = 1; frame <= 40; ++frame) ASSERT_TRUE(give(frame)) << frame;
  EXPECT_LE(server->open_questions(), 4);
  EXPECT_EQ(screen->shown().picture, 0U);
  server->forget_questions(false);
  ASSERT_TRUE(give(41));
  ASSERT_TRUE(give(42));
  EXPECT_TRUE(screen->wait_shown());
  EXPECT_EQ(screen->shown().picture, 42U);
}

TEST_F(WaylandWindow, buffers_not_given_back_are_never_drawn_to_and_told_as_late) {
  open({}, 100 * ms_ns);
  server->keep_buffers(true);  // the black one included
  ASSERT_TRUE(present(1));
  ASSERT_TRUE(present(2));
  for (std::uint32_t frame = 3; frame < 6; ++frame) {
    EXPECT_EQ(give(frame).fault(), Fault::screen_flip_late) << frame;
    EXPECT_EQ(wrong(2), 0) << "the last one stands";
  }
  EXPECT_EQ(server->broken_rules(), "");
  screen->show_failed();
  EXPECT_TRUE(server->becomes(width / 2, height / 2, red)) << "has a buffer of its own";
  EXPECT_EQ(give(6).fault(), Fault::screen_flip_late);
  server->keep_buffers(false);
  ASSERT_TRUE(present(7));
  EXPECT_EQ(wrong(7), 0);
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
TEST_F(WaylandWindow, that_is_maximized_asks_out_of_it_once_and_breaks_no_rule) {
  for (const bool insists : {false, true}) {
    WaylandServerSettings how;
    how.insists = insists;
    open(how);
    server->size_window(640, 480, true, false);
    for (std::uint32_t frame = 1; frame <= 5; ++frame) {
      ASSERT_TRUE(present(frame));
      EXPECT_EQ(wrong(frame), 0);
    }
    EXPECT_EQ(server->asked_for_less(), 1);
    server->size_window(80, 60, false, true);
    for (std::uint32_t frame = 1; frame <= 5; ++frame) ASSERT_TRUE(present(frame));
    EXPECT_EQ(server->asked_for_less(), insists ? 1 : 2);
    EXPECT_EQ(server->broken_rules(), "");
    picture.reset();
    screen.reset();
  }
}

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

TEST_F(WaylandWindow, the_failure_picture_stands_until_a_picture_follows) {
  open();
  ASSERT_TRUE(present(1));
  screen->show_failed();
  screen->show_failed();
  EXPECT_TRUE(server->becomes(width / 2, height / 2, red));
  const SeenPixels seen = server->window_pixels();
  EXPECT_EQ(seen.at(0, 0), red);
  EXPECT_EQ(seen.at(width - 1, 0), red);
  EXPECT_EQ(seen.at(1, height - 1), red);
  EXPECT_EQ(seen.at(width / 2, 4), black);
  EXPECT_EQ(seen.at(4, height / 2), black);
  for (const std::uint32_t pixel : seen.rows) {
    ASSERT_TRUE((pixel & 0xFFFFFF) == red || (pixel & 0xFFFFFF) == black);
  }
  ASSERT_TRUE(present(2));
  EXPECT_EQ(wrong(2), 0);
}

TEST_F(WaylandWindow, a_new_context_draws_to_the_same_window) {
  open();
  ASSERT_TRUE(present(1));
  screen->ask_reset_status([]() -> GLenum { return 0x8255; });  // GL_UNKNOWN_CONTEXT_RESET
  EXPECT_EQ(give(2).fault(), Fault::gl_context_lost);
  EXPECT_EQ(wrong(1), 0);
  screen->show_failed();
  picture.reset();
  ASSERT_TRUE(screen->renew());
  EXPECT_TRUE(server->becomes(width / 2, height / 2, red));
  picture.emplace(width, height);
  ASSERT_TRUE(present(3));
  EXPECT_EQ(wrong(3), 0);
}

/// The third question of a picture is whether its bytes survived being read.
TEST_F(WaylandWindow, a_reset_while_the_picture_is_read_is_not_shown) {
  open();
  ASSERT_TRUE(present(1));
  static int asked;
  asked = 0;
  screen->ask_reset_status([]() -> GLenum { return ++asked >= 3 ? 0x8253 : GL_NO_ERROR; });
  EXPECT_EQ(give(2).fault(), Fault::gl_context_lost);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(wrong(1), 0);
  EXPECT_EQ(server->pictures_taken(), 2);
}

TEST_F(WaylandWindow, a_gpu_that_is_late_leaves_what_is_shown) {
  server = std::make_unique<WaylandServer>();
  ScreenSettings settings = at(server->name());
  settings.gpu_timeout_ns = 20 * ms_ns;
  ScreenDetail detail;
  screen.emplace(Screen::make(settings, detail).value());
  picture.emplace(width, height);
  Status status = Fault::gl_late;
  for (int tries = 0; tries < 100 && !status; ++tries) status = give(1);
  ASSERT_TRUE(status);
  ASSERT_TRUE(screen->wait_shown());
  test::draw_slowly(*picture, 200'000);
  EXPECT_EQ(screen->present(picture->texture()).fault(), Fault::gl_late);
  EXPECT_EQ(wrong(1), 0);
  glFinish();
}

TEST_F(WaylandWindow, closing_it_is_told_and_final) {
  open();
  ASSERT_TRUE(present(1));
  server->close_window();
  EXPECT_EQ(give(2).fault(), Fault::screen_closed);
  EXPECT_EQ(screen->wait_shown().fault(), Fault::screen_closed);
  EXPECT_EQ(wrong(1), 0);
  screen->show_failed();
  EXPECT_TRUE(server->becomes(width / 2, height / 2, red));
}

TEST_F(WaylandWindow, a_compositor_that_hangs_is_late_and_may_come_back) {
  open({}, 200 * ms_ns);
  ASSERT_TRUE(present(1));
  server->stop();
  EXPECT_TRUE(give(2)) << "nobody can know yet";
  EXPECT_EQ(give(3).fault(), Fault::screen_flip_late);
  EXPECT_EQ(give(4).fault(), Fault::screen_flip_late);
  EXPECT_EQ(screen->shown().picture, 1U);
  screen->show_failed();
  server->go_on();
  Status status = give(7);
  for (int tries = 0; tries < 20 && !status; ++tries) status = give(7);
  EXPECT_TRUE(status);
  EXPECT_TRUE(server->becomes(0, 0, ShownPicture::pixel(7, 0, 0)));
  EXPECT_EQ(wrong(7), 0);
}

TEST_F(WaylandWindow, a_compositor_that_dies_is_a_lost_screen_not_the_end_of_the_program) {
  open();
  ASSERT_TRUE(present(1));
  server->kill();
  Status status;
  for (int frame = 2; frame < 100 && status; ++frame) status = give(frame);
  EXPECT_EQ(status.fault(), Fault::screen_lost);
  EXPECT_EQ(give(100).fault(), Fault::screen_lost);
  EXPECT_EQ(screen->wait_shown().fault(), Fault::screen_lost);
  screen->show_failed();
  EXPECT_STRNE(screen->last_words(), "");
}

TEST_F(WaylandWindow, an_error_of_the_protocol_is_a_lost_screen_with_its_words) {
  open();
  ASSERT_TRUE(present(1));
  EXPECT_STREQ(screen->last_words(), "");
  server->accuse("of a test");
  Status status;
  for (int frame = 2; frame < 100 && status; ++frame) status = give(frame);
  EXPECT_EQ(status.fault(), Fault::screen_lost);
  EXPECT_NE(std::string(screen->last_words()).find("of a test"), std::string::npos)
      << screen->last_words();
  screen->show_failed();
}

TEST(NoWaylandWindow, without_a_compositor_there_is_no_screen) {
  ScreenDetail detail;
  EXPECT_EQ(Screen::make(at("/nonexistent/wayland-7"), detail).fault(), Fault::screen_missing);
  EXPECT_NE(std::string(detail.text).find("\"/nonexistent/wayland-7\": No such file"),
            std::string::npos)
      << detail.text;
}

TEST(NoWaylandWindow, what_a_compositor_does_not_have_or_do_is_refused_by_name) {
  WaylandServerSettings how;
  how.shell = false;
  Refusal refused = refusal(how);
  EXPECT_EQ(refused.fault, Fault::screen_missing);
  EXPECT_TRUE(says(refused, "has no xdg_wm_base")) << refused.detail;

  how = {};
  how.answers = false;
  refused = refusal(how);
  EXPECT_EQ(refused.fault, Fault::screen_missing);
  EXPECT_TRUE(says(refused, "does not answer")) << refused.detail;

  how = {};
  how.sizes = false;
  refused = refusal(how);
  EXPECT_EQ(refused.fault, Fault::screen_refused);
  EXPECT_TRUE(says(refused, "gives the window no place")) << refused.detail;

  how = {};
  how.maximized_px = 200;
  how.insists = true;
  refused = refusal(how);
  EXPECT_EQ(refused.fault, Fault::screen_refused);
  EXPECT_TRUE(says(refused, "insists on a maximized window of 200x200")) << refused.detail;
  how.insists = false;
  EXPECT_EQ(refusal(how).fault, Fault::none) << "asked out of it, it lets go";
}

/// The name of the display as it is told everywhere else: WAYLAND_DISPLAY in XDG_RUNTIME_DIR.
TEST(NoWaylandWindow, an_empty_name_is_what_the_environment_says) {
  const WaylandServer server;
  ::setenv("WAYLAND_DISPLAY", server.name(), 1);
  ScreenDetail detail;
  EXPECT_TRUE(Screen::make(at(""), detail)) << detail.text;
  ::setenv("WAYLAND_DISPLAY", "/nonexistent/wayland-8", 1);
  EXPECT_EQ(Screen::make(at(""), detail).fault(), Fault::screen_missing);
  EXPECT_NE(std::string(detail.text).find("wayland-8"), std::string::npos) << detail.text;
  EXPECT_TRUE(Screen::make(at(server.name()), detail)) << "what is configured goes first";
  ::unsetenv("WAYLAND_DISPLAY");
}

}  // namespace
}  // namespace ridgeline
