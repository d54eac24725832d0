// The flight program's drawing part in a window of a Wayland compositor, which is looked at.
#include <vector>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "tests/gl/flight_render_fixture.hpp"
#include "tests/screen/wayland_server.hpp"

namespace ridgeline {
namespace {

constexpr std::uint32_t red = 0xE00000;

class FlightWindow : public FlightRender {
 protected:
  void SetUp() override {
    FlightRender::SetUp();
    config_.screen.kind = ScreenKind::window;
    config_.screen.window_system = WindowSystem::wayland;
    config_.screen.wayland_display = server_.name();
    config_.timeouts.picture_ms = 2'000;  // tests run on busy machines
  }
  void TearDown() override {
    EXPECT_EQ(server_.broken_rules(), "");
    render_.reset();
  }
  /// Pixels of the window that are not those of the frame that was drawn last.
  int wrong() {
    std::vector<std::uint8_t> rgba(4 * render_->scene().pixels());
    render_->scene().read_colour(rgba);
    const test::SeenPixels seen = server_.window_pixels();
    if (4 * seen.rows.size() != rgba.size()) return -1;
    int count = 0;
    for (std::size_t i = 0; i < seen.rows.size(); ++i) {
      const auto channel = [&](std::size_t k) { return std::uint32_t{rgba[4 * i + k]}; };
      const std::uint32_t drawn = channel(0) << 16 | channel(1) << 8 | channel(2);
      count += (seen.rows[i] & 0xFFFFFF) != drawn ? 1 : 0;
    }
    return count;
  }
  /// Whether a line with these words was logged since the last time.
  bool logged(const std::string& words) {
    bool found = false;
    for (LogRecord record; exchange_->render_log.pop(record);) {
      found = found || std::string(record.text.data()).find(words) != std::string::npos;
    }
    return found;
  }
  [[nodiscard]] Fault fatal() const { return static_cast<Fault>(exchange_->fatal.load()); }

  test::WaylandServer server_;
};

TEST_F(FlightWindow, shows_the_flight_pixel_for_pixel_and_tells_its_latency) {
  boot();
  EXPECT_TRUE(logged("screen: wayland window 64x48 at " + std::string(server_.name())));
  fly_until_drawn();
  ASSERT_TRUE(render_->screen().wait_shown());
  EXPECT_EQ(wrong(), 0);
  EXPECT_TRUE(render_->fact().proof.bound_computed);
  EXPECT_TRUE(render_->fact().proof.fence_signalled);
  fly();
  EXPECT_GT(exchange_->latency.count(), 0u);
  EXPECT_EQ(render_->fact().present_faults, 0u);
  EXPECT_EQ(render_->fact().hidden, 0u);
}

TEST_F(FlightWindow, frames_allocate_nothing) {
  boot();
  fly_until_drawn();
  const std::uint64_t heap = heap_allocations_counted(), objects = gl_creations_counted();
  {
    const HeapSection no_heap;
    const GlSection no_objects;
    for (int i = 0; i < 10; ++i) fly();
  }
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
}

TEST_F(FlightWindow, hidden_is_no_fault_and_is_told) {
  boot();
  fly_until_drawn();
  EXPECT_FALSE(logged("hidden"));
  server_.hide_window(true);
  const std::int64_t end_ns = monotonic_now_ns() + 3 * limits::hidden_window_ns / 2;
  while (monotonic_now_ns() < end_ns) fly();
  EXPECT_TRUE(logged("the window is hidden"));
  EXPECT_GT(status_now()["frames"]["hidden"], 0);
  EXPECT_EQ(status_now()["frames"]["present_faults"], 0);
  EXPECT_TRUE(render_->fact().proof.fence_signalled) << "the flight goes on as before";
  EXPECT_FALSE(exchange_->stop);
  server_.hide_window(false);
  ASSERT_TRUE(render_->screen().wait_shown());
  fly();
  EXPECT_TRUE(logged("shows pictures again"));
  const std::uint64_t hidden = render_->fact().hidden;
  fly();
  EXPECT_EQ(render_->fact().hidden, hidden);
}

TEST_F(FlightWindow, a_compositor_that_hangs_proves_no_frame_and_ends_nothing) {
  config_.timeouts.picture_ms = 100;
  boot();
  fly_until_drawn();
  server_.stop();
  for (int i = 0; i < 3; ++i) fly();
  EXPECT_FALSE(render_->fact().proof.fence_signalled) << "what no one took proves nothing";
  EXPECT_GE(render_->fact().present_faults, 2u);
  EXPECT_TRUE(logged("screen: the page flip did not happen in time"));
  EXPECT_FALSE(exchange_->stop);
  server_.go_on();
  for (int i = 0; i < 50 && !render_->fact().proof.fence_signalled; ++i) fly();
  EXPECT_TRUE(render_->fact().proof.fence_signalled);
}

TEST_F(FlightWindow, closing_it_ends_the_program_with_the_failure_picture) {
  boot();
  fly_until_drawn();
  server_.close_window();
  for (int i = 0; i < 5 && !exchange_->stop; ++i) fly();
  EXPECT_TRUE(exchange_->stop);
  EXPECT_EQ(fatal(), Fault::screen_closed);
  EXPECT_FALSE(render_->fact().proof.fence_signalled);
  EXPECT_TRUE(render_->screen().health().failed_shown);
  EXPECT_TRUE(server_.becomes(32, 24, red));
}

TEST_F(FlightWindow, a_compositor_that_dies_ends_the_program_and_why_is_told) {
  boot();
  fly_until_drawn();
  server_.accuse("no such window");
  for (int i = 0; i < 5 && !exchange_->stop; ++i) fly();
  EXPECT_TRUE(exchange_->stop);
  EXPECT_EQ(fatal(), Fault::screen_lost);
  EXPECT_FALSE(render_->fact().proof.fence_signalled);
  EXPECT_TRUE(logged("no such window"));
}

}  // namespace
}  // namespace ridgeline
