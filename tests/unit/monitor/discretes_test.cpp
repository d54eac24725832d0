#include "core/monitor/discretes.hpp"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

TEST(Discretes, lines_get_what_is_wanted_until_one_is_lost) {
  const OutputLevels wanted = {true, true, false}, present = {false, true, false};
  EXPECT_EQ(driven_levels(wanted, present, false), wanted);
  const OutputLevels lost = {false, false, true};
  EXPECT_EQ(driven_levels(wanted, present, true), lost) << "no edge, not valid, failed";
}

TEST(Discretes, a_display_that_shows_nothing_yet_says_failed) {
  const OutputLevels boot = {false, false, true};
  EXPECT_EQ(boot_levels, boot);
}

}  // namespace
}  // namespace ridgeline
