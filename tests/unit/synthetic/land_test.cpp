#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/synthetic/synthetic_terrain.hpp"

namespace ridgeline::sim {
namespace {

TEST(SyntheticLand, is_surrounded_by_sea_at_exactly_zero) {
  for (int k = 0; k <= 400; ++k) {
    const double along_deg = k * 0.005;
    EXPECT_EQ(synthetic_height_m(-49 + along_deg, -124), 0);
    EXPECT_EQ(synthetic_height_m(-49 + along_deg, -122), 0);
    EXPECT_EQ(synthetic_height_m(-49, -124 + along_deg), 0);
    EXPECT_EQ(synthetic_height_m(-47, -124 + along_deg), 0);
  }
  EXPECT_EQ(synthetic_height_m(10, 10), 0);
}

TEST(SyntheticLand, has_no_steps_a_metre_apart) {
  double steepest = 0;
  for (int k = 0; k < 20'000; ++k) {
    const double latitude_deg = -48.7 + (k % 200) * 0.005;
    const double longitude_deg = -123.6 + (k / 200) * 0.01;
    const double here = synthetic_height_m(latitude_deg, longitude_deg);
    const double beside = synthetic_height_m(latitude_deg + 1e-5, longitude_deg);
    if (!std::isnan(here) && !std::isnan(beside))
      steepest = std::max(steepest, std::fabs(here - beside) / 1.112);
  }
  EXPECT_LT(steepest, 4);
  EXPECT_GT(steepest, 0.7);
}

TEST(SyntheticLand, airfield_and_lake_are_flat) {
  for (const FlatFeature& feature : {synthetic_airfield, synthetic_lake}) {
    for (double along = -0.99; along < 1; along += 0.11) {
      for (double across = -0.99; across < 1; across += 0.11) {
        const double east_m = along * feature.half_length_m * feature.axis_east +
                              across * feature.half_width_m * feature.axis_north;
        const double north_m = along * feature.half_length_m * feature.axis_north -
                               across * feature.half_width_m * feature.axis_east;
        EXPECT_EQ(synthetic_height_m(feature.latitude_deg + north_m / 111'200,
                                     feature.longitude_deg + east_m / 74'600),
                  feature.height_m);
      }
    }
    EXPECT_DOUBLE_EQ(
        feature.axis_east * feature.axis_east + feature.axis_north * feature.axis_north, 1);
  }
  EXPECT_GE(2 * synthetic_airfield.half_length_m, 1500);
  EXPECT_GE(2 * synthetic_airfield.half_width_m, 400);
}

}  // namespace
}  // namespace ridgeline::sim
