#include "sim/replay/replay.hpp"

#include <cstdio>
#include <memory>
#include <vector>

#include "sim/commands/commands.hpp"
#include "sim/commands/scene_arguments.hpp"
#include "sim/log/log_text.hpp"

namespace ridgeline::sim {
namespace {

constexpr double longest_log_s = 1e6;

struct ReplayArguments : SceneArguments {
  ReplayOptions replay;
  std::string profile = "field";
  std::string heading = "assume-true";
  std::string arrival = "in-step";
  std::string protocol = "canaerospace";
  std::vector<std::string> arinc429_ports;
  std::string fine = "add";
  std::string canfix_height = "unknown";
  std::string monitor = "off";
  std::string air_ground = "unknown";
};

/// "PORT=EQ" into the profile; an error message, or empty.
std::string set_port(const std::string& text, Arinc429Profile& profile) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string equipment = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto port = log_text::decimal_number(name);
  const auto id = log_text::hex_number(equipment);
  constexpr std::uint32_t last_equipment = 0xfff;
  if (!port || *port >= arinc429_port_count || !id || *id == 0 || *id > last_equipment) {
    return "--a429-port: '" + text + "' is not PORT=EQ, port 0 to 15, equipment 001 to FFF";
  }
  if (profile.ports[*port].equipment != 0) {
    return "--a429-port: port " + name + " is given twice";
  }
  profile.ports[*port].equipment = static_cast<std::uint16_t>(*id);
  return {};
}

/// What the options say about the bus; an error message, or empty.
std::string set_bus(const ReplayArguments& arguments, BusProfile& bus) {
  bus.protocol = arguments.protocol == "arinc429" ? BusProtocol::arinc429
                 : arguments.protocol == "canfix" ? BusProtocol::canfix
                                                  : BusProtocol::canaerospace;
  for (const std::string& port : arguments.arinc429_ports) {
    if (std::string wrong = set_port(port, bus.arinc429); !wrong.empty()) return wrong;
  }
  const bool is_arinc429 = bus.protocol == BusProtocol::arinc429;
  if (is_arinc429 && arguments.arinc429_ports.empty()) {
    return "--bus-protocol arinc429 needs --a429-port: a label means nothing without its equipment";
  }
  if (!is_arinc429 && !arguments.arinc429_ports.empty()) {
    return "--a429-port needs --bus-protocol arinc429";
  }
  bus.arinc429.fine_rule = arguments.fine == "by-sign" ? FineRule::by_coarse_sign
                           : arguments.fine == "none"  ? FineRule::coarse_alone
                                                       : FineRule::always_add;
  bus.canfix_height_is_ellipsoidal = arguments.canfix_height == "ellipsoidal";
  return {};
}

/// What the options say about the frame budget; an error message, or empty.
std::string set_pace(const ReplayArguments& arguments, ReplayOptions& options) {
  PaceOptions& pace = options.pace;
  pace.kind = arguments.monitor == "work"   ? PaceOptions::Kind::work
              : arguments.monitor == "real" ? PaceOptions::Kind::real
                                            : PaceOptions::Kind::none;
  if (!pace.decisions_file.empty()) {
    if (pace.kind != PaceOptions::Kind::none)
      return "--decisions brings its own clock: no --monitor";
    // Terrain that came whenever the disk was done comes now as it did then.
    if (options.scene.arrival == SceneOptions::Arrival::as_ready) {
      options.scene.arrival = SceneOptions::Arrival::as_recorded;
    }
  }
  if (!pace.record_file.empty() && pace.kind == PaceOptions::Kind::none &&
      pace.decisions_file.empty()) {
    return "--record-decisions needs --monitor: nothing is decided without";
  }
  return {};
}

int run_replay(ReplayArguments& arguments) {
  if (const std::string wrong = complete(arguments); !wrong.empty()) {
    return fail(wrong_usage, wrong);
  }
  ReplayOptions& options = arguments.replay;
  options.scene = arguments.scene;
  options.scene.arrival = arguments.arrival == "as-ready" ? SceneOptions::Arrival::as_ready
                                                          : SceneOptions::Arrival::in_step;
  options.bus.header_rule = arguments.profile == "strict" ? HeaderRule::strict : HeaderRule::field;
  options.air_ground = arguments.air_ground == "air"      ? AirGround::air
                       : arguments.air_ground == "ground" ? AirGround::ground
                                                          : AirGround::unknown;
  options.heading_assumed = arguments.heading == "assume-true";
  options.bus.heading_reference = arguments.heading == "unknown" ? HeadingReference::unknown
                                  : arguments.heading == "magnetic"
                                      ? HeadingReference::magnetic_north
                                      : HeadingReference::true_north;
  if (const std::string wrong = set_bus(arguments, options.bus); !wrong.empty()) {
    return fail(wrong_usage, wrong);
  }
  if (const std::string wrong = set_pace(arguments, options); !wrong.empty()) {
    return fail(wrong_usage, wrong);
  }
  const Outcome replayed = replay(options);
  return replayed.ok() ? done : fail(bad_input, replayed.message);
}

void add_pace_options(CLI::App& command, ReplayArguments& arguments) {
  PaceOptions& pace = arguments.replay.pace;
  command
      .add_option("--monitor", arguments.monitor,
                  "keep the frame budget: time is counted work (repeatable), or this machine's")
      ->check(CLI::IsMember({"off", "work", "real"}))
      ->capture_default_str();
  command.add_option("--deadline-ms", pace.deadline_ms, "time of a frame")
      ->check(within(1e-6 * static_cast<double>(limits::min_deadline_ns),
                     1e-6 * static_cast<double>(limits::max_deadline_ns)))
      ->capture_default_str();
  command
      .add_option("--most-error", pace.most_px,
                  "largest error bound taken to be in time; past it the terrain goes")
      ->check(within(0.0, limits::max_error_px))
      ->capture_default_str();
  command
      .add_option("--cost-scale", pace.cost_scale,
                  "with --monitor work: so many times as slow as the reference machine")
      ->check(within(0.001, 1000.0))
      ->capture_default_str();
  command.add_option("--record-decisions", pace.record_file,
                     "file for what the monitor decided and when terrain came");
  command.add_option("--decisions", pace.decisions_file,
                     "file of a recorded run, to be done again exactly");
}

void add_bus_options(CLI::App& command, ReplayArguments& arguments) {
  BusProfile& bus = arguments.replay.bus;
  command.add_option("--profile", arguments.profile, "bus profile")
      ->check(CLI::IsMember({"strict", "field"}))
      ->capture_default_str();
  command
      .add_option("--heading", arguments.heading,
                  "what heading id 321 refers to; assume-true says so in every frame")
      ->check(CLI::IsMember({"true", "magnetic", "unknown", "assume-true"}))
      ->capture_default_str();
  command.add_option("--bus-protocol", arguments.protocol, "what is spoken on the bus")
      ->check(CLI::IsMember({"canaerospace", "arinc429", "canfix"}))
      ->capture_default_str();
  command.add_option("--channels", bus.channel_count, "redundancy channels read, from 0 on")
      ->check(CLI::Range(1, 8191))
      ->capture_default_str();
  command.add_option("--a429-port", arguments.arinc429_ports,
                     "PORT=EQ: equipment id, hexadecimal, of an ARINC 429 port");
  command.add_option("--a429-fine", arguments.fine, "what GNSS fine words mean")
      ->check(CLI::IsMember({"add", "by-sign", "none"}))
      ->capture_default_str();
  command
      .add_option("--canfix-height", arguments.canfix_height,
                  "what the CAN-FIX GPS altitude counts from")
      ->check(CLI::IsMember({"ellipsoidal", "unknown"}))
      ->capture_default_str();
  command
      .add_option("--variation", bus.fixed_variation_deg,
                  "magnetic variation, east positive, used while the bus gives none")
      ->check(within(-180.0, 180.0));
}

}  // namespace

void add_replay_command(CLI::App& program, int& status) {
  auto arguments = std::make_shared<ReplayArguments>();
  ReplayOptions& options = arguments->replay;
  CLI::App* command = program.add_subcommand("replay", "render a recorded bus log");
  command->add_option("LOG", options.log_file, "recorded bus: candump, Vector ASC or PEAK TRC text")
      ->required();
  add_scene_options(*command, *arguments);
  add_display_options(*command, options.display);
  command
      ->add_option("--air-ground", arguments->air_ground,
                   "what an air/ground switch says all the time")
      ->check(CLI::IsMember({"unknown", "air", "ground"}))
      ->capture_default_str();
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
  add_bus_options(*command, *arguments);
  add_pace_options(*command, *arguments);
  command->callback([arguments, &status] { status = run_replay(*arguments); });
}

}  // namespace ridgeline::sim
