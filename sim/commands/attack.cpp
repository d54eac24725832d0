#include "sim/attack/attack.hpp"

#include <iostream>

#include "sim/commands/attack.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"

namespace ridgeline::sim {
namespace {

constexpr double longest_attack_s = 1e7;

int status_of(bool checked, bool failed, const std::string& unusable) {
  if (!unusable.empty()) return fail(bad_input, unusable);
  if (!checked && !failed) return fail(check_failed, "verify: no pixel was checked");
  return failed ? check_failed : done;
}

}  // namespace

void add_attack_options(CLI::App& verify, AttackArguments& arguments) {
  verify
      .add_option("--attack", arguments.seconds,
                  "draw and judge random cases; no new one begins after so many seconds")
      ->check(within(0.0, longest_attack_s));
  verify.add_option("--cases", arguments.cases, "so many random cases, however long it takes")
      ->check(CLI::Range(1, 1'000'000'000));
  verify.add_option("--case", arguments.case_text, "draw and judge the one case of this text");
  verify.add_option("--keep", arguments.keep_folder, "folder for the files of that case");
}

int run_attack(const AttackArguments& arguments) {
  JudgeOptions judge;
  if (arguments.pixels_per_frame) judge.pixels_per_frame = *arguments.pixels_per_frame;
  judge.threads = arguments.threads;
  if (!arguments.case_text.empty()) {
    AttackCase one;
    if (const std::string wrong = parse_case(arguments.case_text, one); !wrong.empty()) {
      return fail(wrong_usage, "--case: " + wrong);
    }
    judge.keep_folder = arguments.keep_folder;
    const CaseResult result = retell(one, judge, std::cout);
    return status_of(true, result.failed(), result.unusable);
  }
  AttackOptions options;
  options.seconds = arguments.seconds.value_or(0.0);
  options.cases = arguments.cases;
  options.seed = arguments.seed;
  options.judge = judge;
  const AttackSummary summary = attack(options, std::cerr, std::cout);
  return status_of(summary.all.pixels > 0, summary.all.failed_cases > 0, summary.unusable);
}

}  // namespace ridgeline::sim
