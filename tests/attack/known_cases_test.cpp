// Cases that the random attack found wrong once, made smaller, kept.
#include <gtest/gtest.h>

#include <cstdio>

#include "sim/attack/judge_case.hpp"

namespace ridgeline::sim {
namespace {

void expect_sound(const std::string& text) {
  AttackCase attack_case;
  ASSERT_EQ(parse_case(text, attack_case), "") << text;
  const CaseResult result = judge_case(attack_case, {});
  EXPECT_EQ(result.fault, "");
  EXPECT_EQ(result.violations, 0U) << (result.details.empty() ? text : result.details.front());
  EXPECT_GT(result.pixels, 0U);
}

// The nadir between the corners of a tile whose pixels shared rays: seed 7101, case 322.
TEST(KnownCase, a_nadir_between_the_corners_of_a_tile) {
  expect_sound(
      "at=31.5,35.5 tile=tif32:31.49388888888889,35.48888888888889,3600,3600,90,80 window=96 "
      "arrival=settled size=32,32 hfov=60 error=1 range=1000 pose=31.5,35.5,375,0,-79,0,3");
}

// The same by design: 20 of 12,000 pixels were incomplete.
TEST(KnownCase, a_nadir_in_a_wide_picture_with_large_blocks) {
  expect_sound(
      "at=31.5,35.5 tile=tif32:31.4,35.4,1200,1200,240,240 window=96 arrival=settled size=178,178 "
      "hfov=120 error=8 range=5000 pose=31.5,35.5,375,0,-90,0,0");
}

// An eye exactly on the northern edge of the data, whose rays north begin outside: seed 7105, case
// 13.
TEST(KnownCase, an_eye_on_the_edge_of_the_data) {
  expect_sound(
      "at=-17,-180 land=ridges:6490.5,4327,71256 land=checker:3.2,1 tile=dt0:-18,179 "
      "tile=dt0:-18,-180 tile=dt0:-17,179 tile=dt0:-17,-180 window=96 arrival=settled size=160,36 "
      "hfov=113.8 error=0.7 range=13735 pose=-16,180,3212.3,0,-8.93,45,0");
}

}  // namespace
}  // namespace ridgeline::sim
