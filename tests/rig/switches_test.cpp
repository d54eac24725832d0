// From lines of a chip to what the render thread acts on, by way of the supervisor.
#include <gtest/gtest.h>

#include <memory>

#include "platform/display/supervisor.hpp"
#include "tests/rig/simulated_chip.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t ms = limits::ms_ns;
constexpr int declutter = 4, night = 5, on_ground = 6;  // lines of the simulated chip

class RigSwitches : public testing::Test {
 protected:
  void SetUp() override {
    config_.lines.inputs = {{{"rig-on", false},
                             {"rig-decl", false},
                             {"rig-night", false},
                             {"rig-ground", true}}};  // the wheels pull the line to ground
    chip_.pull(on_ground, true);
    const char* refused = "";
    ASSERT_TRUE(supervisor_->open(refused).ok()) << refused;
  }
  /// Rounds of 10 ms.
  void wait(int time_ms) {
    for (const std::int64_t end_ns = now_ns_ + time_ms * ms; now_ns_ < end_ns;) {
      now_ns_ += 10 * ms;
      supervisor_->round(now_ns_);
    }
  }
  [[nodiscard]] AirGround air_ground() const { return exchange_->air_ground; }

  rig::SimulatedChip chip_;
  DisplayConfig config_;
  std::unique_ptr<Exchange> exchange_ = std::make_unique<Exchange>();
  std::unique_ptr<Supervisor> supervisor_ = std::make_unique<Supervisor>(config_, *exchange_);
  std::int64_t now_ns_ = monotonic_now_ns();
};

TEST_F(RigSwitches, reach_the_render_thread_once_they_have_stood_still) {
  wait(100);
  EXPECT_FALSE(exchange_->night);
  EXPECT_FALSE(exchange_->declutter);
  EXPECT_EQ(air_ground(), AirGround::air);
  chip_.pull(night, true);
  wait(30);
  EXPECT_FALSE(exchange_->night) << "not before it has stood still for 40 ms";
  wait(30);
  EXPECT_TRUE(exchange_->night);
  EXPECT_FALSE(exchange_->declutter) << "each line has its own meaning";
  chip_.pull(declutter, true);
  chip_.pull(on_ground, false);
  wait(60);
  EXPECT_TRUE(exchange_->declutter);
  EXPECT_EQ(air_ground(), AirGround::ground);
  chip_.pull(night, false);
  wait(60);
  EXPECT_FALSE(exchange_->night);
  EXPECT_TRUE(exchange_->declutter);
}

TEST_F(RigSwitches, of_a_lost_chip_stay_as_they_were_but_for_the_wheels) {
  chip_.pull(night, true);
  chip_.pull(on_ground, false);
  wait(60);
  ASSERT_EQ(air_ground(), AirGround::ground);
  chip_.vanish();
  wait(60);
  EXPECT_TRUE(exchange_->night) << "a picture that flashes up by night would blind";
  EXPECT_EQ(air_ground(), AirGround::unknown) << "a switch nobody can read contradicts nothing";
}

}  // namespace
}  // namespace ridgeline
