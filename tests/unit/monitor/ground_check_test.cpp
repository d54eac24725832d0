#include "core/monitor/ground_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/monitor/availability.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t tick_ns = 100'000'000;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

PoseValue radio(double height_m, Validity validity = Validity::valid) {
  return {height_m, 0, validity};
}

/// Ticks of 0.1 s until it contradicts; -1 when it does not within 10 s.
int ticks_until_contradiction(const PoseValue& said, double over_ground_m) {
  GroundCheck check;
  for (int tick = 0; tick < 100; ++tick) {
    check = ground_check(check, said, over_ground_m, tick * tick_ns);
    if (check.contradiction.raised) return tick;
  }
  return -1;
}

TEST(GroundCheck, a_radio_height_that_fits_says_nothing) {
  EXPECT_EQ(ticks_until_contradiction(radio(300.0), 300.0), -1);
  EXPECT_EQ(ticks_until_contradiction(radio(230.0), 300.0), -1) << "trees";
  EXPECT_EQ(ticks_until_contradiction(radio(390.0), 300.0), -1) << "rough terrain data";
}

TEST(GroundCheck, a_radio_height_that_does_not_fit_contradicts_after_two_seconds) {
  EXPECT_EQ(ticks_until_contradiction(radio(0.0), 300.0), 20);
  EXPECT_EQ(ticks_until_contradiction(radio(500.0), 300.0), 20);
}

TEST(GroundCheck, beyond_its_range_it_only_says_that_the_ground_is_not_near) {
  EXPECT_EQ(ticks_until_contradiction(radio(762.0), 3000.0), -1) << "it stands at its end stop";
  EXPECT_EQ(ticks_until_contradiction(radio(762.0), 700.0), -1);
  EXPECT_EQ(ticks_until_contradiction(radio(762.0), 200.0), 20);
  EXPECT_EQ(ticks_until_contradiction(radio(100.0), 3000.0), 20);
}

TEST(GroundCheck, without_both_there_is_nothing_to_compare) {
  EXPECT_EQ(ticks_until_contradiction(radio(0.0), none), -1);
  for (const Validity validity : {Validity::missing, Validity::stale, Validity::invalid}) {
    EXPECT_EQ(ticks_until_contradiction(radio(0.0, validity), 300.0), -1);
  }
}

TEST(GroundCheck, a_tower_that_passes_by_is_no_contradiction) {
  GroundCheck check;
  for (int tick = 0; tick < 100; ++tick) {
    const bool over_it = tick >= 30 && tick < 48;
    check = ground_check(check, radio(over_it ? 100.0 : 300.0), 300.0, tick * tick_ns);
    ASSERT_FALSE(check.contradiction.raised) << tick;
  }
}

TEST(GroundCheck, its_word_degrades_and_ends_two_seconds_after_they_agree) {
  GroundCheck check;
  std::int64_t now_ns = 0;
  for (; !check.contradiction.raised; now_ns += tick_ns) {
    check = ground_check(check, radio(0.0), 300.0, now_ns);
  }
  const Availability said = availability(OwnshipPose{}, check);
  bool told = false;
  for (const Reason reason : said.reasons) told |= reason == Reason::radio_height_disagrees;
  EXPECT_TRUE(told);
  EXPECT_EQ(reason_mode(Reason::radio_height_disagrees), Mode::degraded);
  for (int tick = 0; tick < 20; ++tick, now_ns += tick_ns) {
    check = ground_check(check, radio(300.0), 300.0, now_ns);
    ASSERT_TRUE(check.contradiction.raised) << tick;
  }
  check = ground_check(check, radio(300.0), 300.0, now_ns);
  EXPECT_FALSE(check.contradiction.raised);
  EXPECT_EQ(check.disagreements, 1U);
}

}  // namespace
}  // namespace ridgeline
