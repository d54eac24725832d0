#include "core/bus/can_error.hpp"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

BusFrame error_frame(std::uint32_t classes, std::uint8_t details = 0) {
  BusFrame frame;
  frame.error = true;
  frame.id = classes;
  frame.length = 8;
  frame.data[1] = details;
  return frame;
}

CanController after(CanController previous, const BusFrame& frame) {
  return next_controller(previous, can_error_report(frame).value());
}

TEST(CanError, each_class_is_told_alone) {
  EXPECT_TRUE(can_error_report(error_frame(0x001)).value().transmit_timeout);
  EXPECT_TRUE(can_error_report(error_frame(0x002)).value().lost_arbitration);
  EXPECT_TRUE(can_error_report(error_frame(0x004, 0x01)).value().receive_overflow);
  EXPECT_TRUE(can_error_report(error_frame(0x004, 0x02)).value().transmit_overflow);
  EXPECT_TRUE(can_error_report(error_frame(0x008)).value().protocol_violation);
  EXPECT_TRUE(can_error_report(error_frame(0x010)).value().transceiver);
  EXPECT_TRUE(can_error_report(error_frame(0x020)).value().not_acknowledged);
  EXPECT_TRUE(can_error_report(error_frame(0x040)).value().bus_off);
  EXPECT_TRUE(can_error_report(error_frame(0x080)).value().bus_error);
  EXPECT_TRUE(can_error_report(error_frame(0x100)).value().restarted);
  const CanErrorReport off = can_error_report(error_frame(0x040, 0x30)).value();
  EXPECT_FALSE(off.passive) << "details count only with their class bit";
  EXPECT_FALSE(off.restarted);
}

TEST(CanError, counters_are_read_only_where_they_are_told) {
  BusFrame frame = error_frame(0x200);
  frame.data[6] = 96;
  frame.data[7] = 130;
  const CanErrorReport told = can_error_report(frame).value();
  EXPECT_EQ(told.transmit_errors, 96);
  EXPECT_EQ(told.receive_errors, 130);
  frame.id = 0x004;
  EXPECT_EQ(can_error_report(frame).value().receive_errors, 0);
}

TEST(CanError, other_frames_and_short_ones_are_refused) {
  EXPECT_EQ(can_error_report(BusFrame{}).fault(), Fault::bus_not_error);
  BusFrame frame = error_frame(0x040);
  frame.length = 7;
  EXPECT_EQ(can_error_report(frame).fault(), Fault::bus_length);
}

TEST(CanController, bus_off_is_left_by_a_restart_alone) {
  const CanController off = after(CanController::active, error_frame(0x040));
  EXPECT_EQ(off, CanController::bus_off);
  EXPECT_EQ(after(off, error_frame(0x004, 0x20)), CanController::bus_off);
  EXPECT_EQ(after(off, error_frame(0x020)), CanController::bus_off);
  EXPECT_EQ(after(off, error_frame(0x100)), CanController::active);
  EXPECT_EQ(after(off, error_frame(0x004, 0x40)), CanController::active);
}

TEST(CanController, warning_and_passive_follow_the_reports) {
  EXPECT_EQ(after(CanController::active, error_frame(0x004, 0x04)), CanController::warning);
  EXPECT_EQ(after(CanController::warning, error_frame(0x004, 0x10)), CanController::passive);
  EXPECT_EQ(after(CanController::passive, error_frame(0x004, 0x08)), CanController::warning);
  EXPECT_EQ(after(CanController::warning, error_frame(0x020)), CanController::warning);
}

}  // namespace
}  // namespace ridgeline
