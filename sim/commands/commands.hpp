#pragma once
#include <CLI/CLI.hpp>

namespace ridgeline::sim {

/// Exit statuses of the contract.
enum ExitStatus : int { done = 0, check_failed = 1, wrong_usage = 2, bad_input = 3 };

/// Each adds its command to the program; the returned status lands in `status` when it runs.
void add_pose_command(CLI::App& program, int& status);
void add_replay_command(CLI::App& program, int& status);
void add_import_command(CLI::App& program, int& status);
void add_bench_command(CLI::App& program, int& status);
void add_verify_command(CLI::App& program, int& status);
void add_make_demo_command(CLI::App& program, int& status);

}  // namespace ridgeline::sim
