#include "platform/gpio_lines.hpp"

#include <gtest/gtest.h>

#include "core/monitor/heartbeat.hpp"
#include "tests/rig/simulated_chip.hpp"

namespace ridgeline {
namespace {

using rig::SimulatedChip;
constexpr std::int64_t ms = limits::ms_ns;

GpioSettings settings() {
  GpioSettings made;
  made.outputs = {{{"rig-beat"}, {"rig-valid"}, {"rig-fail"}}};
  made.inputs = {{{"rig-on"}, {"rig-decl"}, {"rig-night"}, {"rig-ground", true}}};
  return made;
}

class RigGpio : public testing::Test {
 protected:
  Result<GpioLines> open() { return GpioLines::open(settings(), 0, refused_); }
  SimulatedChip chip_;
  const char* refused_ = "";
};

TEST_F(RigGpio, outputs_say_failed_from_the_first_moment_and_then_what_is_written) {
  Result<GpioLines> lines = open();
  ASSERT_TRUE(lines.ok()) << refused_ << ": " << fault_text(lines.fault());
  EXPECT_FALSE(chip_.value(0));
  EXPECT_FALSE(chip_.value(1));
  EXPECT_TRUE(chip_.value(2));
  ASSERT_TRUE(lines.value().write({true, true, false}).ok());
  EXPECT_TRUE(chip_.value(0));
  EXPECT_TRUE(chip_.value(1));
  EXPECT_FALSE(chip_.value(2));
}

TEST_F(RigGpio, the_heartbeat_line_moves_only_with_proven_frames) {
  Result<GpioLines> lines = open();
  ASSERT_TRUE(lines.ok());
  Heartbeat beat;
  int edges = 0;
  for (std::uint64_t frame = 1; frame <= 20; ++frame) {
    const std::int64_t now_ns = static_cast<std::int64_t>(frame) * 33 * ms;
    FrameProof proof{frame, now_ns - 10 * ms, now_ns + ms, now_ns, true, true};
    if (frame > 10) proof.newest_input_ns = 10 * 33 * ms - 10 * ms;  // the input freezes
    const bool before = chip_.value(0);
    beat = next_heartbeat(beat, proof, now_ns, 300 * ms).next;
    ASSERT_TRUE(lines.value().write({beat.level, true, false}).ok());
    edges += before != chip_.value(0) ? 1 : 0;
  }
  EXPECT_EQ(edges, 10);
}

TEST_F(RigGpio, inputs_count_once_they_have_stood_still) {
  chip_.pull(6, true);
  Result<GpioLines> lines = open();
  ASSERT_TRUE(lines.ok());
  GpioLines& gpio = lines.value();
  EXPECT_FALSE(gpio.level(DiscreteInput::declutter));
  EXPECT_FALSE(gpio.level(DiscreteInput::on_ground));  // active low, pulled up
  std::int64_t now_ns = 0;
  for (int i = 0; i < 10; ++i) {  // bounces every 10 ms
    chip_.pull(4, i % 2 == 0);
    now_ns += 10 * ms;
    ASSERT_TRUE(gpio.read(now_ns).ok());
    EXPECT_FALSE(gpio.level(DiscreteInput::declutter));
  }
  chip_.pull(4, true);
  ASSERT_TRUE(gpio.read(now_ns += 10 * ms).ok());
  ASSERT_TRUE(gpio.read(now_ns += 39 * ms).ok());
  EXPECT_FALSE(gpio.level(DiscreteInput::declutter));
  ASSERT_TRUE(gpio.read(now_ns += 1 * ms).ok());
  EXPECT_TRUE(gpio.level(DiscreteInput::declutter));
  EXPECT_EQ(gpio.input(DiscreteInput::declutter).changes, 1u);
  EXPECT_GE(gpio.input(DiscreteInput::declutter).bounces, 4u);
}

TEST_F(RigGpio, a_missing_or_busy_line_is_refused_by_name) {
  GpioSettings wrong = settings();
  wrong.inputs[2].name = "rig-no-such-line";
  EXPECT_EQ(GpioLines::open(wrong, 0, refused_).fault(), Fault::gpio_line_missing);
  EXPECT_STREQ(refused_, "rig-no-such-line");
  Result<GpioLines> first = open();
  ASSERT_TRUE(first.ok()) << "a refused open must let go of the lines it had";
  EXPECT_EQ(open().fault(), Fault::gpio_line_busy);
  EXPECT_STREQ(refused_, "rig-beat");
}

TEST_F(RigGpio, a_lost_chip_is_told_once_and_stops_the_heartbeat) {
  chip_.pull(4, true);
  Result<GpioLines> lines = open();
  ASSERT_TRUE(lines.ok());
  GpioLines& gpio = lines.value();
  ASSERT_TRUE(gpio.write({true, true, false}).ok());
  chip_.vanish();
  EXPECT_EQ(gpio.read(ms).fault(), Fault::gpio_line_lost);
  EXPECT_TRUE(gpio.line_lost());
  EXPECT_TRUE(gpio.read(2 * ms).ok());
  EXPECT_TRUE(gpio.write({false, true, false}).ok());
  EXPECT_TRUE(gpio.level(DiscreteInput::declutter));  // keeps its last level
}

}  // namespace
}  // namespace ridgeline
