// A Wayland compositor that hides the window, keeps what it was lent, hangs, complains or goes.
#include <cstdlib>

#include "platform/screen_output.hpp"
#include "tests/screen/wayland_fixture.hpp"

namespace ridgeline::test {
namespace {

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

TEST_F(WaylandWindow, that_is_hidden_takes_pictures_without_a_fault_and_tells_of_none) {
  open({}, 1'000 * ms_ns);
  ASSERT_TRUE(present(1));
  server->hide_window(true);
  const std::int64_t before_ns = screen_time_ns();
  for (std::uint32_t frame = 2; frame <= 40; ++frame) ASSERT_TRUE(give(frame)) << frame;
  EXPECT_LT(screen_time_ns() - before_ns, 20'000 * ms_ns) << "no time limits ran out";
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
  open({}, 400 * ms_ns);
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
  draw_slowly(*picture, 200'000);
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
  open({}, 500 * ms_ns);
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
}  // namespace ridgeline::test
