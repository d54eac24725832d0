#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <optional>

#include "tests/rig/flight_process.hpp"
#include "tests/rig/line_watch.hpp"
#include "tests/rig/link.hpp"
#include "tests/rig/live_account.hpp"
#include "tests/rig/simulated_chip.hpp"
#include "tests/support/scratch_folder.hpp"

// A live run of the flight program: a log played onto a virtual bus in its own time, the heartbeat
// line watched from outside, the status report read once a second; at the end what it came to.
namespace ridgeline::rig {
namespace {

constexpr int done = 0, check_failed = 1, bad_input = 3;
constexpr int boot_limit_s = 600, terrain_limit_s = 300, end_limit_s = 60;
constexpr const char* player_name = "canplayer";

struct Arguments {
  double minutes = 1;
  std::string terrain, log, geoid = "none", screen = "surfaceless", reference = "unknown";
  std::string home = "-48.4,-123.7";
  int width_px = 320, height_px = 240;
  double rate_hz = 10, range_km = 60, error_px = 1, deadline_ms = 75;
};

/// The configuration of the run; false where `home` is no place.
bool configure(const Arguments& arguments, const std::string& file) {
  double latitude_deg = 0, longitude_deg = 0;
  char rest = 0;
  if (std::sscanf(arguments.home.c_str(), "%lf,%lf%c", &latitude_deg, &longitude_deg, &rest) != 2) {
    return false;
  }
  std::ofstream(file) << "[picture]\nwidth_px = " << arguments.width_px
                      << "\nheight_px = " << arguments.height_px
                      << "\nhorizontal_field_of_view_deg = 60\nrate_hz = " << arguments.rate_hz
                      << "\nrange_km = " << arguments.range_km
                      << "\nerror_px = " << arguments.error_px << "\n[screen]\nkind = \""
                      << arguments.screen << "\"\n[terrain]\nfolder = \"" << arguments.terrain
                      << "\"\ngeoid = \"" << arguments.geoid
                      << "\"\nhome_latitude_deg = " << latitude_deg
                      << "\nhome_longitude_deg = " << longitude_deg
                      << "\n[monitor]\ndeadline_ms = " << arguments.deadline_ms
                      << "\n[bus]\ninterfaces = [\"rig0\"]\nprotocol = \"canaerospace\"\n"
                      << "heading_reference = \"" << arguments.reference << "\"\n"
                      << "[lines]\nheartbeat = \"rig-beat\"\nsvs_valid = \"rig-valid\"\n"
                      << "svs_fail = \"rig-fail\"\ndisplay_on = \"rig-on\"\n"
                      << "[report]\nstatus_file = \"status.json\"\nstatus_interval_s = 1\n"
                      << "last_frame_folder = \"last\"\n";
  return true;
}

/// A number of KiB from /proc/ID/status, such as that of "RssAnon:".
double process_kib(pid_t id, const std::string& key) {
  std::ifstream stream("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(key)) return std::strtod(line.c_str() + key.size(), nullptr);
  }
  return 0;
}

double ms(std::int64_t time_ns) {
  return static_cast<double>(time_ns) * 1e-6;
}

std::uint64_t frames_sent(const std::string& interface) {
  std::uint64_t frames = 0;
  std::ifstream("/sys/class/net/" + interface + "/statistics/tx_packets") >> frames;
  return frames;
}

/// What runs, and what is read of it.
class LiveRun {
 public:
  LiveRun(const Arguments& arguments, const test::ScratchFolder& folder)
      : arguments_(arguments), folder_(folder) {
    chip_.pull(SimulatedChip::display_on, true);
  }

  /// Boots the flight program, then plays the log; false with a reason on standard error.
  bool begin() {
    program_.emplace(std::vector<std::string>{DISPLAY_PROGRAM, folder_.file("live.toml")},
                     folder_.file("errors"));
    if (!within(boot_limit_s,
                [&] { return program_->times_told("picture:") > 0 || !program_->runs(); }) ||
        !program_->runs()) {
      std::fprintf(stderr, "live: the flight program did not boot:\n%s\n",
                   program_->told().c_str());
      return false;
    }
    const auto gap_ns = static_cast<std::int64_t>(1.5e9 / arguments_.rate_hz);
    watch_.emplace(chip_.value_file(SimulatedChip::heartbeat), gap_ns);
    player_.emplace(std::vector<std::string>{player_name, "-I", arguments_.log, "rig0=can0"},
                    folder_.file("player"));
    if (!within(terrain_limit_s, [&] { return watch_->facts().edges > 2; })) {
      std::fprintf(stderr, "live: no heartbeat came:\n%s\n", program_->told().c_str());
      return false;
    }
    return true;
  }

  /// The next report of the program with what is seen at that moment; false when none comes.
  bool next(LiveSample& sample) {
    const bool came = within(10, [&] {
      std::ifstream stream(folder_.file("status.json"));
      const nlohmann::json status = nlohmann::json::parse(stream, nullptr, false);
      if (!status.is_object() || status.at("up_s") == told_up_s_) return false;
      told_up_s_ = status.at("up_s");
      sample = sample_of(status);
      return true;
    });
    if (came) look(sample);
    return came && program_->runs();
  }

  /// Ends the program while values still come, so that its last frame is one of the flight.
  bool end(LiveSample& last) {
    program_->signal(SIGTERM);
    const int status = program_->status(end_limit_s);
    std::ifstream stream(folder_.file("status.json"));
    last = sample_of(nlohmann::json::parse(stream));
    look(last);
    player_->signal(SIGTERM);
    player_->status(end_limit_s);
    if (status != 0) std::fprintf(stderr, "live: exit status %d\n", status);
    return status == 0;
  }

  [[nodiscard]] WatchFacts watched() const { return watch_->facts(); }
  [[nodiscard]] bool watch_goes_first() const { return watch_->goes_first(); }
  [[nodiscard]] bool player_runs() { return player_->runs(); }
  [[nodiscard]] std::string told() const { return program_->told(); }

 private:
  void look(LiveSample& sample) {
    const WatchFacts facts = watch_->facts();
    sample.edges_seen = facts.edges;
    sample.away_ms = ms(facts.away_ns);
    sample.sent = frames_sent("rig0");
    if (!program_->runs()) return;
    sample.anonymous_kib = process_kib(program_->id(), "RssAnon:");
    sample.resident_kib = process_kib(program_->id(), "VmRSS:");
  }

  const Arguments& arguments_;
  const test::ScratchFolder& folder_;
  VirtualCan bus_{"rig0"};
  SimulatedChip chip_;
  std::optional<Process> program_;
  std::optional<LineWatch> watch_;
  std::optional<Process> player_;
  double told_up_s_ = -1;
};

void print_line(const LiveSample& s, double at_s) {
  const auto wide = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf(
      "%6.0f s  %s  frames %llu: %llu late, %llu degraded, %llu removed; edges %llu, %llu seen; ",
      at_s, s.mode.c_str(), wide(s.drawn), wide(s.late), wide(s.degraded), wide(s.removed),
      wide(s.edges), wide(s.edges_seen));
  std::printf(
      "received %llu, dropped %llu; anonymous %.0f KiB; latency p50 %.2f p99 %.2f max %.1f ms; ",
      wide(s.received), wide(s.dropped), s.anonymous_kib, s.latency_p50_ms, s.latency_p99_ms,
      s.latency_max_ms);
  std::printf("frame p50 %.2f p99 %.2f ms; away %.0f ms\n", s.frame_p50_ms, s.frame_p99_ms,
              s.away_ms);
  std::fflush(stdout);
}

void print_watch(const LiveRun& run) {
  const WatchFacts facts = run.watched();
  std::printf("heartbeat line: %llu edges, longest gap %.1f ms, %zu gaps longer than 1.5 periods\n",
              static_cast<unsigned long long>(facts.edges), ms(facts.longest_gap_ns),
              facts.gaps.size());
  std::int64_t longest_ns = 0;
  for (const Stretch& stall : facts.stalls) longest_ns = std::max(longest_ns, stall.length_ns);
  std::printf(
      "the machine%s: %.0f ms without anything running, %zu times 20 ms or longer, at most %.1f "
      "ms\n",
      run.watch_goes_first() ? "" : " (or what goes before the watch)", ms(facts.away_ns),
      facts.stalls.size(), ms(longest_ns));
}

int fly(const Arguments& arguments) {
  const test::ScratchFolder folder("live");
  if (!configure(arguments, folder.file("live.toml"))) {
    std::fprintf(stderr, "live: --home %s: not of the form LAT,LON\n", arguments.home.c_str());
    return bad_input;
  }
  LiveRun run(arguments, folder);
  if (!run.begin()) return check_failed;
  std::vector<LiveSample> samples;
  LiveSample sample;
  bool good = true;
  double told_s = 0;
  const auto goes_on = [&] {
    if (samples.empty()) return true;
    const double over_s = sample.up_s - samples.front().up_s - 60 * arguments.minutes;
    // The last frame is for the oracle, so it is one with terrain.
    return over_s < 0 || (sample.mode == "removed" && over_s < end_limit_s);
  };
  while (good && goes_on()) {
    good = run.next(sample) && run.player_runs();
    // A report from before the first heartbeat is no beginning of a flight.
    if (good && samples.empty() && (sample.edges == 0 || sample.mode == "removed")) continue;
    samples.push_back(sample);
    if (const double at_s = sample.up_s - samples.front().up_s; at_s >= told_s) {
      print_line(sample, at_s);
      told_s += 60;
    }
  }
  if (!good) std::fprintf(stderr, "live: the program or the log ended before the run did\n");
  const LiveSample before = sample;
  good = run.end(sample) && good;
  sample.anonymous_kib = before.anonymous_kib;
  sample.resident_kib = before.resident_kib;
  samples.push_back(sample);
  print_line(sample, sample.up_s - samples.front().up_s);
  print_watch(run);
  std::printf("boot to the first frame %.0f ms, to the first terrain %.0f ms\n",
              sample.first_frame_ms, sample.first_terrain_ms);
  for (const Finding& finding : account(samples)) {
    std::printf("%s  %s\n", finding.good ? "good" : "BAD ", finding.text.c_str());
    good = good && finding.good;
  }
  std::printf("%s\n", run.told().c_str());
  std::fflush(stdout);
  good = shell("'" RIDGELINE_PROGRAM "' verify " + folder.file("last") + " --terrain " +
               arguments.terrain + " --geoid " + arguments.geoid + " --pixels 20000") &&
         good;
  std::printf("live: %s\n", good ? "passed" : "FAILED");
  return good ? done : check_failed;
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App program{
      "Flies the flight program from a log on a virtual bus and says what it came to."};
  program.add_option("--minutes", arguments.minutes)->check(CLI::Range(0.1, 600.0));
  program.add_option("--terrain", arguments.terrain)->required();
  program.add_option("--log", arguments.log, "candump log of can0, longer than the run")
      ->required();
  program.add_option("--geoid", arguments.geoid);
  program.add_option("--screen", arguments.screen)->check(CLI::IsMember({"surfaceless", "kms"}));
  program.add_option("--reference", arguments.reference);
  program.add_option("--home", arguments.home, "LAT,LON");
  program.add_option("--width", arguments.width_px);
  program.add_option("--height", arguments.height_px);
  program.add_option("--rate", arguments.rate_hz);
  program.add_option("--range", arguments.range_km);
  program.add_option("--error", arguments.error_px);
  program.add_option("--deadline", arguments.deadline_ms, "of a frame, ms; 0: its period");
  CLI11_PARSE(program, argc, argv);
  return fly(arguments);
}

}  // namespace
}  // namespace ridgeline::rig

int main(int argc, char** argv) {
  return ridgeline::rig::run(argc, argv);
}
