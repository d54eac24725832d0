#include "platform/display/supervisor.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t ms = limits::ms_ns;
constexpr std::size_t valid = static_cast<std::size_t>(DiscreteOutput::svs_valid);
constexpr std::size_t fail = static_cast<std::size_t>(DiscreteOutput::svs_fail);

/// A supervisor without lines: what it would put on them is its status.
class SupervisorTest : public testing::Test {
 protected:
  void SetUp() override {
    config_.timeouts.picture_ms = 500;
    config_.timeouts.heartbeat_input_ms = 300;
    make();
  }
  void make() {
    supervisor_ = std::make_unique<Supervisor>(config_, *exchange_);
    const char* refused = "";
    ASSERT_TRUE(supervisor_->open(refused).ok());
  }
  /// One frame that proves everything, finished at `now`.
  void frame(std::int64_t now_ns) {
    ++fact_.proof.frame;
    fact_.proof.newest_input_ns = now_ns - 20 * ms;
    fact_.proof.finished_ns = now_ns;
    fact_.proof.deadline_ns = now_ns + 1;
    fact_.proof.bound_computed = true;
    fact_.proof.fence_signalled = true;
    exchange_->frame.write(fact_);
    supervisor_->round(now_ns);
  }
  void bus_round() {
    ++bus_.rounds;
    exchange_->bus_status.write(bus_);
  }
  [[nodiscard]] const LineStatus& status() const { return supervisor_->status(); }

  DisplayConfig config_;
  std::unique_ptr<Exchange> exchange_ = std::make_unique<Exchange>();
  std::unique_ptr<Supervisor> supervisor_;
  FrameFact fact_;
  BusStatus bus_;
};

TEST_F(SupervisorTest, before_any_frame_the_lines_say_failed) {
  supervisor_->round(10 * ms);
  EXPECT_EQ(status().outputs, boot_levels);
}

TEST_F(SupervisorTest, proven_frames_move_the_heartbeat_and_say_valid) {
  for (int i = 1; i <= 10; ++i) {
    frame(i * 33 * ms);
    supervisor_->round(i * 33 * ms + 10 * ms);
  }
  EXPECT_EQ(status().heartbeat.edges, 10u);
  EXPECT_TRUE(status().outputs[valid]);
  EXPECT_FALSE(status().outputs[fail]);
}

TEST_F(SupervisorTest, without_switches_it_is_day_with_everything_and_nobody_knows_of_wheels) {
  supervisor_->round(10 * ms);
  EXPECT_TRUE(exchange_->display_on);
  EXPECT_FALSE(exchange_->night);
  EXPECT_FALSE(exchange_->declutter);
  EXPECT_EQ(exchange_->air_ground.load(), AirGround::unknown);
}

TEST_F(SupervisorTest, a_hung_renderer_ends_the_heartbeat_and_fails_after_its_time) {
  frame(33 * ms);
  const std::uint64_t edges = status().heartbeat.edges;
  for (std::int64_t now_ns = 43 * ms; now_ns <= 533 * ms; now_ns += 10 * ms) {
    supervisor_->round(now_ns);
    EXPECT_TRUE(status().outputs[valid]) << now_ns;
  }
  supervisor_->round(543 * ms);
  EXPECT_FALSE(status().outputs[valid]);
  EXPECT_TRUE(status().outputs[fail]);
  EXPECT_EQ(status().heartbeat.edges, edges);
  EXPECT_EQ(status().stalls, 1u);
  frame(600 * ms);
  EXPECT_TRUE(status().outputs[valid]) << "frames have come again";
}

TEST_F(SupervisorTest, a_frozen_input_ends_the_heartbeat_though_frames_go_on) {
  frame(33 * ms);
  const std::int64_t frozen_ns = fact_.proof.newest_input_ns;
  for (int i = 2; i < 20; ++i) {
    ++fact_.proof.frame;
    fact_.proof.newest_input_ns = frozen_ns;
    fact_.proof.finished_ns = i * 33 * ms;
    fact_.proof.deadline_ns = i * 33 * ms + 1;
    exchange_->frame.write(fact_);
    supervisor_->round(i * 33 * ms);
  }
  EXPECT_EQ(status().heartbeat.edges, 1u);
  using enum HeartbeatRefusal;
  EXPECT_EQ(status().heartbeat.refusals[static_cast<std::size_t>(input_not_new)], 18u);
}

TEST_F(SupervisorTest, a_frame_finished_during_the_round_is_not_one_of_the_future) {
  fact_.proof = {1, 20 * ms, 40 * ms, 34 * ms, true, true};
  exchange_->frame.write(fact_);
  supervisor_->round(33 * ms);
  EXPECT_EQ(status().heartbeat.edges, 1u);
}

TEST_F(SupervisorTest, removed_terrain_and_pictures_not_shown_are_failures) {
  frame(33 * ms);
  fact_.availability.mode = Mode::removed;
  frame(66 * ms);
  EXPECT_FALSE(status().outputs[valid]);
  EXPECT_TRUE(status().outputs[fail]);
  fact_.availability.mode = Mode::degraded;
  frame(99 * ms);
  EXPECT_TRUE(status().outputs[valid]);
  ++fact_.proof.frame;
  fact_.proof.fence_signalled = false;
  exchange_->frame.write(fact_);
  supervisor_->round(110 * ms);
  EXPECT_FALSE(status().outputs[valid]);
  EXPECT_TRUE(status().outputs[fail]);
}

TEST_F(SupervisorTest, the_end_puts_boot_levels_on_the_lines) {
  frame(33 * ms);
  supervisor_->let_go();
  EXPECT_EQ(status().outputs, boot_levels);
}

/// A service manager that listens.
class Listener {
 public:
  explicit Listener(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~Listener() {
    ::unsetenv("NOTIFY_SOCKET");
    ::close(socket_);
  }
  std::vector<std::string> heard() const {
    std::vector<std::string> messages;
    char text[256];
    for (ssize_t n = 0; (n = ::recv(socket_, text, sizeof text, MSG_DONTWAIT)) > 0;) {
      messages.emplace_back(text, static_cast<std::size_t>(n));
    }
    return messages;
  }

 private:
  int socket_;
};

TEST_F(SupervisorTest, the_service_manager_hears_of_life_not_of_success) {
  const test::ScratchFolder folder("notify");
  const Listener manager(folder.file("socket"));
  make();
  bus_round();
  fact_.availability.mode = Mode::removed;  // no bus value was ever received: alive all the same
  frame(33 * ms);
  EXPECT_EQ(manager.heard(),
            (std::vector<std::string>{"READY=1", "STATUS=picture: removed", "WATCHDOG=1"}));
  frame(66 * ms);
  EXPECT_TRUE(manager.heard().empty()) << "the bus thread is dead";
  bus_round();
  supervisor_->round(76 * ms);
  EXPECT_EQ(manager.heard(), (std::vector<std::string>{"WATCHDOG=1"}));
  bus_round();
  supervisor_->round(86 * ms);
  EXPECT_TRUE(manager.heard().empty()) << "the render thread is dead";
  supervisor_->let_go();
  EXPECT_EQ(manager.heard(), (std::vector<std::string>{"STOPPING=1"}));
}

TEST_F(SupervisorTest, the_service_manager_hears_what_the_picture_is_when_it_changes) {
  const test::ScratchFolder folder("notify");
  const Listener manager(folder.file("socket"));
  make();
  supervisor_->round(10 * ms);
  EXPECT_TRUE(manager.heard().empty()) << "before a frame there is nothing to tell";
  fact_.availability.mode = Mode::svs;
  frame(33 * ms);
  EXPECT_EQ(manager.heard(), (std::vector<std::string>{"READY=1", "STATUS=picture: svs"}));
  frame(66 * ms);
  EXPECT_TRUE(manager.heard().empty()) << "the same as before";
  fact_.availability.mode = Mode::degraded;
  fact_.availability.reasons.push_back(Reason::bound_for_time);
  frame(99 * ms);
  EXPECT_EQ(manager.heard(), (std::vector<std::string>{"STATUS=picture: degraded bound_for_time"}));
  supervisor_->round(700 * ms);
  EXPECT_EQ(manager.heard(), (std::vector<std::string>{"STATUS=picture: no new frame for 500 ms"}));
  frame(733 * ms);
  EXPECT_EQ(manager.heard(), (std::vector<std::string>{"STATUS=picture: degraded bound_for_time"}));
}

}  // namespace
}  // namespace ridgeline
