#include "platform/can_buses.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "platform/heap_counter.hpp"
#include "tests/rig/link.hpp"

namespace ridgeline {
namespace {

CanSettings settings_of(const char* name) {
  CanSettings settings;
  settings.interface = name;
  settings.filters.push_back({0x137, false});
  return settings;
}

class RigCanBuses : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(buses_.open(settings_of("rigcan1")).ok());
    ASSERT_TRUE(buses_.open(settings_of("rigcan2")).ok());
  }
  std::vector<ReceivedFrame> receive() {
    const std::span<const ReceivedFrame> frames = buses_.receive();
    return {frames.begin(), frames.end()};
  }
  rig::VirtualCan first_{"rigcan1"};
  rig::VirtualCan second_{"rigcan2"};
  CanBuses buses_;
};

TEST_F(RigCanBuses, frames_of_both_come_in_order_of_reception_and_say_from_where) {
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE((i % 2 == 0 ? second_ : first_).send("137#0" + std::to_string(i)));
  }
  const std::vector<ReceivedFrame> frames = receive();
  ASSERT_EQ(frames.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(frames[i].frame.data[0], i);
    EXPECT_EQ(frames[i].frame.interface, i % 2 == 0 ? 1 : 0);
  }
}

TEST_F(RigCanBuses, one_unplugged_leaves_the_other_alone) {
  ASSERT_TRUE(first_.unplug());
  ASSERT_TRUE(second_.send("137#07"));
  std::size_t got = 0;
  bool told = false;
  for (int i = 0; i < 100 && !(told && got == 1); ++i) {
    got += buses_.receive().size();
    told = told || buses_.fault(0) == Fault::can_unplugged;
    EXPECT_EQ(buses_.fault(1), Fault::none);
    ::usleep(10'000);
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(got, 1u);
  EXPECT_EQ(buses_[0].link(), CanLink::absent);
  EXPECT_EQ(buses_[1].link(), CanLink::up);
}

TEST_F(RigCanBuses, nothing_is_allocated_after_opening_whatever_the_links_do) {
  const std::uint64_t before = heap_allocations_counted();
  std::size_t got = 0;
  const auto run = [&](int rounds) {
    const HeapSection section;
    for (int i = 0; i < rounds; ++i) {
      got += buses_.receive().size();
      static_cast<void>(buses_[1].send(BusFrame{}));
      ::usleep(10'000);
    }
  };
  ASSERT_TRUE(first_.send("137#01"));
  run(10);
  ASSERT_TRUE(first_.unplug() && second_.down());
  run(10);
  ASSERT_TRUE(first_.plug() && second_.up());
  run(10);
  ASSERT_TRUE(first_.send("137#02"));
  run(10);
  EXPECT_EQ(got, 2u);
  EXPECT_EQ(buses_[0].counters().rebinds, 1u);
  EXPECT_EQ(buses_[1].counters().link_downs, 1u);
  EXPECT_EQ(heap_allocations_counted(), before);
  EXPECT_GT(heap_allocations_seen(), 0u) << "counting works";
}

TEST_F(RigCanBuses, a_third_is_refused) {
  EXPECT_EQ(buses_.open(settings_of("rigcan1")).fault(), Fault::capacity_exceeded);
}

}  // namespace
}  // namespace ridgeline
