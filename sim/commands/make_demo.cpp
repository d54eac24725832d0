#include "sim/synthetic/make_demo.hpp"

#include <cstdio>
#include <memory>

#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"

namespace ridgeline::sim {

void add_make_demo_command(CLI::App& program, int& status) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("make-demo", "write the synthetic default terrain and flight");
  command->add_option("DIR", *folder, "folder to write to")->required();
  command->callback([folder, &status] {
    const Outcome made = make_demo(*folder);
    status = made.ok() ? done : fail(bad_input, made.message);
    if (made.ok()) std::printf("synthetic tiles and demo.log in %s\n", folder->c_str());
  });
}

}  // namespace ridgeline::sim
