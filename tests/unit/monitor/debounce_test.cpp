#include "core/monitor/debounce.hpp"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

TEST(Debounce, a_level_counts_after_standing_still) {
  Debounce input = debounce_from(false, 0);
  input = debounced(input, true, 10, 40);
  EXPECT_FALSE(debounced(input, true, 49, 40).level);
  EXPECT_TRUE(debounced(input, true, 50, 40).level);
}

TEST(Debounce, a_spike_never_counts_and_is_told) {
  Debounce input = debounce_from(true, 0);
  input = debounced(input, false, 10, 40);
  input = debounced(input, true, 20, 40);
  input = debounced(input, false, 30, 40);
  input = debounced(input, false, 60, 40);
  EXPECT_TRUE(input.level) << "the wait starts with the last change";
  EXPECT_EQ(input.bounces, 1u);
  EXPECT_FALSE(debounced(input, false, 70, 40).level);
}

TEST(Debounce, a_clock_that_goes_back_starts_the_wait_again) {
  Debounce input = debounce_from(false, 1000);
  input = debounced(input, true, 1010, 40);
  input = debounced(input, true, 500, 40);
  EXPECT_FALSE(input.level);
  EXPECT_FALSE(debounced(input, true, 539, 40).level);
  EXPECT_TRUE(debounced(input, true, 540, 40).level);
}

TEST(Debounce, without_a_wait_every_reading_counts) {
  const Debounce input = debounced(debounce_from(false, 0), true, 0, 0);
  EXPECT_TRUE(input.level);
  EXPECT_EQ(input.changes, 1u);
}

}  // namespace
}  // namespace ridgeline
