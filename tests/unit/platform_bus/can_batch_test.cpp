#include "platform/can_batch.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>

#include "platform/can_socket.hpp"

namespace ridgeline {
namespace {

/// Two ends of a line that keeps message boundaries, as a CAN socket does.
class CanBatchTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(::socketpair(AF_UNIX, SOCK_DGRAM, 0, ends_.data()), 0); }
  void TearDown() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  void send(const canfd_frame& frame, std::size_t size_bytes) {
    ASSERT_EQ(::send(ends_[1], &frame, size_bytes, 0), static_cast<ssize_t>(size_bytes));
  }
  int receive() { return batch_->receive(ends_[0], 1); }
  [[nodiscard]] const BusFrame& frame(std::size_t i) const { return batch_->frames()[i].frame; }

  std::array<int, 2> ends_{};
  std::unique_ptr<CanBatch> batch_ = std::make_unique<CanBatch>();
};

canfd_frame raw_frame(std::uint32_t id, std::uint8_t length) {
  canfd_frame frame = {};
  frame.can_id = id;
  frame.len = length;
  for (std::uint8_t i = 0; i < sizeof frame.data; ++i) frame.data[i] = i;
  return frame;
}

TEST_F(CanBatchTest, nothing_waiting_is_told_at_once) {
  EXPECT_EQ(receive(), EAGAIN);
  EXPECT_TRUE(batch_->frames().empty());
}

TEST_F(CanBatchTest, the_size_alone_tells_fd_from_classic) {
  canfd_frame classic = raw_frame(0x137, 8);
  classic.flags = 0xff;  // means nothing in a classic frame
  send(classic, CAN_MTU);
  send(raw_frame(0x138, 8), CANFD_MTU);
  ASSERT_EQ(receive(), 0);
  ASSERT_EQ(batch_->frames().size(), 2u);
  EXPECT_FALSE(frame(0).fd);
  EXPECT_TRUE(frame(1).fd);
  EXPECT_EQ(frame(0).interface, 1);
  EXPECT_EQ(batch_->counters().fd_frames, 1u);
}

TEST_F(CanBatchTest, flag_bits_never_stay_in_the_identifier) {
  send(raw_frame(0x10137 | CAN_EFF_FLAG, 8), CAN_MTU);
  send(raw_frame(0x137 | CAN_RTR_FLAG, 4), CAN_MTU);
  send(raw_frame(0x40u | CAN_ERR_FLAG, 8), CAN_MTU);
  ASSERT_EQ(receive(), 0);
  ASSERT_EQ(batch_->frames().size(), 3u);
  EXPECT_EQ(frame(0).id, 0x10137u);
  EXPECT_TRUE(frame(0).extended);
  EXPECT_TRUE(frame(1).remote);
  EXPECT_EQ(frame(1).data[1], 0) << "a remote frame carries no data";
  EXPECT_TRUE(frame(2).error);
  EXPECT_FALSE(frame(2).extended);
  EXPECT_EQ(frame(2).id, 0x40u);
}

TEST_F(CanBatchTest, what_is_no_whole_frame_is_counted_and_left_out) {
  send(raw_frame(0x137, 8), 10);          // short
  send(raw_frame(0x137, 9), CAN_MTU);     // more data than a classic frame holds
  send(raw_frame(0x137, 65), CANFD_MTU);  // more than any
  std::array<char, 100> longer{};
  ASSERT_EQ(::send(ends_[1], longer.data(), longer.size(), 0), 100);
  send(raw_frame(0x139, 1), CAN_MTU);
  ASSERT_EQ(receive(), 0);
  ASSERT_EQ(batch_->frames().size(), 1u);
  EXPECT_EQ(frame(0).id, 0x139u);
  EXPECT_EQ(batch_->counters().malformed, 4u);
}

TEST_F(CanBatchTest, a_frame_without_kernel_time_gets_the_time_of_reading_never_zero) {
  const std::int64_t real_ns = real_now_ns(), monotonic_ns = monotonic_now_ns();
  send(raw_frame(0x137, 1), CAN_MTU);
  ASSERT_EQ(receive(), 0);
  ASSERT_EQ(batch_->frames().size(), 1u);
  EXPECT_GE(frame(0).time_ns, real_ns);
  EXPECT_GE(batch_->frames()[0].monotonic_ns, monotonic_ns);
  EXPECT_LE(batch_->frames()[0].monotonic_ns, monotonic_now_ns());
  EXPECT_EQ(batch_->counters().not_stamped, 1u);
}

TEST_F(CanBatchTest, reading_goes_on_where_the_last_batch_was_full) {
  std::size_t sent = 0;
  const canfd_frame frame = raw_frame(0x137, 1);
  while (sent < CanBatch::capacity + 5 &&
         ::send(ends_[1], &frame, CAN_MTU, MSG_DONTWAIT) == CAN_MTU) {
    ++sent;
  }
  std::size_t got = 0;
  while (receive() == 0) got += batch_->frames().size();
  EXPECT_EQ(got, sent);
  EXPECT_GT(sent, 5u);
}

TEST(CanBufferBytes, the_default_of_linux_is_far_too_small_for_a_full_bus) {
  constexpr std::int64_t linux_default_bytes = 212'992;
  EXPECT_GT(can_buffer_bytes(100 * limits::ms_ns), linux_default_bytes);
  EXPECT_EQ(can_buffer_bytes(limits::second_ns),
            (limits::can_frames_per_second + 1) * limits::can_buffer_frame_bytes);
}

}  // namespace
}  // namespace ridgeline
