#include "tests/oracle/verify.hpp"

#include <iostream>
#include <memory>

#include "sim/commands/attack.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"
#include "tests/oracle/input_error.hpp"

namespace ridgeline::sim {

void add_verify_command(CLI::App& program, int& status) {
  auto options = std::make_shared<oracle::VerifyOptions>();
  auto attacked = std::make_shared<AttackArguments>();
  CLI::App* command = program.add_subcommand("verify", "check a dump against the terrain files");
  command->add_option("DUMP_DIR", options->dump_folder, "folder of a dump");
  command->add_option("--terrain", options->terrain_folder, "folder of raw elevation tiles");
  add_attack_options(*command, *attacked);
  command->add_option("--geoid", options->geoid, "geoid file or `none`");
  command->add_option("--coverage", options->coverage_file, "list of cells that are sea");
  command->add_option("--edit", options->edit_file, "timed edits that the replay was given");
  command->add_option("--pixels", options->pixels_per_frame, "pixels a frame, half at depth jumps")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the choice of pixels")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "threads; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->callback([options, attacked, command, &status] {
    if (attacked->given()) {
      attacked->seed = options->seed;
      attacked->threads = options->threads;
      if (command->count("--pixels") > 0) attacked->pixels_per_frame = options->pixels_per_frame;
      status = run_attack(*attacked);
      return;
    }
    if (options->dump_folder.empty() || options->terrain_folder.empty()) {
      status = fail(wrong_usage, "verify: DUMP_DIR and --terrain are required (see --help)");
      return;
    }
    try {
      const oracle::VerifySummary summary = oracle::run_verify(*options, std::cerr);
      oracle::print_summary(summary, std::cout);
      status = oracle::exit_status(summary);
    } catch (const oracle::InputError& error) {
      status = fail(bad_input, error.what());
    }
  });
}

}  // namespace ridgeline::sim
