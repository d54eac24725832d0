// One integrity fault each: its rule, its word, how long it lasts, and what it must not do.
#include "core/state/integrity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/state/simulated_flight.hpp"

namespace ridgeline {
namespace {

using testing::at_ms;
using testing::Equipment;
using testing::float_of;
using testing::Ownship;
using testing::SimulatedFlight;
using testing::Truth;
using P = BusParameter;

void fly(SimulatedFlight& flight, double seconds) {
  const double until_s = flight.truth().time_s + seconds;
  while (flight.truth().time_s < until_s - 1e-9) flight.step();
}

double say_for(SimulatedFlight& flight, const std::string& word, double at_most_s) {
  const double start_s = flight.truth().time_s;
  while (flight.says(word) && flight.truth().time_s - start_s < at_most_s) flight.step();
  return flight.truth().time_s - start_s;
}

BusFrame on_second_bus(BusFrame frame) {
  frame.interface = 1;
  return frame;
}

TEST(Rivals, nodes_channels_and_buses_are_each_compared) {
  // The same node number on another interface, another node, another channel: three ways of being
  // a second source of roll.
  for (int kind = 0; kind < 3; ++kind) {
    Ownship own;
    own.profile.channel_count = 2;
    for (double t = 0.0; t < 1000.0; t += 20.0) {
      own.feed(float_of(P::roll, 5.0, t, 1));
      BusFrame other = float_of(P::roll, 20.0, t + 1.0, kind == 0 ? 2 : 1);
      if (kind == 1) other = on_second_bus(other);
      if (kind == 2) {
        other.extended = true;
        other.id += 65536;
      }
      own.feed(other);
    }
    EXPECT_EQ(own.validity(P::roll, 1000.0), Validity::disagrees) << kind;
    EXPECT_EQ(own.state.counters.disagreements, 1U) << kind;
    EXPECT_EQ(own.state[P::roll].value, 5.0) << "a rival never becomes the value";
    EXPECT_EQ(own.state.counters.other_source, 50U);
  }
}

TEST(Rivals, a_contradiction_shorter_than_an_attitude_may_age_is_none) {
  Ownship own;
  for (double t = 0.0; t < 1000.0; t += 20.0) {
    own.feed(float_of(P::roll, 5.0, t, 1));
    own.feed(float_of(P::roll, t > 500.0 && t < 780.0 ? 25.0 : 5.0, t + 1.0, 2));
    ASSERT_EQ(own.validity(P::roll, t + 1.0), Validity::valid) << t;
  }
}

TEST(Rivals, keep_nothing_alive) {
  Ownship own;
  own.feed(float_of(P::roll, 5.0, 0.0, 1));
  for (double t = 1.0; t <= 299.0; t += 20.0) own.feed(float_of(P::roll, 5.0, t, 2));
  EXPECT_EQ(own.state[P::roll].time_ns, at_ms(0.0));
  EXPECT_EQ(own.validity(P::roll, 300.0), Validity::valid);
  EXPECT_EQ(own.validity(P::roll, 301.0), Validity::stale);
  own.feed(float_of(P::roll, 5.5, 302.0, 2));
  EXPECT_EQ(own.validity(P::roll, 302.0), Validity::valid) << "then it takes over";
  EXPECT_EQ(own.state.counters.source_changes, 1U);
}

TEST(Rivals, one_that_says_it_has_failed_contradicts_nobody) {
  Ownship own;
  for (double t = 0.0; t < 1000.0; t += 20.0) {
    own.feed(float_of(P::pitch, 5.0, t, 1));
    own.feed(float_of(P::pitch, 20.0, t + 1.0, 2));
  }
  ASSERT_EQ(own.validity(P::pitch, 1000.0), Validity::disagrees);
  own.feed(float_of(P::pitch, std::numeric_limits<double>::quiet_NaN(), 1001.0, 2));
  EXPECT_EQ(own.validity(P::pitch, 1001.0), Validity::valid);
}

TEST(Rivals, a_contradiction_outlives_a_source_that_falls_silent_by_ten_seconds) {
  Ownship own;
  for (double t = 0.0; t < 1000.0; t += 20.0) {
    own.feed(float_of(P::pitch, 5.0, t, 1));
    own.feed(float_of(P::pitch, 20.0, t + 1.0, 2));
  }
  for (double t = 1000.0; t < 12000.0; t += 20.0) {
    own.feed(float_of(P::pitch, 5.0, t, 1));
    const Validity expected = t <= 10981.0 ? Validity::disagrees : Validity::valid;
    ASSERT_EQ(own.validity(P::pitch, t), expected) << t;
  }
}

TEST(Rivals, two_against_one_outvote_it_and_it_is_told) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SimulatedFlight flight(seed, {.attitude_nodes = 3, .gps_nodes = 3});
    fly(flight, 10.0);
    ASSERT_TRUE(flight.words().empty());
    flight.falsify(1, [](Truth& t) { t.roll_deg += 30.0; });
    // A jump is refused at once; later it is believed, contradicted, and outvoted.
    double removed_s = 0.0;
    for (int tick = 0; tick < 250; ++tick) {
      flight.step();
      const bool removed = flight.says("attitude_implausible") || flight.says("attitude_disagrees");
      removed_s += removed ? 0.02 : 0.0;
    }
    EXPECT_GT(flight.own().state.counters.outvoted, 0U) << seed;
    EXPECT_NE(flight.own().state[P::roll].source.node_id, 1) << seed;
    EXPECT_TRUE(flight.says("source_excluded")) << seed;
    EXPECT_FALSE(flight.says("attitude_disagrees")) << seed;
    EXPECT_LT(removed_s, 0.7) << seed;
  }
}

TEST(Rivals, a_receiver_outvoted_by_two_leaves_without_a_jump_of_the_watches) {
  SimulatedFlight flight(3, {.gps_nodes = 3});
  fly(flight, 10.0);
  const Truth start = flight.truth();
  flight.falsify(
      1, [start](Truth& t) { t.latitude_deg += 30.0 * (t.time_s - start.time_s) / 111195.0; });
  fly(flight, 20.0);
  EXPECT_NE(flight.own().state[P::gps_latitude].source.node_id, 1);
  EXPECT_EQ(flight.own().validity(P::gps_latitude, flight.now_ms() + 19.0), Validity::valid);
  EXPECT_NEAR(flight.own().state[P::gps_latitude].value, flight.truth().latitude_deg, 1e-4);
  EXPECT_TRUE(flight.says("source_excluded"));
}

TEST(Selection, a_frozen_receiver_gives_way_to_the_ins_and_comes_back) {
  SimulatedFlight flight(5, {.ins = true});
  fly(flight, 10.0);
  const Truth start = flight.truth();
  flight.falsify(1, [start](Truth& t) {
    t.latitude_deg = start.latitude_deg;
    t.longitude_deg = start.longitude_deg;
  });
  fly(flight, 3.0);
  EXPECT_TRUE(flight.says("position_from_ins"));
  EXPECT_FALSE(flight.says("position_frozen"));
  fly(flight, 17.0);
  EXPECT_TRUE(flight.says("position_from_ins")) << "it leaves the frozen one behind, rightly";
  EXPECT_FALSE(flight.says("position_disagrees"));
  flight.falsify(1, nullptr);
  fly(flight, 40.0);
  EXPECT_TRUE(flight.words().empty()) << flight.words()[0];
}

TEST(Selection, a_climb_that_height_and_barometer_contradict_carries_nothing_on) {
  SimulatedFlight flight(6, {.barometer = true});
  fly(flight, 10.0);
  const Truth start = flight.truth();
  flight.falsify(1, [start](Truth& t) { t.climb_mps += 3.0 * (t.time_s - start.time_s); });
  double largest_m = 0.0;
  bool told = false;
  for (int tick = 0; tick < 500; ++tick) {
    flight.step();
    ASSERT_FALSE(flight.says("height_disagrees")) << tick;
    told = flight.says("velocity_doubted");
    if (!told) {
      const OwnshipPose pose = flight.own().pose(flight.now_ms() + 19.0);
      largest_m = std::max(largest_m, std::abs(pose.height_m.value - flight.truth().height_m));
    }
  }
  EXPECT_TRUE(told);
  EXPECT_LT(largest_m, 6.0);
}

TEST(Selection, of_three_headings_the_odd_one_out_is_left) {
  Ownship own;
  own.profile.heading_reference = HeadingReference::true_north;
  for (double t = 0.0; t < 2000.0; t += 20.0) {
    own.feed(float_of(P::true_heading, 80.0, t));
    own.feed(float_of(P::heading, 40.0, t));
    own.feed(float_of(P::magnetic_variation, 2.0, t));
    own.feed(float_of(P::magnetic_heading, 39.0, t));
  }
  EXPECT_EQ(own.validity(P::true_heading, 2000.0), Validity::disagrees);
  const OwnshipPose pose = own.pose(2000.0);
  EXPECT_EQ(pose.heading_source, HeadingSource::heading);
  EXPECT_EQ(pose.heading_deg.value, 40.0);
  EXPECT_TRUE(pose.source_excluded);
}

TEST(Jump, that_is_believed_is_told_for_ten_seconds) {
  Ownship own;
  double t = 0.0;
  for (; t < 1000.0; t += 100.0) own.feed(float_of(P::gps_height, 1000.0, t));
  for (; own.state.counters.jumps_believed == 0U; t += 100.0) {
    own.feed(float_of(P::gps_height, 1300.0, t));
    ASSERT_LT(t, 2000.0);
  }
  const double believed_ms = t - 100.0;
  EXPECT_TRUE(own.pose(believed_ms + 10000.0).events.jump_believed);
  EXPECT_FALSE(own.pose(believed_ms + 10001.0).events.jump_believed);
}

TEST(Jump, of_a_sole_receiver_keeps_the_picture_away_while_the_altitude_rate_denies_it) {
  SimulatedFlight flight(8, {});
  fly(flight, 10.0);
  flight.falsify(1, [](Truth& t) { t.height_m += 300.0; });
  fly(flight, 0.3);
  EXPECT_TRUE(flight.says("height_implausible"));
  fly(flight, 2.0);
  EXPECT_TRUE(flight.says("jump_believed"));
  EXPECT_TRUE(flight.says("height_disagrees"));
  EXPECT_LT(say_for(flight, "height_disagrees", 100.0), 60.0) << "but not for ever";
}

TEST(Replay, frames_that_were_there_before_are_refused_and_told) {
  SimulatedFlight flight(1, {});
  std::vector<BusFrame> kept;
  for (int tick = 0; tick < 500; ++tick) {
    flight.step();
    if (tick >= 480) {
      kept.insert(kept.end(), flight.last_frames().begin(), flight.last_frames().end());
    }
  }
  ASSERT_TRUE(flight.words().empty());
  Ownship& own = flight.own();
  const OwnshipState before = own.state;
  for (BusFrame& frame : kept) {
    frame.time_ns = before.now_ns;  // received now, but old
    own.feed(frame);
  }
  EXPECT_TRUE(flight.says("frames_replayed"));
  EXPECT_EQ(own.state.counters.replay_bursts, 1U);
  // Attitude was replayed by 20 frames, more than the 8 after which a sender counts anew: what is
  // believed then is told, and what was replayed by fewer is refused to the last.
  EXPECT_GE(own.state.counters.replayed + own.state.counters.duplicated, 8U * 3U);
  EXPECT_EQ(own.state[P::gps_height].value, before[P::gps_height].value);
  EXPECT_EQ(own.state[P::gps_height].time_ns, before[P::gps_height].time_ns);
}

TEST(Replay, a_frame_that_can_itself_delivered_twice_is_counted_and_not_told) {
  SimulatedFlight flight(1, {});
  fly(flight, 5.0);
  BusFrame again = flight.last_frames()[0];
  flight.own().feed(again);
  EXPECT_EQ(flight.own().state.counters.duplicated, 1U);
  EXPECT_TRUE(flight.words().empty());
}

TEST(Replay, frames_in_the_wrong_order_are_refused_and_told) {
  SimulatedFlight flight(2, {});
  fly(flight, 5.0);
  // Every two ticks change places, as a gateway with two queues does it.
  for (int pair = 0; pair < 10; ++pair) {
    const std::vector<BusFrame> first = flight.make_frames();
    const std::vector<BusFrame> second = flight.make_frames();
    std::vector<BusFrame> turned = second;
    turned.insert(turned.end(), first.begin(), first.end());
    flight.own().feed(turned, flight.now_ms() + 19.0);
  }
  const UpdateCounters& c = flight.own().state.counters;
  EXPECT_GE(c.out_of_order, 30U);
  EXPECT_TRUE(flight.says("frames_replayed"));
  EXPECT_LT(say_for(flight, "frames_replayed", 10.0), 2.1) << "over two seconds after the last";
}

TEST(Replay, a_sender_that_was_switched_off_and_on_is_heard_within_eight_frames) {
  Ownship own;
  std::uint8_t code = 60;
  const auto frame = [&](double t) {
    return testing::raw_frame(icd_row(P::roll).id, CanasType::float32, 0x41000000, t, code++);
  };
  double t = 0.0;
  for (; t < 400.0; t += 20.0) own.feed(frame(t));
  code = 0;
  for (int k = 0; k < 8; ++k, t += 20.0) own.feed(frame(t));
  EXPECT_EQ(own.state[P::roll].time_ns, at_ms(t - 20.0));
  EXPECT_EQ(own.validity(P::roll, t), Validity::valid);
}

TEST(Replay, senders_that_do_not_count_are_never_judged) {
  Ownship own;
  for (double t = 0.0; t < 3000.0; t += 20.0) own.feed(float_of(P::roll, t * 0.001, t));
  EXPECT_EQ(own.state.counters.duplicated, 0U);
  EXPECT_EQ(own.state[P::roll].time_ns, at_ms(2980.0));
}

TEST(Clock, that_steps_against_utc_is_told_within_a_second) {
  for (const double step_s : {-3600.0, -4.0, 4.0, 3600.0}) {
    SimulatedFlight flight(4, {});
    fly(flight, 10.0);
    ASSERT_TRUE(flight.words().empty());
    flight.utc_ahead_s = step_s;
    fly(flight, 1.02);
    EXPECT_TRUE(flight.says("clock_stepped")) << step_s;
    EXPECT_EQ(flight.own().state.counters.clock_steps, 1U) << step_s;
    fly(flight, 6.1);
    EXPECT_TRUE(flight.words().empty()) << step_s;
  }
}

TEST(Clock, of_reception_that_goes_back_is_told_and_everything_forgotten) {
  SimulatedFlight flight(4, {});
  fly(flight, 10.0);
  Ownship& own = flight.own();
  own.feed({}, flight.now_ms() - 5000.0);
  const Availability said =
      availability(own.state, at_ms(flight.now_ms() - 5000.0), state_limits(own.profile));
  std::vector<Reason> reasons(said.reasons.begin(), said.reasons.end());
  EXPECT_EQ(std::count(reasons.begin(), reasons.end(), Reason::clock_stepped), 1);
  EXPECT_EQ(said.mode, Mode::removed);
  EXPECT_EQ(own.state.counters.clock_resets, 1U);
}

TEST(Clock, crossing_midnight_is_no_step) {
  SimulatedFlight flight(4, {});
  flight.utc_ahead_s = 6390.0;  // 86390 s of the day at the start
  fly(flight, 30.0);
  EXPECT_TRUE(flight.words().empty());
}

TEST(Gap, in_the_message_codes_is_counted_and_harmless) {
  SimulatedFlight flight(9, {});
  fly(flight, 5.0);
  for (int tick = 0; tick < 5; ++tick) flight.make_frames();  // lost
  fly(flight, 1.0);
  EXPECT_EQ(flight.own().state.counters.lost_in_sequence, 5U * 3U + 6U);
  EXPECT_TRUE(flight.words().empty());
}

}  // namespace
}  // namespace ridgeline
