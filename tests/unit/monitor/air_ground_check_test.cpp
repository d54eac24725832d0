#include "core/monitor/air_ground_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "config/limits_bus.hpp"
#include "core/monitor/availability.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t tick_ns = 100'000'000;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

AirGroundFacts facts(AirGround said, double speed_mps, double over_ground_m) {
  return {said, {speed_mps, 0, Validity::valid}, over_ground_m, false};
}

/// Ticks of 0.1 s until it contradicts; -1 when it does not within a minute.
int ticks_until_contradiction(const AirGroundFacts& said) {
  AirGroundCheck check;
  for (int tick = 0; tick < 600; ++tick) {
    check = air_ground_check(check, said, tick * tick_ns);
    if (check.contradiction.raised) return tick;
  }
  return -1;
}

TEST(AirGroundCheck, on_ground_in_flight_contradicts_after_two_seconds) {
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::ground, 60, 300)), 20);
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::air, 60, 300)), -1);
}

TEST(AirGroundCheck, in_the_air_while_standing_contradicts_after_half_a_minute) {
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::air, 0.2, 3)), 300);
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::air, 0.2, -20)), 300)
      << "parked below the drawn ground, which is good to 30 m";
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::ground, 0.2, 3)), -1);
}

/// Speed and height must agree against the switch: one of them alone may be what is wrong.
TEST(AirGroundCheck, neither_speed_nor_height_alone_contradicts) {
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::ground, 80, 20)), -1) << "a take-off run";
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::ground, 8, 300)), -1) << "on a roof";
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::air, 40, 5)), -1) << "over the threshold";
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::air, 1, 400)), -1) << "into the wind";
}

TEST(AirGroundCheck, a_helicopter_hovers_and_says_air) {
  AirGroundFacts hovering = facts(AirGround::air, 0.2, 3);
  hovering.can_hover = true;
  EXPECT_EQ(ticks_until_contradiction(hovering), -1);
  hovering = facts(AirGround::ground, 60, 300);
  hovering.can_hover = true;
  EXPECT_EQ(ticks_until_contradiction(hovering), 20) << "but does not fly on its wheels";
}

TEST(AirGroundCheck, without_switch_speed_or_ground_there_is_nothing_to_compare) {
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::unknown, 60, 300)), -1);
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::unknown, 0, 3)), -1);
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::ground, 60, none)), -1);
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::air, 0, none)), -1);
  EXPECT_EQ(ticks_until_contradiction(facts(AirGround::ground, none, 300)), -1);
  for (const Validity validity : {Validity::missing, Validity::stale, Validity::implausible}) {
    AirGroundFacts said = facts(AirGround::ground, 60, 300);
    said.ground_speed_mps.validity = validity;
    EXPECT_EQ(ticks_until_contradiction(said), -1);
    said = facts(AirGround::air, 0, 3);
    said.ground_speed_mps.validity = validity;
    EXPECT_EQ(ticks_until_contradiction(said), -1);
  }
}

/// From standing to climbing away, with the switch as it should be, and half a second late.
TEST(AirGroundCheck, a_take_off_and_a_landing_are_no_contradiction) {
  AirGroundCheck check;
  double speed_mps = 0, over_m = 2;
  for (int tick = 0; tick < 1200; ++tick) {
    const bool rolling = tick > 350;
    const bool airborne = tick > 550;
    if (rolling && speed_mps < 70) speed_mps += 0.3;
    if (airborne && tick < 900) over_m += 1.5;  // 15 m/s, a steep climb
    const AirGround said = tick > 555 ? AirGround::air : AirGround::ground;
    check = air_ground_check(check, facts(said, speed_mps, over_m), tick * tick_ns);
    ASSERT_FALSE(check.contradiction.raised) << tick;
  }
  for (int tick = 1200; tick < 2400; ++tick) {
    if (over_m > 2) over_m -= 1.0;
    if (over_m <= 2 && speed_mps > 0.1) speed_mps = std::max(0.1, speed_mps - 0.4);
    const AirGround said = over_m <= 2 ? AirGround::ground : AirGround::air;
    check = air_ground_check(check, facts(said, speed_mps, over_m), tick * tick_ns);
    ASSERT_FALSE(check.contradiction.raised) << tick;
  }
  EXPECT_EQ(check.disagreements, 0U);
}

TEST(AirGroundCheck, its_word_degrades_and_ends_two_seconds_after_they_agree) {
  AirGroundCheck check;
  std::int64_t now_ns = 0;
  for (; !check.contradiction.raised; now_ns += tick_ns) {
    check = air_ground_check(check, facts(AirGround::ground, 60, 300), now_ns);
  }
  const Availability said = availability(OwnshipPose{}, GroundCheck{}, check);
  const auto told = said.reasons.view();
  EXPECT_NE(std::find(told.begin(), told.end(), Reason::air_ground_disagrees), told.end());
  EXPECT_EQ(reason_mode(Reason::air_ground_disagrees), Mode::degraded) << "no picture is removed";
  for (int tick = 0; tick < 20; ++tick, now_ns += tick_ns) {
    check = air_ground_check(check, facts(AirGround::air, 60, 300), now_ns);
    ASSERT_TRUE(check.contradiction.raised) << tick;
  }
  check = air_ground_check(check, facts(AirGround::air, 60, 300), now_ns);
  EXPECT_FALSE(check.contradiction.raised);
  EXPECT_EQ(check.disagreements, 1U);
}

}  // namespace
}  // namespace ridgeline
