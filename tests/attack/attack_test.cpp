// The attack's counts, its messages and what it does with failing cases, with a judge of the test.
#include "sim/attack/attack.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "sim/attack/random_case.hpp"

namespace ridgeline::sim {
namespace {

AttackOptions with_judge(std::function<CaseResult(const AttackCase&, const JudgeOptions&)> judged,
                         int cases) {
  AttackOptions options;
  options.cases = cases;
  options.seed = 31;
  options.judged = std::move(judged);
  return options;
}

CaseResult clean(const AttackCase& c) {
  CaseResult result;
  result.frames = c.poses.size();
  result.pixels = 100 * c.poses.size();
  return result;
}

TEST(Attack, draws_the_cases_of_its_seed_and_adds_up_what_came_of_them) {
  std::vector<std::string> drawn;
  const AttackOptions options = with_judge(
      [&](const AttackCase& c, const JudgeOptions&) {
        drawn.push_back(text_of(c));
        CaseResult result = clean(c);
        result.removed = 1;
        result.reasons["no_bound"] = 1;
        return result;
      },
      9);
  std::ostringstream progress, out;
  const AttackSummary summary = attack(options, progress, out);
  ASSERT_EQ(drawn.size(), 9U);
  std::size_t poses = 0;
  for (std::uint64_t number = 0; number < 9; ++number) {
    const AttackCase c = random_case(31, number);
    EXPECT_EQ(drawn[number], text_of(c));
    poses += c.poses.size();
  }
  EXPECT_EQ(summary.all.cases, 9U);
  EXPECT_EQ(summary.all.frames, poses);
  EXPECT_EQ(summary.all.pixels, 100 * poses);
  EXPECT_EQ(summary.all.failed_cases, 0U);
  EXPECT_NE(out.str().find("removed because no_bound 9"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("seed 31, cases 9, pixels checked " + std::to_string(100 * poses)),
            std::string::npos)
      << out.str();
}

TEST(Attack, tells_a_failing_case_as_a_command_that_repeats_it_and_a_smaller_one) {
  const auto judged = [](const AttackCase& c, const JudgeOptions&) {
    CaseResult result = clean(c);
    if (c.poses.front().pitch_deg < -10) {
      result.violations = 2;
      result.details = {"frame 000000 pixel (1, 2) violates soundness"};
    }
    return result;
  };
  std::ostringstream progress, out;
  const AttackSummary summary = attack(with_judge(judged, 12), progress, out);
  ASSERT_GE(summary.all.failed_cases, 1U);
  EXPECT_EQ(summary.all.violations, 2 * summary.all.failed_cases);
  EXPECT_NE(out.str().find("pixel (1, 2) violates soundness"), std::string::npos);
  const std::string told = out.str().substr(out.str().find("smallest case found"));
  const std::size_t from = told.find("--case '") + 8;
  AttackCase smallest;
  ASSERT_EQ(parse_case(told.substr(from, told.find('\'', from) - from), smallest), "") << told;
  EXPECT_LT(smallest.poses.front().pitch_deg, -10);
  EXPECT_TRUE(smallest.land.empty());
  EXPECT_EQ(smallest.poses.size(), 1U);
}

TEST(Attack, does_not_take_a_crash_for_a_smaller_violation) {
  const auto judged = [](const AttackCase& c, const JudgeOptions&) {
    CaseResult result = clean(c);
    if (c.poses.size() > 1) {
      result.violations = 1;
    } else {
      result.fault = "ended by signal 11";
    }
    return result;
  };
  std::ostringstream progress, out;
  const AttackSummary summary = attack(with_judge(judged, 1), progress, out);
  EXPECT_EQ(summary.all.failed_cases, 1U);
  EXPECT_EQ(out.str().find("signal"), std::string::npos) << out.str();
}

TEST(Attack, ends_when_no_case_can_be_judged) {
  const auto judged = [](const AttackCase&, const JudgeOptions&) {
    CaseResult result;
    result.unusable = "graphics: none";
    return result;
  };
  std::ostringstream progress, out;
  EXPECT_EQ(attack(with_judge(judged, 5), progress, out).unusable, "graphics: none");
}

TEST(Attack, begins_no_case_after_its_time) {
  AttackOptions options =
      with_judge([](const AttackCase& c, const JudgeOptions&) { return clean(c); }, 1);
  options.cases.reset();
  options.seconds = 0;
  std::ostringstream progress, out;
  EXPECT_EQ(attack(options, progress, out).all.cases, 0U);
}

}  // namespace
}  // namespace ridgeline::sim
