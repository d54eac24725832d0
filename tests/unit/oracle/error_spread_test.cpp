#include "tests/oracle/error_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ridgeline::oracle {
namespace {

TEST(ErrorSpread, is_nothing_without_errors) {
  const ErrorSpread spread;
  EXPECT_EQ(spread.count(), 0U);
  EXPECT_EQ(spread.mean_px(), 0);
  EXPECT_EQ(spread.percentile_px(0.99), 0);
  EXPECT_FALSE(spread.has_proven());
}

TEST(ErrorSpread, percentiles_are_those_of_the_sorted_errors) {
  ErrorSpread spread;
  // 0.0001 px, 0.0002 px ... 1 px, the larger ones first.
  for (int i = 10000; i > 0; --i) spread.add(i * 1e-4, false, 2, std::nullopt);
  for (const double share : {0.5, 0.9, 0.99, 0.999}) {
    EXPECT_GE(spread.percentile_px(share), share - 1e-4);
    EXPECT_LE(spread.percentile_px(share), 1.012 * share);
  }
  EXPECT_EQ(spread.percentile_px(1), 1);
  EXPECT_EQ(spread.max_px(), 1);
  EXPECT_NEAR(spread.mean_px(), 0.50005, 1e-9);
  EXPECT_NEAR(spread.tightness(), 2 / 0.50005, 1e-9);
  EXPECT_EQ(spread.max_of_bound(), 0.5);
}

TEST(ErrorSpread, no_error_has_its_own_bin_and_percentile) {
  ErrorSpread spread;
  for (int i = 0; i < 95; ++i) spread.add(0, false, 1, std::nullopt);
  for (int i = 0; i < 5; ++i) spread.add(1e-7, false, 1, std::nullopt);
  EXPECT_EQ(spread.percentile_px(0.9), 0);
  EXPECT_NEAR(spread.percentile_px(0.97), 1e-7, 1.2e-9);
  EXPECT_EQ(spread.bins()[0], 95U);
  EXPECT_EQ(spread.bins()[1], 5U);
}

TEST(ErrorSpread, bins_are_shares_of_each_frames_bound) {
  ErrorSpread spread;
  for (const double bound_px : {0.5, 4.0}) {
    for (const double share : {0.0005, 0.005, 0.03, 0.07, 0.15, 0.3, 0.9, 1.0, 1.5}) {
      spread.add(share * bound_px, false, bound_px, std::nullopt);
    }
    spread.add(bound_px, true, bound_px, std::nullopt);  // the bound, and more by nobody knows what
  }
  const std::array<std::size_t, 9> expected{0, 2, 2, 2, 2, 2, 2, 4, 4};
  EXPECT_EQ(spread.bins(), expected);
}

TEST(ErrorSpread, what_was_proven_counts_only_where_every_frame_says_it) {
  ErrorSpread spread;
  spread.add(0.01, false, 1, 0.02);
  spread.add(0.03, false, 1, 0.06);
  ASSERT_TRUE(spread.has_proven());
  EXPECT_NEAR(spread.tightness_of_proven(), 2, 1e-12);
  EXPECT_NEAR(spread.max_of_proven(), 0.5, 1e-12);
  EXPECT_NEAR(spread.mean_proven_px(), 0.04, 1e-12);
  spread.add(0.01, false, 1, std::nullopt);
  EXPECT_FALSE(spread.has_proven());
}

}  // namespace
}  // namespace ridgeline::oracle
