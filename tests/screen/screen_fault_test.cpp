// What goes wrong with a context or its settings, on the screen that needs no hardware.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "core/render/gl_object.hpp"
#include "platform/screen.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline {
namespace {

using test::ShownPicture;

ScreenSettings sized(int width_px, int height_px) {
  ScreenSettings settings;
  settings.width_px = width_px;
  settings.height_px = height_px;
  return settings;
}

Screen open_screen(const ScreenSettings& settings) {
  ScreenDetail detail;
  auto made = Screen::make(settings, detail);
  EXPECT_TRUE(made) << detail.text;
  return std::move(made).value();
}

struct Refusal {
  Fault fault = Fault::none;
  std::string detail;
};

Refusal refusal(const ScreenSettings& settings) {
  ScreenDetail detail;
  const auto made = Screen::make(settings, detail);
  return {made.fault(), detail.text};
}

bool says(const Refusal& refused, const char* words) {
  return refused.detail.find(words) != std::string::npos;
}

TEST(ScreenFault, settings_out_of_range_are_refused_by_name) {
  for (const auto [width, height] : {std::array{0, 0}, std::array{320, 0}, std::array{15, 200},
                                     std::array{320, 4097}, std::array{-320, 200}}) {
    const Refusal refused = refusal(sized(width, height));
    EXPECT_EQ(refused.fault, Fault::screen_settings) << width << 'x' << height;
    EXPECT_TRUE(says(refused, "size")) << refused.detail;
  }
  ScreenSettings settings = sized(320, 200);
  settings.gpu_timeout_ns = 0;
  EXPECT_TRUE(says(refusal(settings), "time limit"));
  settings = sized(320, 200);
  settings.refresh_hz = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(refusal(settings), "refresh rate"));
}

TEST(ScreenFault, a_card_that_is_none_is_no_screen) {
  ScreenSettings settings = sized(320, 200);
  settings.kind = ScreenKind::kms;
  settings.card = "/nonexistent/card7";
  Refusal refused = refusal(settings);
  EXPECT_EQ(refused.fault, Fault::screen_missing);
  EXPECT_TRUE(says(refused, "/nonexistent/card7: No such file")) << refused.detail;
  settings.card = "/dev/null";
  refused = refusal(settings);
  EXPECT_EQ(refused.fault, Fault::screen_missing);
  EXPECT_TRUE(says(refused, "/dev/null: not a card")) << refused.detail;
}

TEST(ScreenFaultDeathTest, without_a_driver_there_is_no_context) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a process that has not loaded one yet
  EXPECT_EXIT(
      {
        ::setenv("LIBGL_DRIVERS_PATH", "/nonexistent", 1);
        std::fprintf(stderr, "%s\n", std::string(fault_id(refusal(sized(320, 200)).fault)).c_str());
        std::exit(0);
      },
      testing::ExitedWithCode(0), "egl_unavailable");
}

TEST(ScreenFault, the_context_asks_to_be_told_of_resets) {
  const Screen screen = open_screen(sized(320, 200));
  const std::string able = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  if (able.find("GL_KHR_robustness") == std::string::npos) GTEST_SKIP() << "driver cannot tell";
  constexpr GLenum strategy_name = 0x8256, lose_context_on_reset = 0x8252;
  GLint strategy = 0;
  glGetIntegerv(strategy_name, &strategy);
  EXPECT_EQ(static_cast<GLenum>(strategy), lose_context_on_reset);
}

TEST(ScreenFault, a_lost_context_shows_nothing_until_it_is_renewed) {
  Screen screen = open_screen(sized(320, 200));
  {
    ShownPicture picture(320, 200);
    ASSERT_TRUE(screen.present(picture.texture()));
    screen.ask_reset_status([]() -> GLenum { return 0x8253; });  // GL_GUILTY_CONTEXT_RESET
    EXPECT_EQ(screen.present(picture.texture()).fault(), Fault::gl_context_lost);
    // The driver says it once only; the context stays lost all the same.
    screen.ask_reset_status([]() -> GLenum { return GL_NO_ERROR; });
    EXPECT_EQ(screen.present(picture.texture()).fault(), Fault::gl_context_lost);
    EXPECT_EQ(screen.shown().picture, 1U);
    EXPECT_EQ(screen.health().fault, Fault::gl_context_lost);
    EXPECT_EQ(screen.health().faults, 2U);
  }
  ASSERT_TRUE(screen.renew());
  ShownPicture picture(320, 200);
  picture.draw(5);
  EXPECT_TRUE(screen.present(picture.texture()));
  EXPECT_EQ(screen.shown().picture, 2U);
  EXPECT_EQ(screen.health().fault, Fault::none);
}

TEST(ScreenFault, a_reset_while_the_picture_is_drawn_is_not_shown) {
  Screen screen = open_screen(sized(320, 200));
  const ShownPicture picture(320, 200);
  static int asked = 0;
  asked = 0;
  screen.ask_reset_status([]() -> GLenum { return ++asked > 1 ? 0x8254U : 0U; });
  EXPECT_EQ(screen.present(picture.texture()).fault(), Fault::gl_context_lost);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(screen.shown().picture, 0U);
}

TEST(ScreenFault, a_picture_not_finished_in_time_is_not_shown) {
  ScreenSettings settings = sized(320, 200);
  settings.gpu_timeout_ns = 1'000'000;
  Screen screen = open_screen(settings);
  ShownPicture picture(320, 200);
  draw_slowly(picture, 200'000);
  EXPECT_EQ(screen.present(picture.texture()).fault(), Fault::gl_late);
  EXPECT_EQ(screen.shown().picture, 0U);
  glFinish();
  Status later = screen.present(picture.texture());
  for (int again = 0; again < 100 && !later; ++again) later = screen.present(picture.texture());
  EXPECT_TRUE(later);
  EXPECT_EQ(screen.shown().picture, 1U);
}

TEST(ScreenFault, an_error_of_opengl_voids_one_picture) {
  Screen screen = open_screen(sized(320, 200));
  const ShownPicture picture(320, 200);
  glEnable(GL_RENDERER);  // not a capability
  EXPECT_EQ(screen.present(picture.texture()).fault(), Fault::gl_error);
  EXPECT_TRUE(screen.present(picture.texture()));
  EXPECT_EQ(screen.shown().picture, 1U);
}

TEST(ScreenFault, a_shader_that_does_not_compile_is_named_and_leaves_the_screen_usable) {
  Screen screen = open_screen(sized(320, 200));
  static std::string told;
  told.clear();
  const auto made = make_draw_program(
      "broken", "#version 310 es\nvoid main() { gl_Position = vec4(0.0); }\n",
      "#version 310 es\nprecision highp float;\nout vec4 c;\nvoid main() { c = nowhere; }\n",
      [](std::string_view program, std::string_view log) {
        told = std::string(program) + ": " + std::string(log);
      });
  EXPECT_EQ(made.fault(), Fault::gl_shader);
  EXPECT_NE(told.find("broken: "), std::string::npos) << told;
  EXPECT_NE(told.find("nowhere"), std::string::npos) << told;
  screen.show_failed();
  EXPECT_TRUE(screen.health().failed_shown);
  const ShownPicture picture(320, 200);
  EXPECT_TRUE(screen.present(picture.texture()));
}

}  // namespace
}  // namespace ridgeline
