#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace ridgeline::sim {

/// What `verify` was asked for besides judging a dump.
struct AttackArguments {
  std::optional<double> seconds;
  std::optional<int> cases;
  std::string case_text, keep_folder;
  std::uint64_t seed = 1;
  std::optional<int> pixels_per_frame;
  int threads = 1;

  [[nodiscard]] bool given() const { return seconds || cases || !case_text.empty(); }
};

/// Adds --attack, --cases, --case and --keep.
void add_attack_options(CLI::App& verify, AttackArguments& arguments);

/// Runs the attack or the one case. Result: the exit status.
[[nodiscard]] int run_attack(const AttackArguments& arguments);

}  // namespace ridgeline::sim
