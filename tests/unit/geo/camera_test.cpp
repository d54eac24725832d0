#include "core/geo/camera.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geo/ground_map.hpp"

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr ImageGeometry image{200, 100, 90};

Camera made(const Attitude& attitude) {
  const auto result = camera(attitude, image);
  EXPECT_TRUE(result.ok());
  return result.value();
}

void expect_direction(const Vec3<Enu>& v, double east, double north, double up) {
  EXPECT_NEAR(v.xyz.x, east, 1e-12);
  EXPECT_NEAR(v.xyz.y, north, 1e-12);
  EXPECT_NEAR(v.xyz.z, up, 1e-12);
}

TEST(Camera, heading_turns_clockwise_from_north) {
  expect_direction(made({0, 0, 0}).ray(100, 50), 0, 1, 0);
  expect_direction(made({0, 0, 90}).ray(100, 50), 1, 0, 0);
  expect_direction(made({0, 0, 180}).ray(100, 50), 0, -1, 0);
  expect_direction(made({0, 0, -90}).ray(100, 50), -1, 0, 0);
}

TEST(Camera, pitch_up_raises_the_view) {
  expect_direction(made({0, 30, 0}).ray(100, 50), 0, std::cos(30 * deg), 0.5);
  expect_direction(made({0, -90, 0}).ray(100, 50), 0, 0, -1);
}

TEST(Camera, roll_right_lowers_the_right_wing) {
  // The right end of the picture looks down, the left end up, and the middle stays.
  const Camera rolled = made({30, 0, 0});
  EXPECT_LT(rolled.ray(200, 50).xyz.z, -0.4);
  EXPECT_GT(rolled.ray(0, 50).xyz.z, 0.4);
  expect_direction(rolled.ray(100, 50), 0, 1, 0);
}

TEST(Camera, picture_axes_run_right_and_down) {
  const Camera level = made({0, 0, 0});
  EXPECT_GT(level.ray(150, 50).xyz.x, 0);
  EXPECT_LT(level.ray(100, 80).xyz.z, 0);
  EXPECT_NEAR(level.ray(200, 50).xyz.x, 1.0, 1e-12);  // the edge of a view of 90 degrees
  EXPECT_DOUBLE_EQ(level.fx, level.fy);
}

TEST(Camera, refuses_what_is_outside_its_domain) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(camera({0, 91, 0}, image).fault(), Fault::attitude_out_of_range);
  EXPECT_EQ(camera({nan, 0, 0}, image).fault(), Fault::attitude_out_of_range);
  EXPECT_EQ(camera({0, 0, nan}, image).fault(), Fault::attitude_out_of_range);
  EXPECT_EQ(camera({}, {200, 100, 9.9}).fault(), Fault::field_of_view_out_of_range);
  EXPECT_EQ(camera({}, {200, 100, nan}).fault(), Fault::field_of_view_out_of_range);
  EXPECT_EQ(camera({}, {15, 100, 60}).fault(), Fault::image_size_out_of_range);
}

TEST(LocalFrame, axes_are_east_north_and_up_of_the_ellipsoid) {
  for (const GeodeticPosition& eye :
       {GeodeticPosition{46.5, 8.5, 2000}, {-33.1, -70.6, 0}, {0, 180, 100}, {89.9, 10, 10}}) {
    const LocalFrame frame = local_frame(eye).value();
    std::vector<double> rotation(9);
    double x = 0, y = 0, z = 0;
    GeographicLib::Geocentric::WGS84().Forward(eye.latitude_deg, eye.longitude_deg, eye.height_m, x,
                                               y, z, rotation);
    EXPECT_NEAR(frame.eye_ecef.xyz.x, x, 1e-8);
    EXPECT_NEAR(frame.eye_ecef.xyz.y, y, 1e-8);
    EXPECT_NEAR(frame.eye_ecef.xyz.z, z, 1e-8);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        EXPECT_NEAR(frame.ecef_from_enu.columns[column][row], rotation[3 * row + column], 1e-14);
      }
    }
    EXPECT_GE(frame.eye.longitude_deg, -180);
    EXPECT_LT(frame.eye.longitude_deg, 180);
  }
}

TEST(LocalFrame, refuses_places_that_are_none) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(local_frame({90.1, 0, 0}).fault(), Fault::latitude_out_of_range);
  EXPECT_EQ(local_frame({nan, 0, 0}).fault(), Fault::latitude_out_of_range);
  EXPECT_EQ(local_frame({0, 361, 0}).fault(), Fault::longitude_out_of_range);
  EXPECT_EQ(local_frame({0, 0, 30'000}).fault(), Fault::height_out_of_range);
  EXPECT_EQ(local_frame({0, 0, nan}).fault(), Fault::height_out_of_range);
}

/// Angle at the eye between where the map puts a ground point and where it is.
double misplacement_rad(const LocalFrame& frame, const GroundMap& map, double alpha, double g_m,
                        double height_m) {
  const double s = std::sin(alpha), c = std::cos(alpha);
  const double radius =
      1.0 / (c * c * map.inverse_meridian_radius + s * s * map.inverse_prime_vertical_radius);
  const ChartPoint offset = map.offset(g_m * s / map.range_m, g_m * c / map.range_m);
  const GroundPlace place = place_at(map.chart, frame.eye, offset);
  double x = 0, y = 0, z = 0;
  GeographicLib::Geocentric::WGS84().Forward(place.latitude_deg, place.longitude_deg, height_m, x,
                                             y, z);
  const Vec3<Ecef> point{{x, y, z}};
  const auto exact = (frame.ecef_from_enu.inverse() * (point - frame.eye_ecef)).xyz;
  const double rho =
      radius + map.swell_at_m(g_m * s / map.range_m, g_m * c / map.range_m) + height_m;
  const double across = rho * std::sin(g_m / radius);
  const double up = rho * std::cos(g_m / radius) - radius - frame.eye.height_m;
  const glm::dvec3 model(across * s, across * c, up);
  return glm::length(exact - model) / glm::length(model);
}

TEST(GroundMap, misplaces_nothing_by_more_than_it_says) {
  std::uint32_t seed = 99;
  const auto share = [&seed] { return (seed = seed * 1664525U + 1013904223U) * 0x1p-32; };
  for (int k = 0; k < 60; ++k) {
    const GeodeticPosition eye{150 * share() - 75, 360 * share() - 180, 20'000 * share()};
    const double range_m = 2000 + 118'000 * share();
    const LocalFrame frame = local_frame(eye).value();
    const auto map = ground_map(frame, range_m);
    ASSERT_TRUE(map.ok()) << eye.latitude_deg << ' ' << range_m;
    for (int i = 0; i < 400; ++i) {
      const double g_m = range_m * (0.02 + 0.98 * share());
      const double error = misplacement_rad(frame, map.value(), 2 * std::numbers::pi * share(), g_m,
                                            -500 + 9500 * share());
      EXPECT_LE(error, map.value().error_rad)
          << eye.latitude_deg << ' ' << eye.height_m << ' ' << range_m << ' ' << g_m;
    }
  }
}

TEST(GroundMap, is_as_good_at_the_poles_in_their_own_chart) {
  std::uint32_t seed = 7;
  const auto share = [&seed] { return (seed = seed * 1664525U + 1013904223U) * 0x1p-32; };
  for (const double latitude : {90.0, 89.999, 89.5, 88.0, 84.0, -90.0, -89.9999, -86.0}) {
    const Chart chart = latitude > 0 ? Chart::north_polar : Chart::south_polar;
    for (const double range_m : {20'000.0, 100'000.0, 200'000.0}) {
      const LocalFrame frame = local_frame({latitude, 360 * share() - 180, 3000}).value();
      const auto map = ground_map(frame, range_m, chart);
      ASSERT_TRUE(map.ok()) << latitude << ' ' << range_m;
      EXPECT_LT(map.value().error_rad, 2.5e-5) << latitude << ' ' << range_m;
      for (int i = 0; i < 400; ++i) {
        const double g_m = range_m * (0.02 + 0.98 * share());
        EXPECT_LE(misplacement_rad(frame, map.value(), 2 * std::numbers::pi * share(), g_m,
                                   -500 + 9500 * share()),
                  map.value().error_rad)
            << latitude << ' ' << range_m << ' ' << g_m;
      }
    }
  }
  EXPECT_EQ(ground_map(local_frame({60, 0, 1000}).value(), 20'000, Chart::north_polar).fault(),
            Fault::no_error_bound);
}

TEST(Chart, offsets_go_there_and_back_and_keep_their_sense_of_turn) {
  for (const Chart chart : {Chart::geographic, Chart::north_polar, Chart::south_polar}) {
    const double sign = chart == Chart::south_polar ? -1.0 : 1.0;
    for (const double colatitude : {0.3, 2.0, 9.0}) {
      for (const double longitude : {-179.5, -95.0, 0.0, 44.0, 170.0}) {
        const GeodeticPosition eye{sign * (90.0 - colatitude), longitude, 0};
        for (int k = 0; k < 8; ++k) {
          const double way = 0.2 * colatitude;
          const ChartPoint offset{way * std::cos(0.8 * k), way * std::sin(0.8 * k)};
          const GroundPlace place = place_at(chart, eye, offset);
          const ChartPoint back = chart_offset(chart, eye, place);
          EXPECT_NEAR(back.east_deg, offset.east_deg, 1e-11);
          EXPECT_NEAR(back.north_deg, offset.north_deg, 1e-11);
          if (chart == Chart::geographic) continue;
          const Turn turn = turn_of(chart, eye);
          const ChartPoint here = polar_point(chart, {eye.latitude_deg, eye.longitude_deg});
          const ChartPoint there = polar_point(chart, place);
          EXPECT_NEAR(there.east_deg - here.east_deg,
                      turn.cosine * offset.east_deg - turn.sine * offset.north_deg, 1e-11);
          EXPECT_NEAR(there.north_deg - here.north_deg,
                      turn.sine * offset.east_deg + turn.cosine * offset.north_deg, 1e-11);
          const GroundPlace same = polar_place(chart, there);
          EXPECT_NEAR(same.latitude_deg, place.latitude_deg, 1e-11);
          EXPECT_NEAR(std::remainder(same.longitude_deg - place.longitude_deg, 360.0), 0, 1e-9);
        }
        const ChartPoint north = chart_offset(chart, eye, {eye.latitude_deg + 0.01, longitude});
        EXPECT_NEAR(north.north_deg, 0.01, 1e-9);
        EXPECT_GT(chart_offset(chart, eye, {eye.latitude_deg, longitude + 0.01}).east_deg, 0);
      }
    }
  }
}

TEST(Chart, changes_near_a_pole_and_not_back_at_once) {
  EXPECT_EQ(chart_for(Chart::geographic, 46, 200'000), Chart::geographic);
  EXPECT_EQ(chart_for(Chart::geographic, 90, 1'000), Chart::north_polar);
  EXPECT_EQ(chart_for(Chart::north_polar, -90, 1'000), Chart::south_polar);
  EXPECT_EQ(chart_for(Chart::geographic, 85, 100'000), Chart::geographic);
  EXPECT_EQ(chart_for(Chart::north_polar, 85, 100'000), Chart::north_polar);
  EXPECT_EQ(chart_for(Chart::north_polar, 84.9, 100'000), Chart::geographic);
  for (const double range_m : {1'000.0, 20'000.0, 200'000.0}) {
    const double border = 90 - polar_enter_deg(range_m);
    for (const Chart chart : {Chart::geographic, Chart::north_polar}) {
      EXPECT_TRUE(ground_map(local_frame({border, 20, 5000}).value(), range_m, chart).ok());
    }
    const double far = 90 - polar_leave_deg(range_m);
    EXPECT_TRUE(ground_map(local_frame({far, 0, 0}).value(), range_m, Chart::north_polar).ok());
  }
}

TEST(GroundMap, gives_no_bound_at_the_poles_in_latitude_and_longitude) {
  EXPECT_EQ(ground_map(local_frame({89.9, 0, 1000}).value(), 100'000).fault(),
            Fault::no_error_bound);
  EXPECT_EQ(ground_map(local_frame({45, 0, 1000}).value(), 10).fault(), Fault::range_out_of_range);
}

}  // namespace
}  // namespace ridgeline
