// CANaerospace beyond single values: redundancy channels, identification, time stamps.
#include "core/bus/canas_services.hpp"

#include <gtest/gtest.h>

#include "tests/unit/bus/frames.hpp"
#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using P = BusParameter;
using testing::float_of;
using testing::frame_of;
using testing::half_of;
using testing::Ownship;

constexpr CanasIdentity display{7, 2, 3};

TEST(CanasServices, an_identification_request_is_answered_on_the_next_identifier) {
  BusFrame request = frame_of("080#07000042", 12.0);
  request.interface = 1;
  const std::optional<BusFrame> reply = ids_reply(request, display);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->id, 129U);
  EXPECT_FALSE(reply->extended);
  EXPECT_EQ(reply->length, 8);
  EXPECT_EQ(reply->interface, 1);
  EXPECT_EQ(reply->time_ns, request.time_ns);
  const std::array<std::uint8_t, 8> expected{7, 16, 0, 0x42, 2, 3, 0, 0};
  for (std::size_t byte = 0; byte < 8; ++byte) EXPECT_EQ(reply->data[byte], expected[byte]);
  EXPECT_FALSE(ids_reply(*reply, display)) << "an answer is no request";
}

TEST(CanasServices, a_broadcast_is_answered_with_the_own_number) {
  const std::optional<BusFrame> reply = ids_reply(frame_of("080#00000001"), display);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->data[0], 7);
}

TEST(CanasServices, nothing_else_is_answered) {
  for (const char* other : {
           "080#08000000",          // another node
           "080#07100000",          // not NODATA
           "080#07000100",          // another service
           "080#0700000000000000",  // data where none belong
           "080#070000",            // too short
           "081#07000000",          // an answer
           "082#07000000",          // channel 1
           "137#07000000",          // a parameter
           "00010080#07000000",     // 29 bits
           "080#R",
           "080##007000000",
           "20000080#07000000",
       }) {
    EXPECT_FALSE(ids_reply(frame_of(other), display)) << other;
  }
}

TEST(CanasServices, a_time_stamp_is_read_on_every_request_channel) {
  for (int channel = 0; channel < 36; ++channel) {
    BusFrame frame = frame_of("080#00040105DEADBEEF");
    frame.id = static_cast<std::uint32_t>(128 + 2 * channel);
    EXPECT_EQ(nss_time_stamp(frame).value(), 0xdeadbeefU);
    ++frame.id;
    EXPECT_EQ(nss_time_stamp(frame).fault(), Fault::bus_id_unknown);
  }
  EXPECT_EQ(nss_time_stamp(frame_of("7D0#0004010500000001")).value(), 1U);
  EXPECT_EQ(nss_time_stamp(frame_of("7EE#0004010500000001")).value(), 1U);
  EXPECT_EQ(nss_time_stamp(frame_of("7F0#0004010500000001")).fault(), Fault::bus_id_unknown);
  EXPECT_EQ(nss_time_stamp(frame_of("0C8#0004010500000001")).fault(), Fault::bus_id_unknown);
  EXPECT_EQ(nss_time_stamp(frame_of("00010080#0004010500000001")).fault(), Fault::bus_id_unknown);
}

TEST(CanasServices, a_time_stamp_of_another_form_is_a_fault) {
  EXPECT_EQ(nss_time_stamp(frame_of("080#00030105DEADBEEF")).fault(), Fault::bus_type_mismatch);
  EXPECT_EQ(nss_time_stamp(frame_of("080#00040005DEADBEEF")).fault(), Fault::bus_id_unknown);
  EXPECT_EQ(nss_time_stamp(frame_of("080#00040105DEADBE")).fault(), Fault::bus_length);
  EXPECT_EQ(nss_time_stamp(frame_of("080#00")).fault(), Fault::bus_length);
  EXPECT_EQ(nss_time_stamp(frame_of("080#R8")).fault(), Fault::bus_not_data);
  EXPECT_EQ(nss_time_stamp(frame_of("080##000040105DEADBEEF")).fault(), Fault::bus_not_classic);
}

BusFrame on_identifier(BusFrame frame, std::uint32_t id) {
  frame.id = id;
  frame.extended = id > 0x7ff;
  return frame;
}

TEST(CanasChannels, several_channels_are_sources_of_one_parameter) {
  Ownship own;
  own.profile.channel_count = 3;
  const std::uint32_t roll = icd_row(P::roll).id;
  own.feed(on_identifier(float_of(P::roll, 1.0, 0.0), roll));
  own.feed(on_identifier(float_of(P::roll, 2.0, 10.0), roll + 2 * 65536));
  EXPECT_EQ(own.state[P::roll].value, 1.0);
  EXPECT_EQ(own.state.counters.other_source, 1U);
  own.feed(on_identifier(float_of(P::roll, 2.0, 310.0), roll + 2 * 65536));
  EXPECT_EQ(own.state[P::roll].value, 2.0);
  EXPECT_EQ(own.state[P::roll].source.channel, 2);
  own.feed(on_identifier(float_of(P::roll, 3.0, 320.0), roll + 3 * 65536));
  EXPECT_EQ(own.state.counters.other_channel, 1U);
}

TEST(CanasChannels, offsets_may_be_configured) {
  Ownship own;
  own.profile.channel_offsets = {{0, 0x20000, 0x1800}, 3};
  ASSERT_TRUE(offsets_are_distinct(own.profile.channel_offsets));
  own.profile.channel = 1;
  own.profile.channel_count = 2;
  const std::uint32_t roll = icd_row(P::roll).id;
  own.feed(on_identifier(float_of(P::roll, 1.0, 0.0), roll));
  EXPECT_EQ(own.state.counters.other_channel, 1U);
  own.feed(on_identifier(float_of(P::roll, 1.0, 0.0), roll + 65536));
  EXPECT_EQ(own.state.counters.ignored, 1U) << "the standard's offset is not configured";
  own.feed(on_identifier(float_of(P::roll, 4.0, 0.0), roll + 0x1800));
  EXPECT_EQ(own.state[P::roll].value, 4.0);
  EXPECT_EQ(own.state[P::roll].source.channel, 2);
  own.feed(on_identifier(float_of(P::pitch, 5.0, 0.0), icd_row(P::pitch).id + 0x20000));
  EXPECT_EQ(own.state[P::pitch].source.channel, 1);
}

TEST(CanasChannels, halves_are_joined_on_a_configured_channel) {
  Ownship own;
  own.profile.channel_offsets = {{0x4000}, 1};
  const auto moved = [](const BusFrame& frame) { return on_identifier(frame, frame.id + 0x4000); };
  own.feed(moved(half_of(P::gps_latitude, 46.123456789, true, 1, 0.0)));
  own.feed(moved(half_of(P::gps_latitude, 46.123456789, false, 2, 1.0)));
  own.feed(moved(half_of(P::gps_longitude, 7.985432, true, 3, 2.0)));
  own.feed(moved(half_of(P::gps_longitude, 7.985432, false, 4, 3.0)));
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.123456789);
  EXPECT_EQ(own.state[P::gps_longitude].value, 7.985432);
}

TEST(CanasChannels, offsets_that_let_channels_overlap_are_no_offsets) {
  EXPECT_TRUE(offsets_are_distinct({{0, 2048, 65536, 0x1ffff800}, 4}));
  EXPECT_FALSE(offsets_are_distinct({{0, 2047}, 2}));
  EXPECT_FALSE(offsets_are_distinct({{65536, 65536}, 2}));
  EXPECT_FALSE(offsets_are_distinct({{0x1ffff801}, 1}));
  EXPECT_FALSE(offsets_are_distinct({{0}, 5}));
}

}  // namespace
}  // namespace ridgeline
