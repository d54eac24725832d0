#include "sim/replay/replay.hpp"

#include <cstdio>
#include <memory>

#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"

namespace ridgeline::sim {
namespace {

constexpr double longest_log_s = 1e6;

struct ReplayArguments : SceneArguments {
  ReplayOptions replay;
  std::string profile = "field";
  std::string heading = "assume-true";
  std::string arrival = "in-step";
};

int run_replay(ReplayArguments& arguments) {
  if (const std::string wrong = complete(arguments); !wrong.empty()) {
    return fail(wrong_usage, wrong);
  }
  ReplayOptions& options = arguments.replay;
  options.scene = arguments.scene;
  options.scene.arrival = arguments.arrival == "as-ready" ? SceneOptions::Arrival::as_ready
                                                          : SceneOptions::Arrival::in_step;
  options.bus.header_rule = arguments.profile == "strict" ? HeaderRule::strict : HeaderRule::field;
  options.heading_assumed = arguments.heading == "assume-true";
  options.bus.heading_reference = arguments.heading == "unknown" ? HeadingReference::unknown
                                  : arguments.heading == "magnetic"
                                      ? HeadingReference::magnetic_north
                                      : HeadingReference::true_north;
  const Outcome replayed = replay(options);
  return replayed.ok() ? done : fail(bad_input, replayed.message);
}

}  // namespace

void add_replay_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<ReplayArguments>();
  ReplayOptions& options = arguments->replay;
  CLI::App* command = program.add_subcommand("replay", "render a recorded bus log");
  command->add_option("LOG", options.log_file, "candump log of CANaerospace frames")->required();
  add_scene_options(*command, *arguments);
  command->add_option("--rate", options.rate_hz, "frames per second of log time")
      ->check(within(0.01, 200.0))
      ->capture_default_str();
  command->add_option("--from", options.from_s, "first second, from the start of the log")
      ->check(within(0.0, longest_log_s));
  command->add_option("--to", options.to_s, "last second, from the start of the log")
      ->check(within(0.0, longest_log_s));
  command->add_option("--frames", options.frames_folder, "folder for PNG pictures");
  command->add_option("--dump", options.dump_folder, "folder for dumps (contract, section 3)");
  command->add_option("--dump-every", options.dump_every, "dump only every so manieth frame")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--report", options.report_file, "JSON report");
  command->add_option("--edit", arguments->scene.edit_file,
                      "timed edits: posts that are replaced during the replay");
  command
      ->add_option("--arrival", arguments->arrival,
                   "terrain arrives so many blocks a frame (repeatable), or when the disk is done")
      ->check(CLI::IsMember({"in-step", "as-ready"}))
      ->capture_default_str();
  command
      ->add_option("--delay-us", arguments->scene.read_delay_us,
                   "wait before every block of terrain, as a slow disk would")
      ->check(CLI::Range(0, 1'000'000));
  command->add_option("--profile", arguments->profile, "bus profile")
      ->check(CLI::IsMember({"strict", "field"}))
      ->capture_default_str();
  command
      ->add_option("--heading", arguments->heading,
                   "what heading id 321 refers to; assume-true says so in every frame")
      ->check(CLI::IsMember({"true", "magnetic", "unknown", "assume-true"}))
      ->capture_default_str();
  command->callback([arguments, &status] { status = run_replay(*arguments); });
}

}  // namespace ridgeline::sim
