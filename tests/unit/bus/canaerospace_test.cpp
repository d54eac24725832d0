#include "core/bus/canaerospace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/bus/frames.hpp"

namespace ridgeline {
namespace {

using testing::frame_of;
using testing::raw_frame;

BusProfile strict_profile() {
  return {};
}
BusProfile field_profile() {
  BusProfile profile;
  profile.header_rule = HeaderRule::field;
  return profile;
}

double value_of(std::string_view text, const BusProfile& profile) {
  const Result<DecodedValue> decoded = decode_canaerospace(frame_of(text), profile);
  return decoded ? decoded.value().value : std::numeric_limits<double>::quiet_NaN();
}

Fault fault_of(const BusFrame& frame, const BusProfile& profile) {
  return decode_canaerospace(frame, profile).fault();
}

TEST(Canaerospace, published_vectors_decode_to_their_values) {
  EXPECT_EQ(value_of("137#0102002A40F00000", strict_profile()), 7.5);
  EXPECT_EQ(value_of("138#0102002AC1F00000", strict_profile()), -30.0);
  EXPECT_NEAR(value_of("40C#0103000A1BB75640", strict_profile()), 46.5, 1e-12);
}

TEST(Canaerospace, short2_scales_by_its_second_half) {
  // The specification's example: 0x4000 of a full scale of 1500, printed there as 750.
  EXPECT_NEAR(value_of("40E#7C0C004A400005DC", strict_profile()), 750.0 * 32768 / 32767, 1e-9);
  EXPECT_EQ(value_of("138#010C000080010064", strict_profile()), -100.0);
  EXPECT_EQ(fault_of(frame_of("138#010C000040000000"), strict_profile()),
            Fault::bus_value_out_of_range);
}

TEST(Canaerospace, zero_header_is_a_type_mismatch_unless_the_profile_is_field) {
  const BusFrame airspeed = frame_of("13B#0000000041200000");
  EXPECT_EQ(fault_of(airspeed, strict_profile()), Fault::bus_type_mismatch);
  EXPECT_EQ(value_of("13B#0000000041200000", field_profile()), 10.0);
  EXPECT_NEAR(value_of("40C#000000001BB75640", field_profile()), 46.5, 1e-12);
  EXPECT_NEAR(value_of("40D#00000000E448A9C0", field_profile()), -46.5, 1e-12);
}

TEST(Canaerospace, field_profile_still_believes_a_type_that_is_given) {
  EXPECT_EQ(value_of("137#0102002A40F00000", field_profile()), 7.5);
  EXPECT_EQ(fault_of(frame_of("137#0103002A40F00000"), field_profile()), Fault::bus_type_mismatch);
}

TEST(Canaerospace, length_must_fit_the_type) {
  EXPECT_EQ(fault_of(frame_of("137#0102002A40F000"), strict_profile()), Fault::bus_length);
  EXPECT_EQ(fault_of(frame_of("137#010200"), strict_profile()), Fault::bus_length);
  EXPECT_EQ(fault_of(frame_of("137#"), field_profile()), Fault::bus_length);
  EXPECT_EQ(fault_of(frame_of("137#0106002A40F00000"), strict_profile()), Fault::bus_length);
  EXPECT_EQ(fault_of(frame_of("137#0106002A40F0"), strict_profile()), Fault::bus_type_mismatch);
  EXPECT_EQ(fault_of(frame_of("137#0100002A"), field_profile()), Fault::bus_type_mismatch);
}

TEST(Canaerospace, reserved_types_are_refused_and_user_types_have_any_length) {
  for (int type = 32; type < 100; ++type) {
    const BusFrame frame = raw_frame(340, static_cast<CanasType>(type), 0, 0.0);
    EXPECT_EQ(canas_message(frame, HeaderRule::strict).fault(), Fault::bus_type_reserved) << type;
  }
  BusFrame user = raw_frame(340, static_cast<CanasType>(100), 0xdeadbeef, 0.0);
  for (std::uint8_t length = 4; length <= 8; ++length) {
    user.length = length;
    ASSERT_TRUE(canas_message(user, HeaderRule::strict).ok()) << int{length};
    EXPECT_EQ(canas_message(user, HeaderRule::strict).value().data_count, length - 4);
  }
  user.length = 9;
  EXPECT_EQ(canas_message(user, HeaderRule::strict).fault(), Fault::bus_length);
}

TEST(Canaerospace, data_bytes_are_big_endian_and_kept_as_sent) {
  const Result<CanasMessage> four =
      canas_message(frame_of("155#01040005DEADBEEF"), HeaderRule::strict);
  ASSERT_TRUE(four.ok());
  EXPECT_EQ(four.value().data, (std::array<std::uint8_t, 4>{0xde, 0xad, 0xbe, 0xef}));
  const Result<CanasMessage> two = canas_message(frame_of("154#0113005F8302"), HeaderRule::strict);
  ASSERT_TRUE(two.ok());
  EXPECT_EQ(two.value().id, 340);
  EXPECT_EQ(two.value().node_id, 1);
  EXPECT_EQ(two.value().message_code, 0x5f);
  EXPECT_EQ(two.value().data_count, 2);
}

TEST(Canaerospace, redundancy_channels_are_told_apart_by_the_29_bit_identifier) {
  const BusFrame channel_1 = frame_of("00010130#0102000041200000");
  const Result<DecodedValue> decoded = decode_canaerospace(channel_1, strict_profile());
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(decoded.value().parameter, BusParameter::roll_rate);
  EXPECT_EQ(decoded.value().message.channel, 1);
  // Channel 0 exists only as an 11-bit frame; 0x10000137 has a base far above the identifiers.
  EXPECT_EQ(fault_of(frame_of("00000137#0102000041200000"), strict_profile()),
            Fault::bus_id_unknown);
  EXPECT_EQ(fault_of(frame_of("1000F137#0102000041200000"), strict_profile()),
            Fault::bus_id_unknown);
}

TEST(Canaerospace, error_remote_and_fd_frames_are_not_data) {
  BusFrame frame = frame_of("137#0102002A40F00000");
  frame.error = true;
  EXPECT_EQ(fault_of(frame, field_profile()), Fault::bus_not_data);
  frame.error = false;
  frame.remote = true;
  EXPECT_EQ(fault_of(frame, field_profile()), Fault::bus_not_data);
  frame.remote = false;
  frame.fd = true;
  EXPECT_EQ(fault_of(frame, field_profile()), Fault::bus_not_classic);
}

TEST(Canaerospace, short2_positions_are_refused_by_name) {
  for (const char* id : {"40C", "40D", "419", "41A"}) {
    EXPECT_EQ(fault_of(frame_of(std::string(id) + "#010C0000211100B4"), strict_profile()),
              Fault::bus_resolution)
        << id;
  }
}

TEST(Canaerospace, values_that_are_no_numbers_or_out_of_range_are_refused) {
  EXPECT_EQ(fault_of(frame_of("137#010200007FC00000"), strict_profile()),
            Fault::bus_value_not_finite);
  EXPECT_EQ(fault_of(frame_of("137#01020000FF800000"), strict_profile()),
            Fault::bus_value_not_finite);
  // Pitch 120, latitude 91 and a roll of 1e30 mean nothing.
  EXPECT_EQ(fault_of(testing::float_of(BusParameter::pitch, 120.0, 0), strict_profile()),
            Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(testing::float_of(BusParameter::gps_latitude, 91.0, 0), strict_profile()),
            Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(testing::float_of(BusParameter::roll, 1e30, 0), strict_profile()),
            Fault::bus_value_out_of_range);
}

TEST(Canaerospace, angles_are_wrapped_on_input) {
  const auto wrapped = [](BusParameter parameter, double angle) {
    const auto decoded = decode_canaerospace(testing::float_of(parameter, angle, 0), {});
    return decoded ? decoded.value().value : std::nan("");
  };
  EXPECT_EQ(wrapped(BusParameter::true_heading, 270.0), -90.0);
  EXPECT_EQ(wrapped(BusParameter::true_heading, 180.0), -180.0);
  EXPECT_EQ(wrapped(BusParameter::roll, -190.0), 170.0);
  EXPECT_EQ(wrapped(BusParameter::pitch, 350.0), -10.0);
  EXPECT_EQ(wrapped(BusParameter::gps_longitude, 190.0), -170.0);
}

TEST(Canaerospace, clock_and_date_are_decimal_bytes) {
  EXPECT_EQ(value_of("4B0#010F00000D2B1600", strict_profile()), 13 * 3600 + 43 * 60 + 22);
  EXPECT_EQ(value_of("4B6#010F00000C061357", strict_profile()), 6371.0);  // 12 June 1987
  EXPECT_EQ(value_of("4B6#010F000001011346", strict_profile()), 0.0);     // 1 January 1970
  EXPECT_EQ(fault_of(frame_of("4B0#010F000018000000"), strict_profile()),
            Fault::bus_value_out_of_range);
  EXPECT_EQ(fault_of(frame_of("4B6#010F00001F041357"), strict_profile()),
            Fault::bus_value_out_of_range);  // 31 April
}

TEST(Canaerospace, every_row_decodes_by_its_own_identifier) {
  for (const BusIcdRow& row : bus_icd) {
    const bool is_clock = row.quantity.field_type == CanasType::char4;
    const BusFrame frame = is_clock ? raw_frame(row.id, CanasType::char4, 0x01011401, 0)
                                    : testing::float_of(row.parameter, 1.0, 0);
    const Result<DecodedValue> decoded = decode_canaerospace(frame, {});
    ASSERT_TRUE(decoded.ok()) << row.name;
    EXPECT_EQ(decoded.value().parameter, row.parameter) << row.name;
  }
}

TEST(Canaerospace, every_length_type_and_identifier_is_answered) {
  // Nothing an interface can deliver may crash the decoder or make it invent a number.
  for (const HeaderRule rule : {HeaderRule::strict, HeaderRule::field}) {
    BusProfile profile;
    profile.header_rule = rule;
    for (std::uint32_t id = 0; id < 2048; ++id) {
      for (int type = 0; type < 256; ++type) {
        BusFrame frame = raw_frame(static_cast<std::uint16_t>(id), static_cast<CanasType>(type),
                                   0x7f9d1234U + id, 0.0);
        frame.length = static_cast<std::uint8_t>((id + static_cast<std::uint32_t>(type)) % 12);
        const Result<DecodedValue> decoded = decode_canaerospace(frame, profile);
        if (decoded) {
          ASSERT_TRUE(std::isfinite(decoded.value().value)) << id << ' ' << type;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline
