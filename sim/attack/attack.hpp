#pragma once
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

#include "sim/attack/judge_case.hpp"

namespace ridgeline::sim {

/// What the attack draws and how long.
struct AttackOptions {
  double seconds = 0;        ///< of wall time, after which no new case begins
  std::optional<int> cases;  ///< so many cases instead
  std::uint64_t seed = 1;
  int shrink_tries = 250;        ///< for each failing case
  double longest_shrink_s = 90;  ///< of wall time, as well
  int most_shrunk = 3;           ///< further failing cases are told as they are
  double progress_every_s = 2;   ///< wall time between two lines of progress
  JudgeOptions judge;
  /// What judges a case: judge_case() unless a test says otherwise.
  std::function<CaseResult(const AttackCase&, const JudgeOptions&)> judged = judge_case;
};

/// Counts of one kind of case.
struct AttackCounts {
  std::size_t cases = 0, failed_cases = 0;
  std::size_t frames = 0, removed = 0, pixels = 0, violations = 0, undecided = 0;

  void add(const CaseResult& result);
};

struct AttackSummary {
  AttackCounts all;
  std::map<std::string, AttackCounts> families;  ///< by layer, and by what else a case has
  std::map<std::string, std::size_t> removed_reasons;
  std::string unusable;  ///< why the attack could not go on; empty: it did
};

/// Draws case after case; progress, failing cases and the summary go to the streams.
AttackSummary attack(const AttackOptions& options, std::ostream& progress, std::ostream& out);

/// Judges one case and tells what came of it.
CaseResult retell(const AttackCase& attack_case, const JudgeOptions& options, std::ostream& out);

}  // namespace ridgeline::sim
