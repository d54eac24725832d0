#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geo/geoid.hpp"

namespace ridgeline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::nan("");

// 3 x 4 posts, 90 degrees apart, all round the Earth: 10 * row + column.
const std::vector<float> world_posts_m = {0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23};
const GeoidGrid world{-90, -180, 90, 90, 3, 4, world_posts_m};

// 2 x 3 posts, one degree apart, from 46 N 8 E.
const std::vector<float> region_posts_m = {50, 51, 52, 54, 55, 56};
const GeoidGrid region{46, 8, 1, 1, 2, 3, region_posts_m};

TEST(Geoid, without_posts_mean_sea_level_is_the_ellipsoid) {
  EXPECT_EQ(undulation_m(GeoidGrid{}, 46.5, 8.1), 0.0);
  EXPECT_TRUE(std::isnan(undulation_m(GeoidGrid{}, 90.1, 8.1)));
}

TEST(Geoid, posts_are_met_and_the_rest_is_bilinear) {
  EXPECT_DOUBLE_EQ(undulation_m(region, 46, 8), 50.0);
  EXPECT_DOUBLE_EQ(undulation_m(region, 47, 10), 56.0);
  EXPECT_DOUBLE_EQ(undulation_m(region, 46.25, 9.5), 0.75 * 51.5 + 0.25 * 55.5);
  EXPECT_DOUBLE_EQ(undulation_m(world, 0, -180), 10.0);
  EXPECT_DOUBLE_EQ(undulation_m(world, -45, -135), 5.5);
}

TEST(Geoid, longitude_wraps) {
  EXPECT_DOUBLE_EQ(undulation_m(world, 0, 90), 13.0);
  EXPECT_DOUBLE_EQ(undulation_m(world, 0, 135), 0.5 * 13 + 0.5 * 10);
  EXPECT_DOUBLE_EQ(undulation_m(world, 0, 180), 10.0);
  EXPECT_DOUBLE_EQ(undulation_m(world, 0, 135), undulation_m(world, 0, -225));
  EXPECT_DOUBLE_EQ(undulation_m(world, 0, 45), undulation_m(world, 0, 405));
  EXPECT_NEAR(undulation_m(world, 0, std::nextafter(180.0, 0.0)), 10.0, 1e-12);
  EXPECT_NEAR(undulation_m(world, 0, std::nextafter(-180.0, -190.0)), 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(undulation_m(region, 46, 369), 51.0);
}

TEST(Geoid, poles_are_on_the_grid) {
  EXPECT_DOUBLE_EQ(undulation_m(world, 90, -180), 20.0);
  EXPECT_DOUBLE_EQ(undulation_m(world, -90, 90), 3.0);
}

TEST(Geoid, outside_the_grid_is_unknown) {
  EXPECT_TRUE(std::isnan(undulation_m(region, 45.9999, 9)));
  EXPECT_TRUE(std::isnan(undulation_m(region, 47.0001, 9)));
  EXPECT_TRUE(std::isnan(undulation_m(region, 46.5, 7.9999)));
  EXPECT_TRUE(std::isnan(undulation_m(region, 46.5, 10.0001)));
  EXPECT_TRUE(std::isnan(undulation_m(region, 46.5, -9)));
}

/// Found by fuzzing (2026-11-26): the gap was taken for a whole cell, however narrow it was.
TEST(Geoid, between_the_last_post_and_the_first_of_a_grid_that_does_not_close_is_nothing) {
  const std::array<float, 8> posts_m{1, 2, 3, 4, 5, 6, 7, 8};
  GeoidGrid grid{.south_deg = -90,
                 .west_deg = 0,
                 .latitude_step_deg = 180,
                 .longitude_step_deg = 118,
                 .rows = 2,
                 .columns = 4,
                 .posts_m = posts_m};
  EXPECT_NEAR(undulation_m(grid, -90, 354), 4, 1e-9);
  EXPECT_TRUE(std::isnan(undulation_m(grid, -90, 359)));
  grid.longitude_step_deg = 90.000001;  // few digits of 90
  EXPECT_NEAR(undulation_m(grid, -90, 315), 2.5, 1e-6);
}

TEST(Geoid, bad_places_are_unknown) {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    EXPECT_TRUE(std::isnan(undulation_m(world, bad, 0)));
    EXPECT_TRUE(std::isnan(undulation_m(world, 0, bad)));
  }
  EXPECT_TRUE(std::isnan(undulation_m(world, -90.0001, 0)));
}

TEST(Geoid, cell_with_a_post_without_data_is_unknown) {
  const std::vector<float> posts_m = {50, std::nanf(""), 52, 54, 55, 56};
  GeoidGrid torn = region;
  torn.posts_m = posts_m;
  EXPECT_TRUE(std::isnan(undulation_m(torn, 46.5, 8.5)));
  EXPECT_TRUE(std::isnan(undulation_m(torn, 46.5, 9.5)));
}

}  // namespace
}  // namespace ridgeline
