#include "core/bus/double_pairs.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/bus/frames.hpp"

namespace ridgeline {
namespace {

using testing::frame_of;
using testing::half_of;

constexpr BusParameter longitude = BusParameter::gps_longitude;

/// Feeds halves one after the other.
struct Stream {
  DoublePairs pairs;
  BusProfile profile;
  std::vector<double> values;
  int unpaired = 0;

  void feed(const BusFrame& frame) {
    const Result<DecodedValue> decoded = decode_canaerospace(frame, profile);
    ASSERT_TRUE(decoded.ok());
    const DoublePairStep step = paired_double(pairs, decoded.value(), frame, profile);
    pairs = step.next;
    if (step.value) values.push_back(*step.value);
    if (step.unpaired) ++unpaired;
  }
};

TEST(DoublePairs, published_vector_joins) {
  Stream stream;
  stream.feed(frame_of("40D#011E0007401FF115"));
  stream.feed(frame_of("40D#011F00081611BA3D"));
  ASSERT_EQ(stream.values.size(), 1U);
  EXPECT_NEAR(stream.values[0], 7.985432, 1e-15);
}

TEST(DoublePairs, lower_half_first_joins_as_well) {
  Stream stream;
  stream.feed(half_of(longitude, 7.985432, false, 7, 0.0));
  stream.feed(half_of(longitude, 7.985432, true, 8, 1.0));
  EXPECT_EQ(stream.values, std::vector<double>{7.985432});
}

TEST(DoublePairs, message_code_wraps_from_255_to_0) {
  Stream stream;
  stream.feed(half_of(longitude, 8.0, true, 255, 0.0));
  stream.feed(half_of(longitude, 8.0, false, 0, 1.0));
  EXPECT_EQ(stream.values.size(), 1U);
}

TEST(DoublePairs, codes_that_are_not_adjacent_never_pair) {
  for (const int code : {7, 9, 6, 200}) {
    Stream stream;
    stream.feed(half_of(longitude, 8.0, true, 7, 0.0));
    stream.feed(half_of(longitude, 8.0, false, static_cast<std::uint8_t>(code), 1.0));
    EXPECT_TRUE(stream.values.empty()) << code;
    EXPECT_EQ(stream.unpaired, 1) << code;
  }
}

TEST(DoublePairs, halves_of_different_fixes_never_pair_after_a_lost_frame) {
  // The upper half of the second fix (code 12) is lost: 13 and 14 are adjacent, complementary, and
  // wrong.
  for (const double interval_ms : {100.0, 5.0}) {
    Stream stream;
    const std::vector<double> fixes = {7.1, 7.2, 7.3, 7.4};
    std::uint8_t code = 10;
    for (std::size_t fix = 0; fix < fixes.size(); ++fix) {
      const double time_ms = static_cast<double>(fix) * interval_ms;
      if (fix != 1) stream.feed(half_of(longitude, fixes[fix], true, code, time_ms));
      stream.feed(half_of(longitude, fixes[fix], false, static_cast<std::uint8_t>(code + 1),
                          time_ms + 1.0));
      code = static_cast<std::uint8_t>(code + 2);
    }
    EXPECT_EQ(stream.values, (std::vector<double>{7.1, 7.3, 7.4})) << interval_ms;
    EXPECT_EQ(stream.unpaired, 1) << interval_ms;
  }
}

TEST(DoublePairs, joining_a_running_bus_in_mid_fix_does_not_lock_on_the_wrong_halves) {
  Stream stream;
  std::uint8_t code = 11;
  stream.feed(half_of(longitude, 7.0, false, code++, 1.0));
  for (int fix = 1; fix < 6; ++fix) {
    stream.feed(half_of(longitude, 7.0 + fix, true, code++, 100.0 * fix));
    stream.feed(half_of(longitude, 7.0 + fix, false, code++, 100.0 * fix + 1.0));
  }
  EXPECT_EQ(stream.values, (std::vector<double>{8.0, 9.0, 10.0, 11.0, 12.0}));
}

TEST(DoublePairs, a_configured_order_holds_against_the_traffic) {
  Stream stream;
  stream.profile.double_order = DoubleOrder::high_first;
  for (std::uint8_t code = 0; code < 40; code = static_cast<std::uint8_t>(code + 2)) {
    stream.feed(half_of(longitude, 8.0, false, code, code));
    stream.feed(half_of(longitude, 8.5, true, static_cast<std::uint8_t>(code + 1), code + 0.5));
    for (const double value : stream.values) EXPECT_NE(value, 8.0);
  }
}

TEST(DoublePairs, a_sender_that_changes_its_order_is_learned_anew) {
  Stream stream;
  stream.feed(half_of(longitude, 8.0, true, 0, 0.0));
  stream.feed(half_of(longitude, 8.0, false, 1, 1.0));
  for (int fix = 1; fix < 10; ++fix) {
    const auto code = static_cast<std::uint8_t>(2 * fix);
    stream.feed(half_of(longitude, 8.0 + fix, false, code, 100.0 * fix));
    stream.feed(half_of(longitude, 8.0 + fix, true, static_cast<std::uint8_t>(code + 1),
                        100.0 * fix + 1.0));
  }
  ASSERT_FALSE(stream.values.empty());
  EXPECT_EQ(stream.values.back(), 17.0);
  EXPECT_GE(stream.values.size(), 6U);
}

TEST(DoublePairs, halves_of_two_senders_or_interfaces_never_pair) {
  Stream nodes;
  nodes.feed(half_of(longitude, 8.0, true, 7, 0.0, 1));
  nodes.feed(half_of(longitude, 8.0, false, 8, 1.0, 2));
  EXPECT_TRUE(nodes.values.empty());
  Stream interfaces;
  interfaces.feed(half_of(longitude, 8.0, true, 7, 0.0));
  BusFrame other = half_of(longitude, 8.0, false, 8, 1.0);
  other.interface = 1;
  interfaces.feed(other);
  EXPECT_TRUE(interfaces.values.empty());
}

TEST(DoublePairs, halves_too_far_apart_in_time_never_pair) {
  Stream stream;
  stream.feed(half_of(longitude, 8.0, true, 7, 0.0));
  stream.feed(half_of(longitude, 8.0, false, 8, 21.0));
  EXPECT_TRUE(stream.values.empty());
}

}  // namespace
}  // namespace ridgeline
