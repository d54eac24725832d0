#include "core/state/ownship_pose.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>

#include "tests/unit/state/ownship_fixture.hpp"

namespace ridgeline {
namespace {

using testing::float_of;
using testing::long_of;
using testing::Ownship;
using P = BusParameter;

Ownship flying(double speed_mps, double track_deg) {
  Ownship own;
  own.feed(float_of(P::gps_ground_speed, speed_mps, 0.0));
  own.feed(float_of(P::gps_true_track, track_deg, 0.0));
  own.feed(float_of(P::gps_height, 2000.0, 0.0));
  own.feed(float_of(P::altitude_rate, 5.0, 0.0));
  own.feed_fix(46.5, 8.0, 0.0);
  return own;
}

TEST(OwnshipPose, carries_the_position_on_by_speed_and_track) {
  for (const double track_deg : {0.0, 45.0, 137.0, -90.0, 179.0}) {
    const Ownship own = flying(250.0, track_deg);
    const OwnshipPose pose = own.pose(900.0);
    double latitude = 0.0;
    double longitude = 0.0;
    const double at_2000_m = 6378137.0 / (6378137.0 + 2000.0);
    GeographicLib::Geodesic::WGS84().Direct(46.5, 8.0, track_deg, 225.0 * at_2000_m, latitude,
                                            longitude);
    double error_m = 0.0;
    GeographicLib::Geodesic::WGS84().Inverse(latitude, longitude, pose.latitude_deg.value,
                                             pose.longitude_deg.value, error_m);
    EXPECT_LT(error_m, 0.01) << track_deg;
    EXPECT_NEAR(pose.height_m.value, 2004.5, 1e-6);
    EXPECT_EQ(pose.extrapolated_ns, 900 * testing::ms);
    EXPECT_EQ(pose.position_source, PositionSource::gps);
  }
}

TEST(OwnshipPose, stops_carrying_on_at_the_limit_and_is_stale_at_the_timeout) {
  Ownship own = flying(100.0, 0.0);
  own.feed(float_of(P::gps_ground_speed, 100.0, 1900.0));
  own.feed(float_of(P::gps_true_track, 0.0, 1900.0));
  EXPECT_EQ(own.pose(1990.0).latitude_deg.value, own.pose(1001.0).latitude_deg.value);
  EXPECT_EQ(own.pose(1990.0).extrapolated_ns, limits::extrapolation_limit_ns);
  EXPECT_EQ(own.pose(1990.0).latitude_deg.validity, Validity::valid);
  const OwnshipPose late = own.pose(2002.0);
  EXPECT_EQ(late.latitude_deg.validity, Validity::stale);
  EXPECT_EQ(late.height_m.validity, Validity::stale);
  EXPECT_EQ(late.extrapolated_ns, 0);
  EXPECT_EQ(late.latitude_deg.value, 46.5);
}

TEST(OwnshipPose, a_stale_velocity_does_not_move_the_position) {
  Ownship own = flying(100.0, 90.0);
  own.feed_fix(46.5, 8.001, 1500.0);
  const OwnshipPose pose = own.pose(1600.0);
  EXPECT_EQ(pose.longitude_deg.value, 8.001);
  EXPECT_EQ(pose.extrapolated_ns, 0);
}

TEST(OwnshipPose, stands_still_at_the_pole_and_wraps_at_the_date_line) {
  Ownship pole = flying(100.0, 90.0);
  pole.state = {};
  pole.feed(float_of(P::gps_ground_speed, 100.0, 0.0));
  pole.feed(float_of(P::gps_true_track, 90.0, 0.0));
  pole.feed_fix(89.9999, 10.0, 0.0);
  EXPECT_EQ(pole.pose(500.0).longitude_deg.value, 10.0);
  Ownship line = flying(100.0, 90.0);
  line.state = {};
  line.feed(float_of(P::gps_ground_speed, 100.0, 0.0));
  line.feed(float_of(P::gps_true_track, 90.0, 0.0));
  line.feed_fix(0.1, 179.9999, 0.0);
  EXPECT_LT(line.pose(500.0).longitude_deg.value, -179.0);
}

TEST(OwnshipPose, each_value_keeps_its_own_age) {
  Ownship own = flying(0.0, 0.0);
  own.feed(float_of(P::roll, 1.0, 100.0));
  own.feed(float_of(P::pitch, 2.0, 150.0));
  own.feed(float_of(P::true_heading, -90.0, 180.0));
  const OwnshipPose pose = own.pose(200.0);
  EXPECT_EQ(pose.roll_deg.age_ns, 100 * testing::ms);
  EXPECT_EQ(pose.pitch_deg.age_ns, 50 * testing::ms);
  EXPECT_EQ(pose.heading_deg.age_ns, 20 * testing::ms);
  EXPECT_EQ(pose.heading_deg.value, 270.0);
  EXPECT_EQ(pose.latitude_deg.age_ns, 200 * testing::ms);
  EXPECT_EQ(pose.longitude_deg.age_ns, 199 * testing::ms);
}

TEST(OwnshipPose, heading_321_without_a_reference_is_not_a_heading) {
  Ownship own;
  own.feed(float_of(P::heading, 100.0, 0.0));
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::reference_unknown);
  own.profile.heading_reference = HeadingReference::true_north;
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::valid);
  EXPECT_EQ(own.pose(1.0).heading_deg.value, 100.0);
  EXPECT_EQ(own.pose(1.0).heading_source, HeadingSource::heading);
}

TEST(OwnshipPose, magnetic_heading_needs_a_fresh_variation) {
  Ownship own;
  own.feed(float_of(P::magnetic_heading, 359.0, 0.0));
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::reference_unknown);
  own.feed(float_of(P::magnetic_variation, 3.0, 1.0));
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::valid);
  EXPECT_NEAR(own.pose(1.0).heading_deg.value, 2.0, 1e-9);
  own.profile.variation_east_positive = false;
  EXPECT_NEAR(own.pose(1.0).heading_deg.value, 356.0, 1e-9);
  own.feed(float_of(P::magnetic_heading, 359.0, 60010.0));
  EXPECT_EQ(own.pose(60010.0).heading_deg.validity, Validity::reference_unknown);
}

TEST(OwnshipPose, heading_321_may_be_configured_as_magnetic) {
  Ownship own;
  own.profile.heading_reference = HeadingReference::magnetic_north;
  own.feed(float_of(P::heading, 10.0, 0.0));
  EXPECT_EQ(own.pose(1.0).heading_deg.validity, Validity::reference_unknown);
  own.feed(float_of(P::magnetic_variation, -4.0, 1.0));
  EXPECT_NEAR(own.pose(1.0).heading_deg.value, 6.0, 1e-9);
  EXPECT_EQ(own.pose(1.0).heading_source, HeadingSource::heading_magnetic);
}

TEST(OwnshipPose, true_heading_wins_while_it_is_fresh) {
  Ownship own;
  own.profile.heading_reference = HeadingReference::true_north;
  own.feed(float_of(P::true_heading, 50.0, 0.0));
  own.feed(float_of(P::heading, 51.0, 10.0));
  EXPECT_EQ(own.pose(20.0).heading_source, HeadingSource::true_heading);
  own.feed(float_of(P::heading, 52.0, 400.0));
  EXPECT_EQ(own.pose(400.0).heading_source, HeadingSource::heading);
  EXPECT_EQ(own.pose(800.0).heading_deg.validity, Validity::stale);
  EXPECT_EQ(own.pose(800.0).heading_source, HeadingSource::true_heading);
}

TEST(OwnshipPose, track_is_never_a_heading) {
  const Ownship own = flying(60.0, 90.0);
  EXPECT_EQ(own.pose(10.0).heading_deg.validity, Validity::missing);
  EXPECT_EQ(own.pose(10.0).heading_source, HeadingSource::none);
}

TEST(OwnshipPose, inertial_position_steps_in_with_its_own_height_only) {
  Ownship own = flying(50.0, 0.0);
  own.feed(long_of(P::ins_latitude, 46.6, 2100.0));
  own.feed(long_of(P::ins_longitude, 8.1, 2101.0));
  const OwnshipPose pose = own.pose(2102.0);
  EXPECT_EQ(pose.position_source, PositionSource::ins);
  EXPECT_EQ(pose.latitude_deg.value, 46.6);
  EXPECT_EQ(pose.height_m.validity, Validity::missing);
  own.feed(float_of(P::ins_height, 1900.0, 2103.0));
  EXPECT_EQ(own.pose(2104.0).height_m.validity, Validity::valid);
  own.feed_fix(46.5, 8.0, 2200.0);
  EXPECT_EQ(own.pose(2202.0).position_source, PositionSource::gps);
}

TEST(OwnshipPose, nothing_received_is_missing_not_zero) {
  const OwnshipPose pose = Ownship().pose(0.0);
  for (const PoseValue* value : {&pose.latitude_deg, &pose.longitude_deg, &pose.height_m,
                                 &pose.roll_deg, &pose.pitch_deg, &pose.heading_deg}) {
    EXPECT_EQ(value->validity, Validity::missing);
  }
  EXPECT_EQ(pose.position_source, PositionSource::none);
}

}  // namespace
}  // namespace ridgeline
