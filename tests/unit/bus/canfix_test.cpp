// CAN-FIX parameter frames: published vectors, function codes, sizes, the datum of the height.
#include "core/bus/canfix.hpp"

#include <gtest/gtest.h>

#include "tests/unit/bus/other_frames.hpp"
#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using P = BusParameter;
using testing::canfix_frame;
using testing::canfix_steps;
using testing::frame_of;
using testing::Ownship;

BusProfile profile() {
  BusProfile made;
  made.protocol = BusProtocol::canfix;
  made.canfix_height_is_ellipsoidal = true;
  return made;
}

DecodeStep decoded(const BusFrame& frame) {
  return decoded_frame({}, frame, profile());
}

double value_of(const BusFrame& frame) {
  const DecodeStep step = decoded(frame);
  EXPECT_TRUE(step.value) << fault_id(step.fault);
  return step.value ? step.value->value : std::nan("");
}

Fault fault_of(const BusFrame& frame) {
  const DecodeStep step = decoded(frame);
  EXPECT_FALSE(step.value);
  return step.fault;
}

constexpr double mps_per_kt = 1852.0 / 3600.0;

TEST(Canfix, published_vectors_decode) {
  EXPECT_DOUBLE_EQ(value_of(frame_of("180#0200009AFF")), -1.02);
  EXPECT_EQ(decoded(frame_of("180#0200009AFF")).value->parameter, P::pitch);
  EXPECT_EQ(decoded(frame_of("180#0200009AFF")).value->source.node_id, 2);
  EXPECT_EQ(value_of(frame_of("1C4#020000E3A5E6C2")), static_cast<double>(-115.324F));
  EXPECT_EQ(value_of(frame_of("1C3#0200000000B442")), 90.0);
  EXPECT_DOUBLE_EQ(value_of(frame_of("183#0200000F27")), 999.9 * mps_per_kt);
  EXPECT_DOUBLE_EQ(value_of(frame_of("40A#02000018FCFFFF")), -1000.0 * 0.3048);
  EXPECT_DOUBLE_EQ(value_of(frame_of("580#0200000D173B2C02")),
                   13 * 3600.0 + 23 * 60.0 + 59.0 + 0.556);
}

TEST(Canfix, the_function_code_is_believed_before_the_value) {
  EXPECT_EQ(fault_of(frame_of("180#0200029AFF")), Fault::bus_quality);
  EXPECT_EQ(fault_of(frame_of("180#0200049AFF")), Fault::bus_failure_warning);
  EXPECT_EQ(fault_of(frame_of("180#0200069AFF")), Fault::bus_failure_warning);
  EXPECT_EQ(fault_of(frame_of("180#0200089AFF")), Fault::bus_type_reserved);
  EXPECT_EQ(fault_of(frame_of("183#0200F00F27")), Fault::bus_not_value);
  EXPECT_DOUBLE_EQ(value_of(frame_of("180#0200019AFF")), -1.02);
  for (unsigned function = 0; function < 256; ++function) {
    EXPECT_EQ(decoded(canfix_frame(384, {0x10, 0}, 0.0, function)).value.has_value(),
              function == 0 || function == 1)
        << function;
  }
}

TEST(Canfix, the_data_have_exactly_the_size_of_their_type) {
  EXPECT_EQ(fault_of(frame_of("40A#02000018FC")), Fault::bus_length);
  for (const CanfixRow& row : canfix_icd) {
    for (int length = 0; length <= 8; ++length) {
      BusFrame frame = canfix_frame(row.id, {0, 0, 0, 0, 0});
      frame.length = static_cast<std::uint8_t>(length);
      if (length == 3 + canfix_size_bytes(row.type)) {
        EXPECT_EQ(value_of(frame), 0.0) << row.id;
      } else {
        EXPECT_EQ(fault_of(frame), Fault::bus_length) << row.id;
      }
    }
  }
}

TEST(Canfix, every_integer_parameter_comes_back_in_its_unit) {
  for (const CanfixRow& row : canfix_icd) {
    if (row.type == CanfixType::float32 || row.type == CanfixType::time) continue;
    const BusQuantity& quantity = icd_row(row.parameter).quantity;
    const std::int64_t least = row.type == CanfixType::uint16 ? 0 : -32768;
    const std::int64_t most = row.type == CanfixType::uint16 ? 65535 : 32767;
    for (std::int64_t steps = least; steps <= most; steps += 257) {
      const double value = static_cast<double>(steps) * row.unit_per_step;
      const DecodeStep step = decoded(canfix_steps(row, steps));
      if (step.value) {
        const double wrapped = quantity.wraps ? std::remainder(value - step.value->value, 360.0)
                                              : value - step.value->value;
        EXPECT_NEAR(wrapped, 0.0, 1e-9) << row.id << ' ' << steps;
      } else {
        EXPECT_EQ(step.fault, Fault::bus_value_out_of_range);
        EXPECT_TRUE(value < quantity.minimum || value > quantity.maximum || quantity.wraps);
      }
    }
  }
}

TEST(Canfix, heading_and_track_beyond_half_a_turn_are_wrapped) {
  EXPECT_NEAR(value_of(canfix_steps(*canfix_row(389), 3599)), -0.1, 1e-12);
  EXPECT_NEAR(value_of(canfix_steps(*canfix_row(454), 1800)), -180.0, 1e-12);
  EXPECT_EQ(fault_of(canfix_steps(*canfix_row(389), 65535)), Fault::bus_value_out_of_range);
}

TEST(Canfix, floats_that_are_no_number_are_refused) {
  EXPECT_EQ(fault_of(frame_of("1C3#0200000000C07F")), Fault::bus_value_not_finite);
  EXPECT_EQ(fault_of(frame_of("1C3#020000000080FF")), Fault::bus_value_not_finite);
  EXPECT_EQ(fault_of(frame_of("1C3#0200000100B442")), Fault::bus_value_out_of_range);
}

TEST(Canfix, a_clock_is_a_clock) {
  EXPECT_EQ(fault_of(canfix_frame(1408, {24, 0, 0, 0, 0})), Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(canfix_frame(1408, {0, 60, 0, 0, 0})), Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(canfix_frame(1408, {0, 0, 0, 0xe8, 3})), Fault::bus_value_out_of_range);
  EXPECT_DOUBLE_EQ(value_of(canfix_frame(1408, {0, 0, 0, 0xe7, 3})), 0.999);
}

TEST(Canfix, a_height_without_a_datum_is_not_read) {
  BusProfile unknown = profile();
  unknown.canfix_height_is_ellipsoidal = false;
  const BusFrame height = frame_of("40A#02000018FCFFFF");
  EXPECT_EQ(decoded_frame({}, height, unknown).fault, Fault::bus_datum_unknown);
  EXPECT_FALSE(BusProfile{}.canfix_height_is_ellipsoidal);
}

TEST(Canfix, other_frames_are_not_parameters) {
  BusFrame frame = frame_of("180#0200009AFF");
  frame.extended = true;
  EXPECT_EQ(fault_of(frame), Fault::bus_id_unknown);
  EXPECT_EQ(fault_of(frame_of("188#0200000000")), Fault::bus_id_unknown);
  frame = frame_of("180#0200009AFF");
  frame.remote = true;
  EXPECT_EQ(fault_of(frame), Fault::bus_not_data);
  frame.remote = false;
  frame.fd = true;
  EXPECT_EQ(fault_of(frame), Fault::bus_not_classic);
}

TEST(Canfix, quality_and_failure_make_invalid_but_limits_and_marks_do_not) {
  Ownship own;
  own.profile = profile();
  own.feed(canfix_frame(384, {0x10, 0}, 0.0));
  own.feed(canfix_frame(384, {0x00, 0x10}, 10.0, 0x10));
  EXPECT_EQ(own.validity(P::pitch, 11.0), Validity::valid);
  EXPECT_DOUBLE_EQ(own.state[P::pitch].value, 0.16);
  own.feed(canfix_frame(384, {0x10, 0}, 20.0, 0x02));
  EXPECT_EQ(own.validity(P::pitch, 21.0), Validity::invalid);
  own.feed(canfix_frame(384, {0x10, 0}, 30.0));
  own.feed(canfix_frame(384, {0x10, 0}, 40.0, 0x04));
  EXPECT_EQ(own.validity(P::pitch, 41.0), Validity::invalid);
  EXPECT_EQ(own.state.counters.ignored, 1U);
  EXPECT_EQ(own.state.counters.suspect, 1U);
  EXPECT_EQ(own.state.counters.failure_warning, 1U);
}

TEST(Canfix, another_index_is_another_channel_and_another_node_another_source) {
  Ownship own;
  own.profile = profile();
  own.feed(canfix_frame(384, {0x10, 0}, 0.0, 0, 2, 1));
  EXPECT_EQ(own.state[P::pitch].validity, Validity::missing);
  EXPECT_EQ(own.state.counters.other_channel, 1U);
  own.feed(canfix_frame(384, {0x10, 0}, 0.0, 0, 2));
  own.feed(canfix_frame(384, {0x20, 0}, 10.0, 0, 3));
  EXPECT_EQ(own.state.counters.other_source, 1U);
  EXPECT_EQ(own.state[P::pitch].source.node_id, 2);
}

TEST(Canfix, a_magnetic_heading_needs_a_variation_which_may_be_configured) {
  Ownship own;
  own.profile = profile();
  own.feed(canfix_frame(389, {0x84, 0x03}, 0.0));  // 90.0
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::reference_unknown);
  own.profile.fixed_variation_deg = -3.5;
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::valid);
  EXPECT_NEAR(own.pose(1.0).heading_deg.value, 86.5, 1e-9);
}

}  // namespace
}  // namespace ridgeline
