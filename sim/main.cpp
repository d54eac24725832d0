#include <cstdio>

#include "sim/commands/commands.hpp"

// The desktop program. Its commands, options and exit statuses are those of the contract:
// docs/commands.md.
int main(int argc, char** argv) {
  using namespace ridgeline::sim;
  CLI::App program{
      "Ridgeline: synthetic vision from raw elevation data with a proven error bound.\n"
      "NOT CERTIFIED. Supplemental only. Not a terrain warning system."};
  program.name("ridgeline");
  program.require_subcommand(1);
  int status = done;
  add_pose_command(program, status);
  add_replay_command(program, status);
  add_import_command(program, status);
  add_bench_command(program, status);
  add_verify_command(program, status);
  add_make_demo_command(program, status);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "ridgeline: %s (see --help)\n", error.what());
    return wrong_usage;
  }
  return status;
}
