// A failing case is made smaller by a judge that need not be the oracle.
#include "sim/attack/shrink.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/attack/random_case.hpp"

namespace ridgeline::sim {
namespace {

constexpr int many_tries = 5'000;

bool has_layer(const AttackCase& c, LayerKind kind) {
  return std::any_of(c.land.begin(), c.land.end(),
                     [kind](const Layer& layer) { return layer.kind == kind; });
}

/// The first random case for which this holds.
template <typename Holds>
AttackCase first_case(const Holds& holds) {
  for (std::uint64_t number = 0;; ++number) {
    AttackCase c = random_case(21, number);
    if (holds(c)) return c;
  }
}

TEST(Shrink, leaves_nothing_that_the_failure_does_not_need) {
  const AttackCase start = first_case([](const AttackCase& c) {
    return c.land.size() >= 3 && c.poses.size() >= 3 && c.tiles.size() >= 2 && !c.edits.empty();
  });
  const AttackCase c = shrunk(
      start, [](const AttackCase&) { return true; }, many_tries);
  EXPECT_EQ(c.poses.size(), 1U);
  EXPECT_EQ(c.tiles.size(), 1U);
  EXPECT_TRUE(c.land.empty());
  EXPECT_TRUE(c.edits.empty());
  EXPECT_TRUE(c.sea.empty());
  EXPECT_EQ(c.window_mib, 96);
  EXPECT_EQ(c.error_px, 1);
  EXPECT_EQ(c.range_m, 1'000);
  EXPECT_LE(c.image.width_px, 32);
  EXPECT_EQ(c.poses[0].roll_deg, 0);
  EXPECT_EQ(c.poses[0].heading_deg, 0);
  EXPECT_EQ(c.poses[0].height_m, std::round(c.poses[0].height_m));
}

TEST(Shrink, keeps_what_the_failure_needs) {
  const auto fails = [](const AttackCase& c) {
    const bool spires = has_layer(c, LayerKind::spires);
    const bool steep = std::any_of(c.poses.begin(), c.poses.end(),
                                   [](const AttackPose& p) { return p.pitch_deg < -5; });
    return spires && steep && c.image.width_px > 50 && c.range_m > 2'500;
  };
  const AttackCase start = first_case(
      [&](const AttackCase& c) { return fails(c) && c.land.size() >= 2 && c.poses.size() >= 2; });
  const AttackCase c = shrunk(start, fails, many_tries);
  EXPECT_TRUE(fails(c)) << text_of(c);
  ASSERT_EQ(c.land.size(), 1U) << text_of(c);
  EXPECT_EQ(c.land[0].kind, LayerKind::spires);
  EXPECT_EQ(c.land[0].numbers[0], 0);  // nothing said that they must be high
  EXPECT_EQ(c.poses.size(), 1U);
  EXPECT_LE(c.image.width_px, 101);
  EXPECT_LE(c.range_m, 3'125);
}

TEST(Shrink, halves_amounts_down_to_where_the_failure_ends) {
  AttackCase start;
  ASSERT_EQ(
      parse_case("tile=dt0:46,8 land=walls:4000,7,1,2,3 pose=46.5,8.5,9000,0,-20,10,0", start), "");
  const auto fails = [](const AttackCase& c) {
    return has_layer(c, LayerKind::walls) && c.land[0].numbers[0] >= 300 &&
           c.land[0].numbers[1] < 100;
  };
  const AttackCase c = shrunk(start, fails, many_tries);
  EXPECT_EQ(c.land[0].numbers[0], 500);
  EXPECT_EQ(c.land[0].numbers[1], 56);  // rarer walls
  EXPECT_EQ(c.land[0].numbers[3], 2);   // a direction has no simpler value
}

TEST(Shrink, stops_after_so_many_tries_with_a_case_that_fails) {
  const AttackCase start = random_case(22, 4);
  int asked = 0;
  const auto fails = [&](const AttackCase& c) {
    ++asked;
    return c.poses.size() > 1;
  };
  const AttackCase c = shrunk(start, fails, 7);
  EXPECT_EQ(asked, 7);
  EXPECT_GT(c.poses.size(), 1U);
}

TEST(Shrink, ends_by_itself_and_asks_for_valid_cases_only) {
  for (std::uint64_t number = 0; number < 20; ++number) {
    int asked = 0;
    const auto fails = [&](const AttackCase& c) {
      ++asked;
      AttackCase again;
      EXPECT_EQ(parse_case(text_of(c), again), "");
      return (text_of(c).size() + static_cast<std::size_t>(asked)) % 3 != 0;
    };
    static_cast<void>(shrunk(random_case(23, number), fails, many_tries));
    EXPECT_LT(asked, many_tries);
  }
}

}  // namespace
}  // namespace ridgeline::sim
