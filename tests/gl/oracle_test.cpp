// The promise of the contract, pose by pose: frames of the real renderer against the oracle.
#include <gtest/gtest.h>

#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry small_image{200, 160, 60};
constexpr double range_m = 18'000;
constexpr int pixels = 250;

/// One 3" tile of rough land with voids, far north of the equator.
class RoughLand : public testing::TestWithParam<double> {
 protected:
  static const Land& land() {
    static const RoughTile made;
    return made;
  }
  static Pose over(double latitude_deg, double longitude_deg, double height_m,
                   const Attitude& attitude) {
    return {{latitude_deg, longitude_deg, land().ground_m(latitude_deg, longitude_deg) + height_m},
            attitude};
  }
};

TEST_P(RoughLand, rolled_and_pitched_to_the_limits) {
  Scene s(land(), small_image, GetParam(), range_m, {46.5, 8.5, 2000});
  std::vector<Pose> poses;
  for (const double roll : {0.0, 90.0, -90.0, 180.0, -133.0}) {
    poses.push_back(over(46.51, 8.47, 700, {roll, -6, 30}));
  }
  for (const double pitch : {-90.0, -89.999, -60.0, 89.999, 90.0}) {
    poses.push_back(over(46.42, 8.61, 900, {20, pitch, 200}));
  }
  expect_sound(s, poses, pixels);
}

TEST_P(RoughLand, two_metres_over_the_ground) {
  Scene s(land(), small_image, GetParam(), range_m, {46.5, 8.5, 2000});
  expect_sound(s, {over(46.3123, 8.4567, 2, {0, 0, 77}), over(46.7077, 8.3011, 2, {-30, 5, 310})},
               pixels);
}

TEST_P(RoughLand, twenty_kilometres_up) {
  Scene s(land(), small_image, GetParam(), 60'000, {46.5, 8.5, 20'000});
  expect_sound(s, {{{46.5, 8.5, 20'000}, {5, -25, 120}}, {{46.5, 8.2, 20'000}, {0, -70, 90}}},
               pixels);
}

TEST_P(RoughLand, narrow_and_wide_views) {
  Scene s(land(), {200, 160, 10}, GetParam(), range_m, {46.5, 8.5, 2000});
  expect_sound(s, {over(46.44, 8.52, 300, {3, -3, 10}), over(46.58, 8.43, 300, {-90, 1, 190})},
               pixels);
  Scene wide(land(), {200, 160, 120}, GetParam(), range_m, {46.5, 8.5, 2000});
  expect_sound(wide, {over(46.44, 8.52, 300, {3, -3, 10}), over(46.58, 8.43, 300, {-90, 1, 190})},
               pixels);
}

TEST_P(RoughLand, eye_on_posts_edges_and_axes) {
  Scene s(land(), small_image, GetParam(), range_m, {46.5, 8.5, 2000});
  std::vector<Pose> poses;
  const double post = 1.0 / 1200;
  for (int k = 0; k < 8; ++k) {  // exactly on a post, looking along axes and diagonals
    poses.push_back(over(46 + 600 * post, 8 + (560 + k) * post, 250, {0, -4, 45.0 * k}));
  }
  poses.push_back(over(46 + 300 * post, 8 + 300.5 * post, 120, {0, -2, 0}));  // on a cell edge
  poses.push_back(over(46 + 300.5 * post, 8 + 300 * post, 120, {0, -2, 90}));
  expect_sound(s, poses, pixels);
}

TEST_P(RoughLand, random_poses) {
  Scene s(land(), small_image, GetParam(), range_m, {46.5, 8.5, 2000});
  std::vector<Pose> poses;
  for (int k = 0; k < 10; ++k) {
    const double a = 0.37 * (k + 1), b = 0.71 * (k + 1), c = 0.53 * (k + 1), d = 0.91 * (k + 1);
    const Attitude attitude{360 * (a - std::floor(a)) - 180, 80 * (b - std::floor(b)) - 50,
                            360 * (c - std::floor(c))};
    Pose pose = over(46.2 + 0.06 * k, 8.3 + 0.4 * (d - std::floor(d)), 40 + 150.0 * k, attitude);
    if (std::isnan(pose.eye.height_m)) pose.eye.height_m = 2500;  // over unknown ground
    poses.push_back(pose);
  }
  expect_sound(s, poses, pixels);
}

INSTANTIATE_TEST_SUITE_P(Bounds, RoughLand, testing::Values(1.0, 3.0),
                         [](const auto& bound) { return bound.param == 1.0 ? "1px" : "3px"; });

class Places : public testing::TestWithParam<double> {};

TEST_P(Places, equator_and_tile_corner) {
  Land land(rough_m);
  for (const int south : {-1, 0}) {
    for (const int west : {-1, 0}) land.add_tile(south, west);
  }
  Scene s(land, small_image, GetParam(), range_m, {0, 0, 3000});
  expect_sound(s,
               {{{0, 0, land.ground_m(0, 0) + 50}, {0, 0, 45}},  // exactly on the tile corner
                {{0.0002, -0.0001, 3000}, {10, -20, 225}},
                {{0.01, -0.013, 2500}, {-40, -10, 0}}},
               pixels);
}

TEST_P(Places, southern_hemisphere) {
  Land land(rough_with_voids_m);
  land.add_tile(-46, -73);
  Scene s(land, small_image, GetParam(), range_m, {-45.5, -72.5, 3000});
  expect_sound(s, {{{-45.5, -72.5, 2100}, {12, -8, 100}}, {{-45.31, -72.64, 1900}, {0, 0, 280}}},
               pixels);
}

TEST_P(Places, antimeridian) {
  Land land(rough_with_voids_m);
  land.add_tile(-17, 179);
  land.add_tile(-17, -180);
  Scene s(land, small_image, GetParam(), range_m, {-16.5, 179.99, 3000});
  expect_sound(s,
               {{{-16.5, 179.99, 2000}, {5, -6, 90}},
                {{-16.5, -179.98, 2000}, {-5, -6, 270}},
                {{-16.4, 180, 2300}, {0, -10, 0}}},
               pixels);
}

TEST_P(Places, antimeridian_seen_from_the_east_first) {
  // 2026-11-22: a window that began east of 180 degrees left the western tile out.
  Land land(rough_with_voids_m);
  land.add_tile(-17, 179);
  land.add_tile(-17, -180);
  Scene s(land, small_image, GetParam(), range_m, {-16.5, -179.98, 2000});
  expect_sound(s, {{{-16.5, -179.98, 2000}, {-5, -6, 270}}}, pixels);
}

TEST_P(Places, one_arc_second_tile) {
  Land land(rough_m);
  land.add_tile(36, 5, 3601);
  Scene s(land, small_image, GetParam(), 6'000, {36.5, 5.5, 3000});
  expect_sound(s, {{{36.5, 5.5, 2300}, {0, -10, 60}}, {{36.52, 5.48, 1900}, {45, 0, 10}}}, pixels);
}

TEST_P(Places, dted_zone_two_tile) {
  Land land(rough_with_voids_m);
  land.add_dted(61, 10);
  Scene s(land, small_image, GetParam(), range_m, {61.5, 10.5, 3000});
  const double low = land.ground_m(61.52, 10.53, 1.0 / 1200, 1.0 / 600);
  expect_sound(s,
               {{{61.5, 10.5, 2200}, {0, -8, 60}},
                {{61.52, 10.53, std::isnan(low) ? 1900 : low + 5}, {0, 0, 333}}},
               pixels);
}

INSTANTIATE_TEST_SUITE_P(Bounds, Places, testing::Values(1.0, 3.0),
                         [](const auto& bound) { return bound.param == 1.0 ? "1px" : "3px"; });

}  // namespace
}  // namespace ridgeline::test
