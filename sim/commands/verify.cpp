#include "tests/oracle/verify.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include "sim/commands/attack.hpp"
#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"
#include "sim/output/atomic_file.hpp"
#include "tests/oracle/input_error.hpp"

namespace ridgeline::sim {
namespace {

struct VerifyArguments {
  oracle::VerifyOptions options;
  std::string json_file;
};

/// Whether a file can be written as far as its folder goes; a file without a name can.
bool has_folder(const std::string& file) {
  if (file.empty()) return true;
  std::error_code fault;
  return std::filesystem::is_directory(std::filesystem::absolute(file, fault).parent_path(), fault);
}

int run_verify(const VerifyArguments& arguments) {
  if (!has_folder(arguments.json_file)) {  // told now, not after the whole run
    return fail(bad_input, arguments.json_file + ": its folder does not exist");
  }
  try {
    const oracle::VerifySummary summary = oracle::run_verify(arguments.options, std::cerr);
    oracle::print_summary(summary, std::cout);
    if (!arguments.json_file.empty()) {
      const Outcome written =
          write_file(arguments.json_file, oracle::json_report(arguments.options, summary));
      if (!written.ok()) return fail(bad_input, written.message);
    }
    return oracle::exit_status(summary);
  } catch (const oracle::InputError& error) {
    return fail(bad_input, error.what());
  }
}

void add_measure_options(CLI::App& command, VerifyArguments& arguments) {
  oracle::VerifyOptions& options = arguments.options;
  command
      .add_option_function<std::string>(
          "--pixels",
          [&options](const std::string& word) {
            options.all_pixels = word == "all";
            if (!options.all_pixels) CLI::detail::lexical_cast(word, options.pixels_per_frame);
          },
          "pixels a frame, half at depth jumps, or `all`")
      ->check(CLI::Range(1, 100'000'000) | CLI::IsMember({"all"}))
      ->default_str(std::to_string(options.pixels_per_frame))
      ->type_name("N|all");
  command.add_option("--seed", options.seed, "seed of the choice of pixels")->capture_default_str();
  command.add_option("--threads", options.threads, "threads; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--walk",
          [&options](const std::string& word) {
            options.walk =
                word == "every-cell" ? oracle::Walk::every_cell : oracle::Walk::accelerated;
          },
          "how rays are followed; the result is the same")
      ->check(CLI::IsMember({"accelerated", "every-cell"}))
      ->default_str("accelerated");
  command.add_flag("--errors-sampled", options.errors_sampled,
                   "measure errors of the sampled pixels only; the promise is decided at all");
  command.add_flag("--strict-edge", options.strict_edge,
                   "completeness by pixels of the image alone");
  command.add_flag_function(
      "--between,!--no-between", [&options](std::int64_t given) { options.between = given > 0; },
      "look for information at a second point of every pixel");
  command
      .add_option("--without-slack", options.without_slack_one_in,
                  "measure the error without slack at one pixel in N; 0 nowhere")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command.add_option("--json", arguments.json_file, "file for a report");
}

}  // namespace

void add_verify_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<VerifyArguments>();
  oracle::VerifyOptions& options = arguments->options;
  CLI::App* command = program.add_subcommand("verify", "check a dump against the terrain files");
  auto attacked = std::make_shared<AttackArguments>();
  command->add_option("DUMP_DIR", options.dump_folder, "folder of a dump");
  command->add_option("--terrain", options.terrain_folder, "folder of raw elevation tiles");
  add_attack_options(*command, *attacked);
  command->add_option("--geoid", options.geoid, "geoid file or `none`");
  command->add_option("--coverage", options.coverage_file, "list of cells that are sea");
  command->add_option("--edit", options.edit_file, "timed edits that the replay was given");
  add_measure_options(*command, *arguments);
  command->callback([arguments, attacked, command, &status] {
    const oracle::VerifyOptions& given = arguments->options;
    if (attacked->given()) {
      attacked->seed = given.seed;
      attacked->threads = given.threads;
      if (command->count("--pixels") > 0) attacked->pixels_per_frame = given.pixels_per_frame;
      status = run_attack(*attacked);
    } else if (given.dump_folder.empty() || given.terrain_folder.empty()) {
      status = fail(wrong_usage, "verify: DUMP_DIR and --terrain are required (see --help)");
    } else {
      status = run_verify(*arguments);
    }
  });
}

}  // namespace ridgeline::sim
