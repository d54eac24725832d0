#include "tests/fine_tiles/straight_flight.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "core/state/ownship_pose.hpp"
#include "core/state/ownship_update.hpp"
#include "sim/log/candump_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::fine {
namespace {

using test::TemporaryFolder;

struct Spot {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double track_deg = 0;
};

Spot spot_after(const FlightPlan& plan, double distance_m) {
  Spot spot;
  GeographicLib::Geodesic::WGS84().Direct(plan.latitude_deg, plan.longitude_deg, plan.heading_deg,
                                          distance_m, spot.latitude_deg, spot.longitude_deg,
                                          spot.track_deg);
  return spot;
}

double distance_m(double latitude_deg, double longitude_deg, const Spot& spot) {
  double result_m = 0;
  GeographicLib::Geodesic::WGS84().Inverse(latitude_deg, longitude_deg, spot.latitude_deg,
                                           spot.longitude_deg, result_m);
  return result_m;
}

double degrees_between(double a_deg, double b_deg) {
  return std::fabs(std::remainder(a_deg - b_deg, 360.0));
}

/// The log of a plan as the display reads it.
class ReplayedLog {
 public:
  explicit ReplayedLog(const FlightPlan& plan) {
    const TemporaryFolder folder;
    const std::string text = flight_log(plan);
    test::write_bytes(folder.file("flight.log"), std::as_bytes(std::span(text)));
    Result<CandumpLog> read = candump_log(folder.file("flight.log"));
    RL_ASSERT(read.ok());
    log_ = std::move(read).value();
  }

  [[nodiscard]] const CandumpLog& log() const { return log_; }
  [[nodiscard]] const OwnshipState& state() const { return state_; }

  /// Asked in ascending order of time.
  OwnshipPose pose_at(double time_s) {
    const std::int64_t now_ns =
        log_.frames.front().time_ns + static_cast<std::int64_t>(std::llround(time_s * 1e9));
    while (next_ < log_.frames.size() && log_.frames[next_].time_ns <= now_ns) {
      const BusFrame& frame = log_.frames[next_++];
      state_ = update_ownship(state_, {&frame, 1}, frame.time_ns, profile_);
    }
    return ownship_pose(state_, now_ns, state_limits(profile_));
  }

 private:
  BusProfile profile_;
  CandumpLog log_;
  OwnshipState state_;
  std::size_t next_ = 0;
};

void expect_valid(const OwnshipPose& pose) {
  for (const PoseValue* value : {&pose.latitude_deg, &pose.longitude_deg, &pose.height_m,
                                 &pose.roll_deg, &pose.pitch_deg, &pose.heading_deg}) {
    EXPECT_EQ(value->validity, Validity::valid);
  }
}

FlightPlan plan_at_sea_level() {
  FlightPlan plan;
  plan.latitude_deg = 36.25;
  plan.longitude_deg = -4.5;
  plan.heading_deg = 52;
  plan.speed_mps = 250;
  plan.duration_s = 600;
  return plan;
}

TEST(StraightFlight, follows_the_geodesic) {
  FlightPlan plan = plan_at_sea_level();
  plan.duration_s = 3600;
  const std::vector<sim::FlightSample> flight = straight_flight(plan);
  ASSERT_EQ(flight.size(), 3600U * 80 + 1);
  for (const std::size_t tick : {0U, 80U, 48'000U, 288'000U}) {
    const sim::FlightSample& sample = flight[tick];
    EXPECT_EQ(sample.time_s, static_cast<double>(tick) / 80);
    const Spot spot = spot_after(plan, 250 * sample.time_s);
    EXPECT_LT(distance_m(sample.latitude_deg, sample.longitude_deg, spot), 1e-3) << tick;
    EXPECT_LT(degrees_between(sample.heading_deg, spot.track_deg), 1e-7);
  }
}

TEST(StraightFlight, pose_of_the_replayed_log_is_where_it_should_be) {
  FlightPlan plan = plan_at_sea_level();
  ReplayedLog log(plan);
  EXPECT_EQ(log.log().statistics.bad_lines, 0U);
  ASSERT_EQ(log.log().notes.labels.size(), 1U);
  EXPECT_THAT(log.log().notes.labels[0], testing::StartsWith("SYNTHETIC flight"));
  for (double time_s = 1.03; time_s < 600; time_s += 33.3) {
    const OwnshipPose pose = log.pose_at(time_s);
    expect_valid(pose);
    const Spot spot = spot_after(plan, 250 * time_s);
    // The frames of one tick follow each other within 1.5 ms: 0.4 m.
    EXPECT_LT(distance_m(pose.latitude_deg.value, pose.longitude_deg.value, spot), 0.5);
    EXPECT_NEAR(pose.height_m.value, 0, 1e-6);
    EXPECT_LT(degrees_between(pose.heading_deg.value, spot.track_deg), 1e-3);
    EXPECT_NEAR(pose.roll_deg.value, 0, 1e-6);
  }
  EXPECT_EQ(log.state().counters.implausible, 0U);
  EXPECT_EQ(log.state().counters.decoded, log.state().counters.frames);
}

TEST(StraightFlight, speed_is_that_at_the_height_of_the_flight) {
  FlightPlan plan = plan_at_sea_level();
  plan.latitude_deg = 0;
  plan.heading_deg = 90;  // the equator is a circle
  plan.height_m = 3000;
  const sim::FlightSample end = straight_flight(plan).back();
  const double shrink = 6378137.0 / 6381137.0;
  EXPECT_LT(distance_m(end.latitude_deg, end.longitude_deg, spot_after(plan, 150e3 * shrink)),
            1e-2);
  EXPECT_EQ(end.height_m, 3000);
}

TEST(StraightFlight, goes_on_across_the_pole_and_the_antimeridian) {
  FlightPlan plan = plan_at_sea_level();
  plan.latitude_deg = 89.9;
  plan.longitude_deg = 20;
  plan.heading_deg = 0;
  plan.duration_s = 100;
  const sim::FlightSample end = straight_flight(plan).back();
  EXPECT_LT(distance_m(end.latitude_deg, end.longitude_deg, spot_after(plan, 25e3)), 1e-3);
  EXPECT_NEAR(end.longitude_deg, -160, 1e-6);
  EXPECT_LT(degrees_between(end.heading_deg, 180), 1e-6);
  plan.latitude_deg = -17;
  plan.longitude_deg = 179.9;
  plan.heading_deg = 90;
  EXPECT_NEAR(straight_flight(plan).back().longitude_deg, -179.865, 0.01);
}

TEST(StraightFlight, a_jump_is_believed_and_ends_where_it_should) {
  FlightPlan plan = plan_at_sea_level();
  plan.duration_s = 60;
  plan.jump = Jump{30, 500e3};
  ReplayedLog log(plan);
  const auto off_m = [&](double time_s, double extra_m) {
    const OwnshipPose pose = log.pose_at(time_s);
    return distance_m(pose.latitude_deg.value, pose.longitude_deg.value,
                      spot_after(plan, 250 * time_s + extra_m));
  };
  EXPECT_LT(off_m(29.9, 0), 0.5);
  // For some seconds the speed is not believed: the last fix, 0.1 s old, is not carried on.
  EXPECT_LT(off_m(32, 500e3), 25.5);
  EXPECT_LT(off_m(59, 500e3), 0.5);
  EXPECT_EQ(log.state().counters.jumps_believed, 1U);
  EXPECT_LT(degrees_between(log.pose_at(59.5).heading_deg.value,
                            spot_after(plan, 250 * 59.5 + 500e3).track_deg),
            1e-3);
}

TEST(StraightFlight, a_turn_has_the_bank_and_the_rate_of_a_coordinated_one) {
  FlightPlan plan = plan_at_sea_level();
  plan.latitude_deg = 0;  // no convergence of meridians worth naming
  plan.heading_deg = 350;
  plan.duration_s = 120;
  plan.turn = Turn{20, -30, 63};
  ReplayedLog log(plan);
  EXPECT_LT(degrees_between(log.pose_at(19.9).heading_deg.value, 350), 1e-3);
  EXPECT_NEAR(log.pose_at(21.5).roll_deg.value, -15, 0.3);  // half of the roll-in
  EXPECT_NEAR(log.pose_at(50).roll_deg.value, -30, 1e-4);
  const double rate_dps = -9.80665 * std::tan(30 * 0.017453292519943295) / 250 * 57.29577951308232;
  const double before_deg = log.pose_at(55).heading_deg.value;
  EXPECT_LT(degrees_between(log.pose_at(65).heading_deg.value, before_deg + 10 * rate_dps), 0.05);
  const OwnshipPose after = log.pose_at(90);
  EXPECT_NEAR(after.roll_deg.value, 0, 1e-6);
  // 57 s at full bank and twice 3 s of rolling; the mean of tan over a ramp to 30 degrees is
  // -ln(cos 30) / (30 in radians).
  const double ramp = 6 * 0.14384103622589042 / 0.5235987755982988 / std::tan(0.5235987755982988);
  EXPECT_LT(degrees_between(after.heading_deg.value, 350 + rate_dps * (57 + ramp)), 0.1);
  expect_valid(after);
  EXPECT_EQ(log.state().counters.implausible, 0U);
}

TEST(StraightFlight, plans_outside_the_domain_are_refused) {
  const FlightPlan good = plan_at_sea_level();
  EXPECT_EQ(wrong_with(good), "");
  const auto wrong = [&](auto change) {
    FlightPlan plan = good;
    change(plan);
    return wrong_with(plan);
  };
  EXPECT_NE(wrong([](FlightPlan& p) { p.latitude_deg = 90.1; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.longitude_deg = std::nan(""); }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.heading_deg = 361; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.speed_mps = 0; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.height_m = 30e3; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.duration_s = 1e6; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.jump = Jump{601, 1}; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.jump = Jump{6, INFINITY}; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.turn = Turn{590, 30, 20}; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.turn = Turn{10, 0, 20}; }), "");
  EXPECT_NE(wrong([](FlightPlan& p) { p.turn = Turn{10, 80, 20}; }), "");
}

}  // namespace
}  // namespace ridgeline::fine
