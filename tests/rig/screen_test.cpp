// A monitor by mode setting, on a simulated card of a real kernel; what it shows is read back by
// way of the kernel, and the card's own checksum of its output is compared with it.
#include "platform/screen.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <xf86drm.h>

#include <array>
#include <optional>
#include <string>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "platform/screen_output.hpp"
#include "tests/rig/scanout.hpp"
#include "tests/support/shown_picture.hpp"

namespace ridgeline {
namespace {

using test::Scanout;
using test::ShownPicture;

constexpr int width = 640, height = 480;
constexpr std::uint32_t red = 0xE00000, black = 0;

ScreenSettings settings_for(const Scanout& scanout) {
  ScreenSettings settings;
  settings.kind = ScreenKind::kms;
  settings.card = scanout.card();
  settings.width_px = width;
  settings.height_px = height;
  settings.flip_timeout_ns = 10'000'000'000;  // emulation is slow
  settings.gpu_timeout_ns = 20'000'000'000;
  return settings;
}

class Monitor : public testing::Test {
 protected:
  void open(const ScreenSettings& settings) {
    ScreenDetail detail;
    auto made = Screen::make(settings, detail);
    ASSERT_TRUE(made) << fault_id(made.fault()) << ": " << detail.text;
    screen.emplace(std::move(made).value());
    picture.emplace(width, height);
  }
  void open() { open(settings_for(scanout)); }
  ~Monitor() override { picture.reset(); }

  Status send(std::uint32_t frame) {
    picture->draw(frame);
    return screen->present(picture->texture());
  }
  Status show(std::uint32_t frame) {
    const Status sent = send(frame);
    return sent ? screen->wait_shown() : sent;
  }
  /// Where the limit is short and the machine may be busy.
  Status show_in_time(std::uint32_t frame) {
    Status status = show(frame);
    for (int again = 0; again < 20 && status.fault() == Fault::screen_flip_late; ++again) {
      status = show(frame);
    }
    return status;
  }
  [[nodiscard]] int wrong(std::uint32_t frame) const {
    const Scanout::Picture shown = scanout.picture();
    if (shown.width_px != width || shown.height_px != height) return -1;
    return ShownPicture::wrong_pixels(frame, shown.rows.data(), width, width, height);
  }

  Scanout scanout;
  std::optional<Screen> screen;
  std::optional<ShownPicture> picture;
};

TEST_F(Monitor, is_set_to_the_mode_and_black_then_shows_every_pixel_top_row_up) {
  open();
  std::printf("%s; %s\n", screen->description(), screen->gl_description());
  Scanout::Picture shown = scanout.picture();
  EXPECT_EQ(shown.width_px, width);
  EXPECT_EQ(shown.height_px, height);
  for (const std::uint32_t pixel : shown.rows) ASSERT_EQ(pixel & 0xFFFFFF, black);
  std::uint32_t before = shown.buffer;
  for (std::uint32_t frame = 1; frame <= 6; ++frame) {
    ASSERT_TRUE(show(frame)) << frame;
    shown = scanout.picture();
    EXPECT_EQ(ShownPicture::wrong_pixels(frame, shown.rows.data(), width, width, height), 0);
    EXPECT_NE(shown.buffer, before) << "two buffers take turns";
    before = shown.buffer;
    EXPECT_EQ(screen->shown().picture, frame);
  }
  const auto put_out = scanout.checksum();
  ASSERT_TRUE(put_out);
  EXPECT_EQ(*put_out, Scanout::checksum(shown));
}

TEST_F(Monitor, flips_are_stamped_by_the_kernel_and_the_shown_buffer_is_never_drawn_to) {
  open();
  ASSERT_TRUE(show(1));
  std::int64_t time_ns = screen->shown().time_ns;
  std::uint32_t blank = screen->shown().vertical_blank;
  for (std::uint32_t frame = 2; frame <= 8; ++frame) {
    picture->draw(frame);
    glFinish();
    EXPECT_EQ(wrong(frame - 1), 0) << "while the next is drawn";
    ASSERT_TRUE(show(frame));
    EXPECT_GT(screen->shown().time_ns, time_ns);
    EXPECT_GT(screen->shown().vertical_blank, blank);
    EXPECT_LE(screen->shown().time_ns, screen_time_ns() + 20'000'000);
    time_ns = screen->shown().time_ns;
    blank = screen->shown().vertical_blank;
  }
}

TEST_F(Monitor, presenting_allocates_nothing_and_makes_no_gl_object) {
  open();
  ASSERT_TRUE(show(1));
  const std::uint64_t heap = heap_allocations_counted(), objects = gl_creations_counted();
  {
    const HeapSection no_heap;
    const GlSection no_objects;
    for (std::uint32_t frame = 0; frame < 5; ++frame) ASSERT_TRUE(show(frame));
    screen->show_failed();
    ASSERT_TRUE(show(1));
  }
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
}

TEST_F(Monitor, the_card_is_given_back_as_it_was_found) {
  const Scanout::Picture found = scanout.picture();
  open();
  ASSERT_TRUE(show(1));
  picture.reset();
  screen.reset();
  const Scanout::Picture left = scanout.picture();
  EXPECT_EQ(left.buffer, found.buffer);
  EXPECT_EQ(left.width_px, found.width_px);
}

TEST_F(Monitor, the_preferred_mode_needs_no_size) {
  ScreenSettings settings = settings_for(scanout);
  settings.width_px = settings.height_px = 0;
  settings.connector = scanout.connector();
  ScreenDetail detail;
  auto made = Screen::make(settings, detail);
  ASSERT_TRUE(made) << detail.text;
  EXPECT_EQ(made.value().width_px(), 1024);  // what the simulated monitor prefers
  EXPECT_EQ(made.value().height_px(), 768);
  EXPECT_EQ(scanout.picture().width_px, 1024);
}

TEST_F(Monitor, a_mode_it_does_not_have_is_refused_with_those_it_has) {
  ScreenSettings settings = settings_for(scanout);
  settings.width_px = 641;
  ScreenDetail detail;
  EXPECT_EQ(Screen::make(settings, detail).fault(), Fault::screen_no_mode);
  EXPECT_NE(std::string(detail.text).find("1024x768@60"), std::string::npos) << detail.text;
  settings.width_px = width;
  settings.refresh_hz = 23;
  EXPECT_EQ(Screen::make(settings, detail).fault(), Fault::screen_no_mode);
}

TEST_F(Monitor, one_that_is_not_there_is_refused_by_name) {
  ScreenSettings settings = settings_for(scanout);
  settings.connector = "HDMI-A-7";
  ScreenDetail detail;
  EXPECT_EQ(Screen::make(settings, detail).fault(), Fault::screen_no_monitor);
  EXPECT_NE(std::string(detail.text).find(scanout.connector()), std::string::npos) << detail.text;
  EXPECT_NE(std::string(detail.text).find("HDMI-A-7"), std::string::npos) << detail.text;
  settings.connector = "";
  scanout.plug(false);
  detail = {};
  EXPECT_EQ(Screen::make(settings, detail).fault(), Fault::screen_no_monitor);
  EXPECT_NE(std::string(detail.text).find("nothing connected"), std::string::npos) << detail.text;
  scanout.plug(true);
  open();
  EXPECT_TRUE(show(1));
}

TEST_F(Monitor, a_card_that_another_program_has_is_refused) {
  ASSERT_TRUE(scanout.take());
  ScreenDetail detail;
  EXPECT_EQ(Screen::make(settings_for(scanout), detail).fault(), Fault::screen_not_ours);
  EXPECT_NE(std::string(detail.text).find(scanout.card()), std::string::npos) << detail.text;
  scanout.give_back();
}

TEST_F(Monitor, a_card_taken_away_in_flight_is_taken_back_once_it_is_free) {
  open();
  ASSERT_TRUE(show(1));
  drmDropMaster(scanout.file_of_screen());  // as a switch of the console does
  ASSERT_TRUE(scanout.take());
  EXPECT_EQ(show(2).fault(), Fault::screen_not_ours);
  EXPECT_EQ(show(3).fault(), Fault::screen_not_ours);
  EXPECT_EQ(screen->shown().picture, 1U);
  EXPECT_EQ(wrong(1), 0);
  scanout.give_back();
  ASSERT_TRUE(show(4));
  EXPECT_EQ(wrong(4), 0);
  EXPECT_EQ(screen->health().faults, 2U);
}

TEST_F(Monitor, a_monitor_switched_off_by_others_is_set_again) {
  open();
  ASSERT_TRUE(show(1));
  scanout.switch_off();
  EXPECT_EQ(scanout.picture().width_px, 0);
  EXPECT_EQ(show(2).fault(), Fault::screen_refused);
  ASSERT_TRUE(show(3));
  EXPECT_EQ(wrong(3), 0);
}

TEST_F(Monitor, one_unplugged_in_flight_is_told_until_it_is_back) {
  open();
  ASSERT_TRUE(show(1));
  scanout.plug(false);
  EXPECT_EQ(show(2).fault(), Fault::screen_no_monitor);
  EXPECT_EQ(screen->health().fault, Fault::screen_no_monitor);
  scanout.plug(true);
  ASSERT_TRUE(show(3));
  EXPECT_EQ(wrong(3), 0);
  ASSERT_TRUE(show(4));
  EXPECT_EQ(wrong(4), 0);
}

TEST_F(Monitor, a_flip_never_told_is_late_then_asked_for_again) {
  ScreenSettings settings = settings_for(scanout);
  settings.flip_timeout_ns = 1'000'000'000;
  open(settings);
  ASSERT_TRUE(show_in_time(1));
  ASSERT_TRUE(send(2));
  // Its event is read by someone else, so that for the screen it never comes.
  const int file = ::dup(scanout.file_of_screen());
  std::array<char, 256> stolen{};
  ssize_t count = -1;
  for (int wait = 0; wait < 200 && count <= 0; ++wait) {
    count = ::read(file, stolen.data(), stolen.size());
    if (count <= 0) ::usleep(10'000);
  }
  ::close(file);
  ASSERT_GT(count, 0);
  const std::uint64_t before = screen->shown().picture;
  const std::int64_t start_ns = screen_time_ns();
  EXPECT_EQ(screen->wait_shown().fault(), Fault::screen_flip_late);
  // On a slow machine the flip that was asked for again has happened by now.
  const ShownStamp shown = screen->shown();
  EXPECT_TRUE(shown.picture == before ||
              shown.time_ns >= start_ns + settings.flip_timeout_ns - 20'000'000);
  EXPECT_TRUE(show_in_time(3));
  EXPECT_EQ(wrong(3), 0);
}

TEST_F(Monitor, the_failure_picture_stands_until_a_picture_follows) {
  open();
  ASSERT_TRUE(show(1));
  screen->show_failed();
  EXPECT_TRUE(screen->health().failed_shown);
  const Scanout::Picture shown = scanout.picture();
  ASSERT_EQ(shown.width_px, width);
  EXPECT_EQ(shown.at(width / 2, height / 2), red);
  for (const int x : {0, width - 1}) {
    for (const int y : {0, height - 1}) EXPECT_EQ(shown.at(x, y), red) << x << ' ' << y;
  }
  EXPECT_EQ(shown.at(width / 2, 20), black);
  EXPECT_EQ(shown.at(20, height / 2), black);
  const auto put_out = scanout.checksum();
  ASSERT_TRUE(put_out);
  EXPECT_EQ(*put_out, Scanout::checksum(shown));
  ASSERT_TRUE(show(2));
  EXPECT_EQ(wrong(2), 0);
}

TEST_F(Monitor, a_lost_context_leaves_the_last_picture_then_the_failure_picture) {
  open();
  ASSERT_TRUE(show(1));
  screen->ask_reset_status([]() -> GLenum { return 0x8254; });  // GL_INNOCENT_CONTEXT_RESET
  EXPECT_EQ(send(2).fault(), Fault::gl_context_lost);
  EXPECT_EQ(wrong(1), 0);
  screen->show_failed();
  picture.reset();
  ASSERT_TRUE(screen->renew());
  EXPECT_EQ(scanout.picture().at(width / 2, height / 2), red);
  picture.emplace(width, height);
  ASSERT_TRUE(show(3));
  EXPECT_EQ(wrong(3), 0);
}

}  // namespace
}  // namespace ridgeline
