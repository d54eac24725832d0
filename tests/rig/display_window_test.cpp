// The whole flight program in a window of a Wayland compositor of the tests' own.
#include <png.h>

#include <iostream>

#include "tests/rig/display_fixture.hpp"
#include "tests/screen/wayland_server.hpp"

namespace ridgeline::rig {
namespace {

class RigWindow : public RigDisplay {
 protected:
  RigWindow() {
    InstallationSettings settings;
    settings.screen = "window";
    settings.wayland_display = server_.name();
    installed_.configure(settings);
  }
  ~RigWindow() override { EXPECT_EQ(server_.broken_rules(), ""); }

  /// Pixels of the window that are not those of the frame that the program has left.
  int wrong() {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const std::string path = installed_.file("last") + "/000000_color.png";
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return -1;
    image.format = PNG_FORMAT_BGRA;
    std::vector<std::uint32_t> left(PNG_IMAGE_SIZE(image) / 4);
    if (png_image_finish_read(&image, nullptr, left.data(), 0, nullptr) == 0) return -1;
    const test::SeenPixels seen = server_.window_pixels();
    if (seen.rows.size() != left.size()) return -1;
    int count = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      count += ((seen.rows[i] ^ left[i]) & 0xFFFFFF) != 0 ? 1 : 0;
    }
    return count;
  }

  test::WaylandServer server_;
};

TEST_F(RigWindow, shows_the_flight_hidden_or_not_and_a_compositor_that_hangs_fails) {
  Process program(installed_.program(), installed_.file("errors"));
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_EQ(program.times_told("screen: wayland window 64x48 at "), 1) << program.told();
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(beats());
  EXPECT_TRUE(reported([](const auto& status) { return status["latency_ms"]["count"] > 0; }))
      << "the compositor has not told when a picture was shown";

  server_.hide_window(true);
  EXPECT_TRUE(tells(program, "screen: the window is hidden")) << program.told();
  EXPECT_TRUE(beats()) << "a hidden window is no fault";
  EXPECT_TRUE(lines_are(true, false));
  server_.hide_window(false);
  EXPECT_TRUE(tells(program, "screen: shows pictures again")) << program.told();
  EXPECT_EQ(installed_.status()["frames"]["present_faults"], 0);

  server_.stop();
  EXPECT_TRUE(lines_say(false, true)) << program.told();
  EXPECT_TRUE(tells(program, "screen: the page flip did not happen in time")) << program.told();
  server_.go_on();
  EXPECT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(beats());

  expect_stopped(program);
  // A compositor hears of the end before it reads what came just before it: the window holds the
  // last frame or the one before, a quarter of a second of slow flight earlier.
  const int differing = wrong();
  EXPECT_GE(differing, 0);
  EXPECT_LE(differing, 64 * 48 / 100) << "the window holds what was drawn last";
  EXPECT_TRUE(rig::shell(std::string(RIDGELINE_PROGRAM) + " verify " + installed_.file("last") +
                         " --terrain " + installed_.file("tiles") + " --pixels all"))
      << "the last frame must keep its promise";
  std::cout << program.told();
}

TEST_F(RigWindow, closed_or_lost_ends_the_program_with_svs_fail) {
  Process player(installed_.player(), installed_.file("player"));
  for (const bool closed : {true, false}) {
    Process program(installed_.program(), installed_.file("errors"));
    ASSERT_TRUE(booted(program)) << program.told();
    ASSERT_TRUE(lines_say(true, false)) << program.told();
    if (closed) {
      server_.close_window();
    } else {
      server_.kill();
    }
    EXPECT_EQ(program.status(soon_s), 1) << program.told();
    EXPECT_EQ(
        program.times_told(closed ? "ended: the window was closed" : "ended: the screen has gone"),
        1)
        << program.told();
    EXPECT_EQ(installed_.status()["state"], closed ? "screen_closed" : "screen_lost");
    EXPECT_EQ(installed_.status()["lines"]["svs_fail"], true);
    EXPECT_EQ(installed_.status()["lines"]["svs_valid"], false);
  }
  Process program(installed_.program(), installed_.file("errors"));
  EXPECT_EQ(program.status(soon_s), 3) << program.told();
  EXPECT_EQ(program.times_told("no Wayland compositor at"), 1) << program.told();
}

}  // namespace
}  // namespace ridgeline::rig
