#include "tests/oracle/wgs84.hpp"

#include <gtest/gtest.h>

namespace ridgeline::oracle {
namespace {

TEST(Wgs84, known_points_of_the_ellipsoid) {
  const Vec3 equator = ecef_from_geodetic({0, 90, 100});
  EXPECT_NEAR(equator.x, 0, 1e-9);
  EXPECT_NEAR(equator.y, 6378237.0, 1e-9);
  const Vec3 pole = ecef_from_geodetic({90, 0, 0});
  EXPECT_NEAR(pole.z, 6356752.314245179, 1e-8);
}

TEST(Wgs84, round_trip_is_exact_to_10_nm) {
  for (double lat = -89.9; lat < 90; lat += 7.7) {
    for (double lon = -179; lon < 180; lon += 31) {
      for (const double height : {-500.0, 0.0, 3000.0, 100000.0}) {
        const Vec3 point = ecef_from_geodetic({lat, lon, height});
        const Geodetic back = geodetic_from_ecef(point);
        EXPECT_NEAR(back.height_m, height, 1e-8);
        EXPECT_LT(length(ecef_from_geodetic(back) - point), 1e-8);
        EXPECT_NEAR(back.lat_deg, lat, 1e-13);
      }
    }
  }
}

TEST(Wgs84, camera_axes_follow_heading_then_pitch_then_roll) {
  const LevelFrame level = level_frame(46, 8);
  const CameraAxes east = camera_axes(level, 0, 0, 90);
  EXPECT_LT(length(east.forward - level.east), 1e-15);
  EXPECT_LT(length(east.down - level.down), 1e-15);
  const CameraAxes climbing = camera_axes(level, 0, 30, 0);
  EXPECT_NEAR(dot(climbing.forward, level.down), -0.5, 1e-15);
  EXPECT_GT(dot(climbing.down, level.north), 0.49);
  // Right wing down: the right axis points to the ground, the belly swings to the left.
  const CameraAxes banked = camera_axes(level, 90, 0, 0);
  EXPECT_LT(length(banked.right - level.down), 1e-15);
  EXPECT_LT(length(banked.down + level.east), 1e-15);
}

}  // namespace
}  // namespace ridgeline::oracle
