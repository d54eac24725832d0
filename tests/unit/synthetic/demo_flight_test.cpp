#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/synthetic/scripted_flight.hpp"
#include "sim/synthetic/synthetic_terrain.hpp"
#include "tests/unit/synthetic/demo_fixture.hpp"

namespace ridgeline::test {
namespace {

const std::vector<sim::FlightSample>& flight() {
  static const std::vector<sim::FlightSample> samples =
      sim::scripted_flight(sim::synthetic_height_m);
  return samples;
}

double distance_m(double latitude_a, double longitude_a, double latitude_b, double longitude_b) {
  return std::hypot((latitude_a - latitude_b) * 111'198.7, (longitude_a - longitude_b) * 74'003.1);
}

double wrapped_deg(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

TEST(DemoFlight, has_one_sample_a_tick) {
  ASSERT_EQ(flight().size(), 90U * 80 + 1);
  EXPECT_EQ(flight().back().time_s, 90);
}

TEST(DemoFlight, never_comes_closer_than_60_m_to_the_ground_of_the_tiles) {
  double nearest_m = 1e9;
  for (const sim::FlightSample& sample : flight()) {
    const double ground_m = Demo::instance().ground_m(sample.latitude_deg, sample.longitude_deg);
    ASSERT_FALSE(std::isnan(ground_m)) << sample.time_s;
    nearest_m = std::min(nearest_m, sample.height_m - ground_m);
  }
  EXPECT_GE(nearest_m, sim::flight_clearance_m);
  EXPECT_LT(nearest_m, 150) << "the flight should be seen to follow the valley";
}

TEST(DemoFlight, keeps_clear_of_any_ground_by_construction) {
  // A comb of needles: the guarantee is the method's, not that of the one demo.
  const auto needles_m = [](double latitude_deg, double longitude_deg) {
    return std::fmod(std::fabs(latitude_deg * 977 + longitude_deg * 1231), 1.0) > 0.8 ? 2500.0
                                                                                      : 0.0;
  };
  for (const sim::FlightSample& sample : sim::scripted_flight(needles_m)) {
    ASSERT_GE(sample.height_m,
              needles_m(sample.latitude_deg, sample.longitude_deg) + sim::flight_clearance_m);
  }
}

TEST(DemoFlight, starts_near_the_airfield_crosses_a_ridge_and_ends_over_the_sea) {
  const sim::FlightSample& first = flight().front();
  EXPECT_LT(distance_m(first.latitude_deg, first.longitude_deg,
                       sim::synthetic_airfield.latitude_deg, sim::synthetic_airfield.longitude_deg),
            2500);
  double over_airfield_m = 1e9;
  double ridge_m = 0;
  for (const sim::FlightSample& sample : flight()) {
    over_airfield_m =
        std::min(over_airfield_m, distance_m(sample.latitude_deg, sample.longitude_deg,
                                             sim::synthetic_airfield.latitude_deg,
                                             sim::synthetic_airfield.longitude_deg));
    ridge_m =
        std::max(ridge_m, Demo::instance().ground_m(sample.latitude_deg, sample.longitude_deg));
  }
  EXPECT_LT(over_airfield_m, 400);
  EXPECT_GT(ridge_m, 300);
  const sim::FlightSample& last = flight().back();
  EXPECT_EQ(Demo::instance().ground_m(last.latitude_deg, last.longitude_deg), 0);
}

TEST(DemoFlight, moves_smoothly_at_its_ground_speed) {
  for (std::size_t k = 1; k < flight().size(); ++k) {
    const sim::FlightSample& before = flight()[k - 1];
    const sim::FlightSample& now = flight()[k];
    const double moved_m =
        distance_m(before.latitude_deg, before.longitude_deg, now.latitude_deg, now.longitude_deg);
    ASSERT_NEAR(moved_m * 80, now.ground_speed_mps, 0.5) << now.time_s;
    ASSERT_LT(std::fabs(now.roll_deg - before.roll_deg) * 80, 15) << "roll rate at " << now.time_s;
    ASSERT_LT(std::fabs(now.pitch_deg - before.pitch_deg) * 80, 8)
        << "pitch rate at " << now.time_s;
    ASSERT_NEAR((now.height_m - before.height_m) * 80, 0.5 * (now.climb_mps + before.climb_mps),
                0.5);
  }
}

TEST(DemoFlight, turns_are_coordinated_and_bank_to_both_sides) {
  double most_right_deg = 0;
  double most_left_deg = 0;
  for (std::size_t k = 1; k < flight().size(); ++k) {
    const sim::FlightSample& now = flight()[k];
    const double turn_radps =
        wrapped_deg(now.track_deg - flight()[k - 1].track_deg) * 80 * 0.017453292519943295;
    const double coordinated_deg =
        std::atan(now.ground_speed_mps * turn_radps / 9.80665) * 57.29577951308232;
    ASSERT_NEAR(now.roll_deg, coordinated_deg, 1.5) << now.time_s;  // the chop is up to 1.2 degrees
    most_right_deg = std::max(most_right_deg, now.roll_deg);
    most_left_deg = std::min(most_left_deg, now.roll_deg);
  }
  EXPECT_GT(most_right_deg, 34);
  EXPECT_LT(most_right_deg, 41);
  EXPECT_LT(most_left_deg, -20);
}

TEST(DemoFlight, climbs_and_descends_within_reach_of_an_aeroplane) {
  const auto [lowest, highest] =
      std::minmax_element(flight().begin(), flight().end(),
                          [](const auto& a, const auto& b) { return a.climb_mps < b.climb_mps; });
  EXPECT_GT(highest->climb_mps, 10);
  EXPECT_LT(highest->climb_mps, 35);
  EXPECT_GT(lowest->climb_mps, -35);
}

TEST(DemoFlight, heading_differs_from_track_by_a_steady_wind) {
  for (const sim::FlightSample& sample : flight()) {
    EXPECT_LT(std::fabs(wrapped_deg(sample.heading_deg - sample.track_deg)), 4);
  }
}

}  // namespace
}  // namespace ridgeline::test
