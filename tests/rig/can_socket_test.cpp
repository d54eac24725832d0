#include "platform/can_socket.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <vector>

#include "core/bus/canas_services.hpp"
#include "tests/rig/link.hpp"

namespace ridgeline {
namespace {

CanSettings settings_of(const std::string& name) {
  CanSettings settings;
  settings.interface = name;
  settings.filters.push_back({0x137, false});
  settings.filters.push_back({0x10138, true});
  settings.filters.push_back({128, false});
  return settings;
}

/// Reads until `count` frames came or 2 s went by.
std::vector<ReceivedFrame> read_frames(CanSocket& can, std::size_t count) {
  std::vector<ReceivedFrame> all;
  const std::int64_t end_ns = monotonic_now_ns() + 2 * limits::second_ns;
  while (all.size() < count && monotonic_now_ns() < end_ns) {
    pollfd waiting = {can.descriptor(), POLLIN, 0};
    ::poll(&waiting, 1, 20);
    static_cast<void>(can.receive());
    all.insert(all.end(), can.frames().begin(), can.frames().end());
  }
  return all;
}

/// Reads until the socket says `fault`, or 2 s went by.
bool says(CanSocket& can, Fault fault) {
  for (int i = 0; i < 200; ++i) {
    if (can.receive().fault() == fault) return true;
    ::usleep(10'000);
  }
  return false;
}

bool reaches(CanSocket& can, CanLink link) {
  for (int i = 0; i < 200 && can.link() != link; ++i) {
    static_cast<void>(can.receive());
    ::usleep(10'000);
  }
  return can.link() == link;
}

class RigCan : public testing::Test {
 protected:
  rig::VirtualCan bus_{"rigcan0"};
};

TEST_F(RigCan, only_the_wanted_kind_of_an_identifier_passes) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok()) << fault_text(can.fault());
  ASSERT_TRUE(bus_.send("00010137#0102002A40F00000"));  // redundancy channel 1 of the same id
  ASSERT_TRUE(bus_.send("137#R"));
  ASSERT_TRUE(bus_.send("138#01"));
  ASSERT_TRUE(bus_.send("137#0102002A40F00000"));
  ASSERT_TRUE(bus_.send("00010138#0102002A40F00000"));
  const std::vector<ReceivedFrame> frames = read_frames(can.value(), 3);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].frame.id, 0x137u);
  EXPECT_FALSE(frames[0].frame.extended);
  EXPECT_EQ(frames[0].frame.data[4], 0x40);
  EXPECT_TRUE(frames[0].sent_here);
  EXPECT_EQ(frames[1].frame.id, 0x10138u);
  EXPECT_TRUE(frames[1].frame.extended);
}

TEST_F(RigCan, both_clocks_tell_when_the_kernel_received_a_frame) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok());
  static_cast<void>(can.value().receive());
  const std::int64_t before_ns = monotonic_now_ns(), real_before_ns = real_now_ns();
  ASSERT_TRUE(bus_.send("137#01"));
  const std::int64_t after_ns = monotonic_now_ns(), real_after_ns = real_now_ns();
  ::usleep(100'000);  // the time of reading must not matter
  const std::vector<ReceivedFrame> frames = read_frames(can.value(), 1);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(can.value().received().not_stamped, 0u);
  EXPECT_GE(frames[0].frame.time_ns, real_before_ns);
  EXPECT_LE(frames[0].frame.time_ns, real_after_ns);
  constexpr std::int64_t slack_ns = 20 * limits::ms_ns;  // two clocks read one after the other
  EXPECT_GE(frames[0].monotonic_ns, before_ns - slack_ns);
  EXPECT_LE(frames[0].monotonic_ns, after_ns + slack_ns);
}

TEST_F(RigCan, an_fd_frame_is_never_read_as_a_classic_one) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok());
  ASSERT_TRUE(bus_.send("137##1112233445566778899AABBCC"));
  ASSERT_TRUE(bus_.send("137#01"));
  const std::vector<ReceivedFrame> frames = read_frames(can.value(), 2);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_TRUE(frames[0].frame.fd);
  EXPECT_EQ(frames[0].frame.length, 12);
  EXPECT_FALSE(frames[1].frame.fd);
  EXPECT_EQ(can.value().received().fd_frames, 1u);
}

TEST_F(RigCan, error_frames_tell_the_state_of_the_controller) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok());
  ASSERT_TRUE(bus_.send("20000004#0020000000000000"));
  ASSERT_EQ(read_frames(can.value(), 1).size(), 1u);
  EXPECT_EQ(can.value().controller(), CanController::passive);
  ASSERT_TRUE(bus_.send("20000040#0000000000000000"));
  ASSERT_EQ(read_frames(can.value(), 1).size(), 1u);
  EXPECT_EQ(can.value().controller(), CanController::bus_off);
  ASSERT_TRUE(bus_.send("20000100#0000000000000000"));
  ASSERT_EQ(read_frames(can.value(), 1).size(), 1u);
  EXPECT_EQ(can.value().controller(), CanController::active);
  ASSERT_TRUE(bus_.send("20000004#0001000000000000"));
  ASSERT_TRUE(bus_.send("20000020#0000000000000000"));
  ASSERT_EQ(read_frames(can.value(), 2).size(), 2u);
  const CanCounters& counters = can.value().counters();
  EXPECT_EQ(counters.passives, 1u);
  EXPECT_EQ(counters.bus_offs, 1u);
  EXPECT_EQ(counters.restarts, 1u);
  EXPECT_EQ(counters.receive_overflows, 1u);
  EXPECT_EQ(counters.not_acknowledged, 1u);
}

TEST_F(RigCan, a_link_that_goes_down_is_told_once_and_works_again_when_up) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok());
  ASSERT_TRUE(bus_.down());
  EXPECT_TRUE(says(can.value(), Fault::can_link_down));
  EXPECT_EQ(can.value().link(), CanLink::down);
  ::usleep(100'000);
  EXPECT_TRUE(can.value().receive().ok());
  EXPECT_EQ(can.value().counters().link_downs, 1u);
  EXPECT_EQ(can.value().send(BusFrame{}).fault(), Fault::can_send);
  ASSERT_TRUE(bus_.up());
  EXPECT_TRUE(reaches(can.value(), CanLink::up));
  ASSERT_TRUE(bus_.send("137#01"));
  EXPECT_EQ(read_frames(can.value(), 1).size(), 1u);
}

TEST_F(RigCan, an_adapter_unplugged_and_back_is_bound_again_with_its_filters) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok());
  ASSERT_TRUE(bus_.unplug());
  EXPECT_TRUE(reaches(can.value(), CanLink::absent));
  EXPECT_EQ(can.value().counters().unplugs, 1u);
  ASSERT_TRUE(bus_.plug());
  EXPECT_TRUE(reaches(can.value(), CanLink::up));
  EXPECT_EQ(can.value().counters().rebinds, 1u);
  ASSERT_TRUE(bus_.send("138#01"));  // still not wanted
  ASSERT_TRUE(bus_.send("137#01"));
  ASSERT_TRUE(bus_.send("20000040#0000000000000000"));
  const std::vector<ReceivedFrame> frames = read_frames(can.value(), 3);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].frame.id, 0x137u);
  EXPECT_TRUE(frames[1].frame.error);
}

TEST_F(RigCan, an_adapter_exchanged_between_two_looks_is_noticed) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  ASSERT_TRUE(can.ok());
  ASSERT_TRUE(bus_.unplug());
  ASSERT_TRUE(bus_.plug());
  for (int i = 0; i < 100 && can.value().counters().rebinds == 0; ++i) {
    static_cast<void>(can.value().receive());
    ::usleep(10'000);
  }
  EXPECT_EQ(can.value().counters().rebinds, 1u);
  ASSERT_TRUE(bus_.send("137#01"));
  EXPECT_EQ(read_frames(can.value(), 1).size(), 1u);
}

TEST_F(RigCan, the_buffer_outlasts_the_stall_it_was_sized_for) {
  CanSettings settings = settings_of("rigcan0");
  settings.stall_ns = 100 * limits::ms_ns;
  Result<CanSocket> can = CanSocket::open(settings);
  ASSERT_TRUE(can.ok()) << fault_text(can.fault());
  EXPECT_GE(can.value().buffer_bytes(), can_buffer_bytes(settings.stall_ns));
  ASSERT_TRUE(rig::shell("cangen rigcan0 -I 137 -L 8 -g 0 -n 2127 -p 10"));
  EXPECT_EQ(read_frames(can.value(), 2127).size(), 2127u);
  ASSERT_TRUE(bus_.send("137#01"));
  EXPECT_EQ(read_frames(can.value(), 1).size(), 1u);
  EXPECT_EQ(can.value().received().dropped, 0u);
}

TEST_F(RigCan, frames_that_the_kernel_dropped_are_counted) {
  CanSettings settings = settings_of("rigcan0");
  settings.stall_ns = limits::ms_ns;
  Result<CanSocket> can = CanSocket::open(settings);
  ASSERT_TRUE(can.ok()) << fault_text(can.fault());
  ASSERT_TRUE(rig::shell("cangen rigcan0 -I 137 -L 8 -g 0 -n 500 -p 10"));
  const std::size_t kept = read_frames(can.value(), 500).size();
  EXPECT_LT(kept, 500u);
  ASSERT_TRUE(bus_.send("137#01"));  // the kernel tells with the next frame that it delivers
  ASSERT_EQ(read_frames(can.value(), 1).size(), 1u);
  EXPECT_EQ(kept + can.value().received().dropped, 500u);
}

TEST_F(RigCan, an_identification_request_is_answered_on_the_bus) {
  Result<CanSocket> can = CanSocket::open(settings_of("rigcan0"));
  CanSettings asker;
  asker.interface = "rigcan0";
  asker.filters.push_back({129, false});
  Result<CanSocket> other = CanSocket::open(asker);
  ASSERT_TRUE(can.ok() && other.ok());
  ASSERT_TRUE(bus_.send("080#00000007"));
  const std::vector<ReceivedFrame> asked = read_frames(can.value(), 1);
  ASSERT_EQ(asked.size(), 1u);
  const std::optional<BusFrame> reply = ids_reply(asked[0].frame, {9, 1, 2});
  ASSERT_TRUE(reply.has_value());
  ASSERT_TRUE(can.value().send(*reply).ok());
  const std::vector<ReceivedFrame> answer = read_frames(other.value(), 1);
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_EQ(answer[0].frame.data, reply->data);
  EXPECT_TRUE(read_frames(can.value(), 0).empty());
}

TEST_F(RigCan, an_interface_that_is_not_there_is_refused) {
  EXPECT_EQ(CanSocket::open(settings_of("rigcan9")).fault(), Fault::can_interface_missing);
  EXPECT_EQ(CanSocket::open(settings_of("")).fault(), Fault::can_interface_missing);
  EXPECT_EQ(CanSocket::open(settings_of("a_name_too_long_")).fault(), Fault::can_interface_missing);
}

}  // namespace
}  // namespace ridgeline
