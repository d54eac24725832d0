#include "core/state/ownship_update.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using testing::at_ms;
using testing::float_of;
using testing::half_of;
using testing::long_of;
using testing::Ownship;
using P = BusParameter;

static_assert(std::is_trivially_copyable_v<OwnshipState>);

TEST(OwnshipUpdate, every_value_has_its_own_time_validity_and_source) {
  Ownship own;
  own.feed(float_of(P::roll, 10.0, 0.0, 1));
  own.feed(float_of(P::pitch, 5.0, 50.0, 2));
  EXPECT_EQ(own.state[P::roll].value, 10.0);
  EXPECT_EQ(own.state[P::roll].time_ns, at_ms(0));
  EXPECT_EQ(own.state[P::roll].source.node_id, 1);
  EXPECT_EQ(own.state[P::pitch].time_ns, at_ms(50));
  EXPECT_EQ(own.state[P::pitch].source.node_id, 2);
  EXPECT_EQ(own.state[P::true_heading].validity, Validity::missing);
}

TEST(OwnshipUpdate, each_parameter_goes_stale_alone_however_busy_the_bus_is) {
  // One parameter falls silent; all others, unknown ids, other channels and other nodes keep
  // talking.
  for (const BusIcdRow& silent : bus_icd) {
    if (silent.quantity.field_type == CanasType::char4) continue;
    const bool is_coordinate = silent.quantity.field_type == CanasType::int32;
    if (is_coordinate) continue;  // covered by the position tests: a fix needs both
    Ownship own;
    own.feed(float_of(silent.parameter, 1.0, 0.0));
    const double timeout_ms = static_cast<double>(silent.timeout_ns) * 1e-6;
    for (double t = 20.0; t <= timeout_ms + 40.0; t += 20.0) {
      for (const BusIcdRow& other : bus_icd) {
        if (other.parameter == silent.parameter) continue;
        own.feed(float_of(other.parameter, 1.0, t));
      }
      own.feed(testing::raw_frame(340, CanasType::float32, 0, t));
      BusFrame other_channel = float_of(silent.parameter, 1.0, t);
      other_channel.extended = true;
      other_channel.id += 65536;
      own.feed(other_channel);
      BusFrame remote = float_of(silent.parameter, 1.0, t);
      remote.remote = true;
      own.feed(remote);
      BusFrame short_frame = float_of(silent.parameter, 1.0, t);
      short_frame.length = 7;
      own.feed(short_frame);
      const Validity expected = t <= timeout_ms ? Validity::valid : Validity::stale;
      ASSERT_EQ(own.validity(silent.parameter, t), expected) << silent.name << " at " << t;
    }
  }
}

TEST(OwnshipUpdate, a_latitude_alone_never_moves_the_position_nor_keeps_it_fresh) {
  Ownship own;
  own.feed_fix(46.5, 8.0, 0.0);
  for (int step = 1; step <= 25; ++step) {
    own.feed(long_of(P::gps_latitude, 46.5 + 1e-5 * step, 100.0 * step));
    ASSERT_EQ(own.state[P::gps_latitude].value, 46.5) << step;
  }
  EXPECT_EQ(own.validity(P::gps_latitude, 2500.0), Validity::stale);
  EXPECT_EQ(own.validity(P::gps_longitude, 2500.0), Validity::stale);
  EXPECT_EQ(own.state.counters.unpaired_fixes, 24U);
}

TEST(OwnshipUpdate, coordinates_of_different_fixes_never_make_a_position) {
  // The longitude of the second fix and the latitude of the third are lost.
  Ownship own;
  own.feed_fix(46.5000, 8.0000, 0.0);
  own.feed(long_of(P::gps_latitude, 46.5001, 100.0));
  own.feed(long_of(P::gps_longitude, 8.0002, 201.0));
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.5);
  EXPECT_EQ(own.state[P::gps_longitude].value, 8.0);
  own.feed_fix(46.5003, 8.0003, 300.0);
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.5003);
  EXPECT_EQ(own.state[P::gps_longitude].value, 8.0003);
}

TEST(OwnshipUpdate, longitude_may_come_first) {
  Ownship own;
  own.feed(long_of(P::gps_longitude, 8.0, 0.0));
  own.feed(long_of(P::gps_latitude, 46.5, 1.0));
  EXPECT_EQ(own.state[P::gps_latitude].validity, Validity::valid);
  EXPECT_EQ(own.state[P::gps_longitude].value, 8.0);
}

TEST(OwnshipUpdate, coordinates_of_two_senders_never_make_a_position) {
  Ownship own;
  own.feed(long_of(P::gps_latitude, 46.5, 0.0, 1));
  own.feed(long_of(P::gps_longitude, 8.0, 1.0, 2));
  EXPECT_EQ(own.state[P::gps_latitude].validity, Validity::missing);
}

TEST(OwnshipUpdate, gps_and_ins_coordinates_never_make_a_position_together) {
  Ownship own;
  own.feed(long_of(P::gps_latitude, 46.5, 0.0));
  own.feed(long_of(P::ins_longitude, 8.0, 1.0));
  EXPECT_EQ(own.state[P::gps_latitude].validity, Validity::missing);
  EXPECT_EQ(own.state[P::ins_longitude].validity, Validity::missing);
}

TEST(OwnshipUpdate, double_halves_make_a_position) {
  Ownship own;
  own.feed(half_of(P::gps_latitude, 46.123456789, true, 4, 0.0));
  own.feed(half_of(P::gps_latitude, 46.123456789, false, 5, 0.2));
  own.feed(half_of(P::gps_longitude, 8.987654321, false, 9, 0.4));
  own.feed(half_of(P::gps_longitude, 8.987654321, true, 10, 0.6));
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.123456789);
  EXPECT_EQ(own.state[P::gps_longitude].value, 8.987654321);
}

TEST(OwnshipUpdate, joined_halves_are_range_checked) {
  Ownship own;
  own.feed_fix(46.5, 8.0, 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  own.feed(half_of(P::gps_latitude, nan, true, 4, 100.0));
  own.feed(half_of(P::gps_latitude, nan, false, 5, 100.2));
  EXPECT_EQ(own.validity(P::gps_latitude, 101.0), Validity::invalid);
  EXPECT_EQ(own.validity(P::gps_longitude, 101.0), Validity::invalid);
  EXPECT_EQ(own.state.counters.not_finite, 1U);
}

TEST(OwnshipUpdate, not_a_number_makes_a_value_invalid_at_once_and_the_next_good_one_heals_it) {
  Ownship own;
  own.feed(float_of(P::roll, 1.0, 0.0));
  own.feed(float_of(P::roll, std::numeric_limits<double>::quiet_NaN(), 12.5));
  EXPECT_EQ(own.validity(P::roll, 13.0), Validity::invalid);
  EXPECT_EQ(own.state[P::roll].value, 1.0);
  own.feed(float_of(P::roll, 1.1, 25.0));
  EXPECT_EQ(own.validity(P::roll, 26.0), Validity::valid);
  EXPECT_EQ(own.state.counters.not_finite, 1U);
}

TEST(OwnshipUpdate, a_sender_of_garbage_only_goes_from_invalid_to_stale_when_it_falls_silent) {
  Ownship own;
  own.feed(float_of(P::roll, 1.0, 0.0));
  for (double t = 10.0; t <= 1000.0; t += 10.0) {
    own.feed(float_of(P::roll, std::numeric_limits<double>::infinity(), t));
  }
  EXPECT_EQ(own.validity(P::roll, 1000.0), Validity::invalid);
  EXPECT_EQ(own.validity(P::roll, 1301.0), Validity::stale);
}

TEST(OwnshipUpdate, a_fix_of_zero_zero_is_no_position) {
  Ownship own;
  own.feed_fix(0.0, 0.0, 0.0);
  EXPECT_EQ(own.state[P::gps_latitude].validity, Validity::missing);
  own.feed_fix(46.5, 8.0, 100.0);
  own.feed_fix(0.0, 0.0, 200.0);
  EXPECT_EQ(own.validity(P::gps_latitude, 202.0), Validity::invalid);
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.5);
  own.feed_fix(0.0, 8.0, 300.0);  // the equator itself is a place; here it is a jump
  EXPECT_EQ(own.validity(P::gps_latitude, 302.0), Validity::implausible);
}

struct JumpCase {
  BusParameter parameter;
  double before, possible, impossible;  ///< values 12.5 ms apart
  int persist_count;
};

class Jump : public ::testing::TestWithParam<JumpCase> {};

TEST_P(Jump, single_spike_is_implausible_and_forgotten) {
  const JumpCase c = GetParam();
  Ownship own;
  own.feed(float_of(c.parameter, c.before, 0.0));
  own.feed(float_of(c.parameter, c.impossible, 12.5));
  EXPECT_EQ(own.validity(c.parameter, 13.0), Validity::implausible);
  EXPECT_NEAR(own.state[c.parameter].value, c.before, 1e-3);
  EXPECT_EQ(own.state.counters.implausible, 1U);
  own.feed(float_of(c.parameter, c.before, 25.0));
  EXPECT_EQ(own.validity(c.parameter, 26.0), Validity::valid);
}

TEST_P(Jump, possible_motion_is_taken_at_once) {
  const JumpCase c = GetParam();
  Ownship own;
  own.feed(float_of(c.parameter, c.before, 0.0));
  own.feed(float_of(c.parameter, c.possible, 12.5));
  EXPECT_EQ(own.validity(c.parameter, 13.0), Validity::valid);
  EXPECT_EQ(own.state.counters.implausible, 0U);
}

TEST_P(Jump, is_believed_after_it_persists) {
  const JumpCase c = GetParam();
  Ownship own;
  own.feed(float_of(c.parameter, c.before, 0.0));
  for (int sample = 1; sample < c.persist_count; ++sample) {
    own.feed(float_of(c.parameter, c.impossible, 1.0 * sample));
    ASSERT_EQ(own.validity(c.parameter, 1.0 * sample), Validity::implausible) << sample;
  }
  own.feed(float_of(c.parameter, c.impossible, 1.0 * c.persist_count));
  EXPECT_EQ(own.validity(c.parameter, 1.0 * c.persist_count), Validity::valid);
  EXPECT_EQ(own.state.counters.jumps_believed, 1U);
}

TEST_P(Jump, values_that_disagree_with_each_other_are_never_believed) {
  const JumpCase c = GetParam();
  Ownship own;
  own.feed(float_of(c.parameter, c.before, 0.0));
  const double far = c.before - (c.impossible - c.before);
  for (int sample = 1; sample < 40; ++sample) {
    own.feed(float_of(c.parameter, sample % 2 == 0 ? c.impossible : far, 0.2 * sample));
    ASSERT_NE(own.validity(c.parameter, 0.2 * sample), Validity::valid) << sample;
  }
}

INSTANTIATE_TEST_SUITE_P(Parameters, Jump,
                         ::testing::Values(JumpCase{P::roll, 0.0, 15.0, 40.0, 10},
                                           JumpCase{P::pitch, 0.0, 11.0, 30.0, 10},
                                           JumpCase{P::true_heading, 170.0, 183.0, 215.0, 10},
                                           JumpCase{P::heading, -5.0, 5.0, 60.0, 10},
                                           JumpCase{P::magnetic_heading, 0.0, 12.0, 90.0, 10},
                                           JumpCase{P::gps_height, 1000.0, 1040.0, 1200.0, 5},
                                           JumpCase{P::ins_height, 1000.0, 1040.0, 1200.0, 5}));

TEST(OwnshipUpdate, an_impossible_move_is_refused_until_it_persists) {
  Ownship own;
  own.feed_fix(46.5, 8.0, 0.0);
  for (int fix = 1; fix <= 4; ++fix) {
    own.feed_fix(46.6, 8.0, 100.0 * fix);
    ASSERT_EQ(own.validity(P::gps_latitude, 100.0 * fix + 1.0), Validity::implausible);
    ASSERT_EQ(own.state[P::gps_latitude].value, 46.5);
  }
  own.feed_fix(46.6, 8.0, 500.0);
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.6);
  EXPECT_EQ(own.state[P::gps_latitude].validity, Validity::valid);
  EXPECT_EQ(own.state.counters.implausible, 4U);
}

TEST(OwnshipUpdate, flight_at_300_mps_across_the_date_line_is_plausible) {
  Ownship own;
  for (int fix = 0; fix < 20; ++fix) {
    const double longitude = 179.997 + fix * 30.0 / 111320.0;
    own.feed_fix(0.5, longitude > 180.0 ? longitude - 360.0 : longitude, 100.0 * fix);
    ASSERT_EQ(own.state[P::gps_longitude].validity, Validity::valid) << fix;
  }
  EXPECT_LT(own.state[P::gps_longitude].value, -179.0);
}

TEST(OwnshipUpdate, after_a_long_gap_the_first_fix_is_believed) {
  Ownship own;
  own.feed_fix(46.5, 8.0, 0.0);
  own.feed_fix(46.52, 8.0, 60000.0);
  EXPECT_EQ(own.state[P::gps_latitude].value, 46.52);
}

TEST(OwnshipUpdate, roll_may_flip_near_the_vertical) {
  Ownship own;
  own.feed(float_of(P::pitch, 88.0, 0.0));
  own.feed(float_of(P::roll, 2.0, 0.0));
  own.feed(float_of(P::roll, -178.0, 12.5));
  EXPECT_EQ(own.validity(P::roll, 13.0), Validity::valid);
}

TEST(OwnshipUpdate, a_second_sender_is_heard_only_when_the_first_is_stale) {
  Ownship own;
  own.feed(float_of(P::roll, 1.0, 0.0, 1));
  own.feed(float_of(P::roll, 2.0, 100.0, 2));
  EXPECT_EQ(own.state[P::roll].value, 1.0);
  EXPECT_EQ(own.state.counters.other_source, 1U);
  own.feed(float_of(P::roll, 2.0, 301.0, 2));
  EXPECT_EQ(own.state[P::roll].value, 2.0);
  EXPECT_EQ(own.state[P::roll].source.node_id, 2);
  EXPECT_EQ(own.state.counters.source_changes, 1U);
}

TEST(OwnshipUpdate, a_duplicate_on_a_second_interface_is_dropped) {
  Ownship own;
  BusFrame frame = float_of(P::roll, 1.0, 0.0);
  own.feed(frame);
  frame.interface = 1;
  own.feed(frame);
  EXPECT_EQ(own.state.counters.decoded, 1U);
  EXPECT_EQ(own.state.counters.other_source, 1U);
}

TEST(OwnshipUpdate, redundancy_channels_are_not_mixed) {
  Ownship own;
  BusFrame frame = float_of(P::roll, 30.0, 0.0);
  frame.extended = true;
  frame.id += 65536;
  own.feed(frame);
  EXPECT_EQ(own.state[P::roll].validity, Validity::missing);
  EXPECT_EQ(own.state.counters.other_channel, 1U);
  own.profile.channel = 1;
  own.feed(frame);
  EXPECT_EQ(own.state[P::roll].value, 30.0);
  EXPECT_EQ(own.state[P::roll].source.channel, 1);
}

TEST(OwnshipUpdate, older_and_future_frames_are_refused) {
  Ownship own;
  own.feed(float_of(P::roll, 1.0, 100.0));
  own.feed({float_of(P::roll, 2.0, 50.0)}, 110.0);
  EXPECT_EQ(own.state[P::roll].value, 1.0);
  EXPECT_EQ(own.state.counters.out_of_order, 1U);
  own.feed({float_of(P::roll, 3.0, 200.0)}, 120.0);
  EXPECT_EQ(own.state[P::roll].value, 1.0);
  EXPECT_EQ(own.state.counters.from_future, 1U);
}

TEST(OwnshipUpdate, a_clock_that_creeps_back_is_one_that_goes_back) {
  Ownship own;
  own.feed(float_of(P::roll, 1.0, 10000.0));
  own.feed({}, 9985.0);
  EXPECT_EQ(own.state.counters.clock_resets, 0U);  // it may stand a little back
  EXPECT_EQ(own.state[P::roll].validity, Validity::valid);
  own.feed({}, 9970.0);
  EXPECT_EQ(own.state.counters.clock_resets, 1U);
  EXPECT_EQ(own.state[P::roll].validity, Validity::missing);
}

TEST(OwnshipUpdate, a_clock_that_goes_back_forgets_everything_but_the_counters) {
  Ownship own;
  own.feed(float_of(P::roll, 1.0, 10000.0));
  own.feed({}, 5000.0);
  EXPECT_EQ(own.state[P::roll].validity, Validity::missing);
  EXPECT_EQ(own.state.counters.clock_resets, 1U);
  EXPECT_EQ(own.state.counters.decoded, 1U);
}

TEST(OwnshipUpdate, every_frame_is_counted_exactly_once) {
  Ownship own;
  std::uint32_t fed = 0;
  std::uint32_t random = 12345;
  const auto next = [&random] { return random = random * 1664525U + 1013904223U; };
  for (int step = 0; step < 20000; ++step) {
    const BusIcdRow& row = bus_icd[(next() >> 16) % bus_icd.size()];
    BusFrame frame = testing::raw_frame(
        row.id, static_cast<CanasType>((next() >> 16) % 40), next(), step * 0.7 - (next() >> 28),
        static_cast<std::uint8_t>(next() >> 24), static_cast<std::uint8_t>(next() >> 31));
    if ((next() >> 24) < 5) frame.remote = true;
    if ((next() >> 24) < 5) frame.id += 1;
    if ((next() >> 24) < 5) frame.length = 6;
    own.feed({frame}, step * 0.7);
    ++fed;
  }
  const UpdateCounters& c = own.state.counters;
  EXPECT_EQ(c.frames, fed);
  EXPECT_EQ(c.decoded + c.ignored + c.not_data + c.other_channel + c.other_source + c.bad_length +
                c.type_mismatch + c.out_of_range + c.not_finite + c.implausible + c.out_of_order +
                c.from_future,
            fed);
  EXPECT_GT(c.decoded, 0U);
  EXPECT_GT(c.type_mismatch, 0U);
}

}  // namespace
}  // namespace ridgeline
