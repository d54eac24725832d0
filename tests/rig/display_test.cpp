#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/synthetic/bus_log_writer.hpp"
#include "sim/synthetic/tile_writer.hpp"
#include "tests/rig/flight_process.hpp"
#include "tests/rig/link.hpp"
#include "tests/rig/simulated_chip.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline {
namespace {

using rig::Process;
using rig::within;

// Lines of the simulated chip, by their place.
constexpr int heartbeat = 0, svs_valid = 1, svs_fail = 2, display_on = 3;
constexpr int declutter = 4, night = 5, on_ground = 6;
// An emulated machine on a busy one: nothing here is about how long things take.
constexpr int boot_s = 600, soon_s = 60;

/// Hills under a flight that turns over them, its configuration, and what it leaves behind.
class Installation {
 public:
  Installation() {
    std::filesystem::create_directories(folder_.file("tiles"));
    constexpr int posts = 1201;  // 3"
    EXPECT_TRUE(sim::write_tile_with(folder_.file("tiles"), 46, 8, posts, hills).ok());
    std::ofstream(folder_.file("flight.log")) << sim::bus_log(flight(), sim::BusGaps{});
    configure("tiles", "rig0", "rig-beat");
  }

  void configure(const std::string& terrain, const std::string& bus, const std::string& beat) {
    write(
        "[picture]\nwidth_px = 64\nheight_px = 48\nhorizontal_field_of_view_deg = 60\n"
        "rate_hz = 1\nrange_km = 8\n[screen]\nkind = \"surfaceless\"\n"
        "[timeouts]\nattitude_ms = 3000\nheading_ms = 3000\nposition_ms = 6000\n"
        "height_ms = 6000\npicture_ms = 9000\nheartbeat_input_ms = 3000\n"
        "[monitor]\ndeadline_ms = 10000\n",
        terrain, bus, beat);
  }
  /// The smallest mode of the simulated card, as slow as it has to be in emulation.
  void configure_monitor() {
    write(
        "[picture]\nwidth_px = 640\nheight_px = 480\nhorizontal_field_of_view_deg = 60\n"
        "rate_hz = 0.1\nrange_km = 4\n[screen]\nkind = \"kms\"\ncard = \"/dev/dri/card0\"\n"
        "[timeouts]\nattitude_ms = 10000\nheading_ms = 10000\nposition_ms = 10000\n"
        "height_ms = 10000\npicture_ms = 10000\nheartbeat_input_ms = 10000\n"
        "[monitor]\non = false\n",
        "tiles", "rig0", "rig-beat");
  }

  void report_every(int seconds) {
    report_s_ = seconds;
    configure("tiles", "rig0", "rig-beat");
  }

  [[nodiscard]] std::vector<std::string> program() const {
    return {DISPLAY_PROGRAM, folder_.file("rig.toml")};
  }
  /// Plays the flight again and again.
  [[nodiscard]] std::vector<std::string> player() const {
    return {"canplayer", "-l", "i", "-I", folder_.file("flight.log"), "rig0=can0"};
  }
  [[nodiscard]] nlohmann::json status() const {
    std::ifstream stream(folder_.file("status.json"));
    return nlohmann::json::parse(stream, nullptr, false);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  void write(const std::string& picture, const std::string& terrain, const std::string& bus,
             const std::string& beat) {
    std::ofstream(folder_.file("rig.toml"))
        << picture << "[terrain]\nfolder = \"" << terrain << "\"\ngeoid = \"none\"\n"
        << "home_latitude_deg = 46.5\nhome_longitude_deg = 8.5\n"
        << "[bus]\ninterfaces = [\"" << bus << "\"]\nprotocol = \"canaerospace\"\n"
        << "heading_reference = \"unknown\"\nnode_id = 12\n"
        << "[lines]\nheartbeat = \"" << beat << "\"\nsvs_valid = \"rig-valid\"\n"
        << "svs_fail = \"rig-fail\"\ndisplay_on = \"rig-on\"\n"
        << "declutter = \"rig-decl\"\nnight = \"rig-night\"\non_ground = \"rig-ground\"\n"
        << "[report]\nstatus_file = \"status.json\"\nstatus_interval_s = " << report_s_ << "\n"
        << "last_frame_folder = \"last\"\n";
  }
  int report_s_ = 1;
  static double hills(double latitude_deg, double longitude_deg) {
    return 800.0 + 300.0 * std::sin(latitude_deg * 400.0) * std::cos(longitude_deg * 300.0);
  }
  /// Straight and level, banked: 20 s of it, so that the end and the beginning are 600 m apart.
  static std::vector<sim::FlightSample> flight() {
    std::vector<sim::FlightSample> samples;
    for (int tick = 0; tick < 20 * sim::flight_ticks_per_second; ++tick) {
      sim::FlightSample sample;
      sample.time_s = static_cast<double>(tick) / sim::flight_ticks_per_second;
      sample.latitude_deg = 46.5 + sample.time_s * 1e-6;
      sample.longitude_deg = 8.5;
      sample.height_m = 1500.0;
      sample.roll_deg = 5.0;
      sample.heading_deg = 30.0;
      samples.push_back(sample);
    }
    return samples;
  }
  test::ScratchFolder folder_{"rig_display"};
};

/// Changes of the heartbeat line that are seen in so many seconds.
int edges(const rig::SimulatedChip& chip, int seconds) {
  int count = 0;
  bool level = chip.value(heartbeat);
  within(seconds, [&] {
    if (chip.value(heartbeat) != level) ++count;
    level = chip.value(heartbeat);
    return false;
  });
  return count;
}

class RigDisplay : public testing::Test {
 protected:
  bool lines_say(bool valid, bool fail) {
    return within(soon_s,
                  [&] { return chip_.value(svs_valid) == valid && chip_.value(svs_fail) == fail; });
  }
  bool booted(Process& program) {
    return within(boot_s, [&] { return program.times_told("picture:") > 0 || !program.runs(); });
  }

  rig::VirtualCan bus_{"rig0"};
  rig::SimulatedChip chip_;
  Installation installed_;
};

TEST_F(RigDisplay, a_flight_on_the_bus_is_drawn_and_a_silent_bus_is_not) {
  chip_.pull(display_on, true);
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(within(soon_s, [&] { return chip_.value(svs_fail); })) << program.told();
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_TRUE(lines_say(false, true)) << "no value was ever received";
  EXPECT_EQ(edges(chip_, 3), 0);
  {
    Process player(installed_.player(), installed_.file("player"));
    ASSERT_TRUE(lines_say(true, false)) << program.told();
    EXPECT_GE(edges(chip_, 10), 2) << program.told();
    chip_.pull(display_on, false);
    EXPECT_TRUE(lines_say(false, false)) << "switched off is not failed";
    chip_.pull(display_on, true);
    EXPECT_TRUE(lines_say(true, false));
    bus_.down();
    EXPECT_TRUE(lines_say(false, true)) << program.told();
    EXPECT_EQ(program.times_told("bus rig0: the CAN interface is down"), 1);
    bus_.up();
  }
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  player.signal(SIGSTOP);
  ASSERT_TRUE(lines_say(false, true)) << program.told();
  EXPECT_EQ(edges(chip_, 4), 0) << "a silent bus must end the heartbeat";
  EXPECT_EQ(installed_.status()["frames"]["mode"], "removed") << program.told();
  player.signal(SIGCONT);
  ASSERT_TRUE(lines_say(true, false)) << program.told();

  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
  EXPECT_FALSE(chip_.value(svs_valid));
  const nlohmann::json status = installed_.status();
  EXPECT_EQ(status["state"], "stopped");
  EXPECT_EQ(status["real_time"]["allocations_after_boot"], 0);
  EXPECT_EQ(status["real_time"]["gl_creations_after_boot"], 0);
  EXPECT_EQ(status["bus"]["interfaces"][0]["link_downs"], 1);
  EXPECT_GT(status["latency_ms"]["count"], 0);
  EXPECT_GT(status["lines"]["heartbeat_edges"], 2);
  EXPECT_GT(status["boot_to_first_frame_ms"], 0.0);
  EXPECT_TRUE(rig::shell(std::string(RIDGELINE_PROGRAM) + " verify " + installed_.file("last") +
                         " --terrain " + installed_.file("tiles") + " --pixels all"))
      << "the last frame must keep its promise";
  std::cout << status.dump(1) << "\n" << program.told();
}

TEST_F(RigDisplay, switches_change_the_picture_and_the_report_says_so) {
  chip_.pull(display_on, true);
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(booted(program)) << program.told();
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  const auto display_says = [&](double luminance, bool fewer, const char* wheels) {
    return within(soon_s, [&] {
      const nlohmann::json status = installed_.status();
      return status.is_object() && status["display"]["luminance"] == luminance &&
             status["display"]["declutter"] == fewer && status["display"]["air_ground"] == wheels;
    });
  };
  EXPECT_TRUE(display_says(1.0, false, "air"));
  chip_.pull(night, true);
  EXPECT_TRUE(display_says(0.15, false, "air"));
  chip_.pull(declutter, true);
  chip_.pull(on_ground, true);
  EXPECT_TRUE(display_says(0.15, true, "ground"));
  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
  EXPECT_EQ(program.times_told("night: switched on"), 1) << program.told();
  std::ifstream stream(installed_.file("last") + "/000000.json");
  const nlohmann::json last = nlohmann::json::parse(stream, nullptr, false);
  EXPECT_EQ(last["display"]["luminance"], 0.15);
  EXPECT_EQ(last["display"]["declutter"], true);
}

/// SIGUSR1 asks for a report at once, where no interval gives one.
TEST_F(RigDisplay, a_report_is_written_when_it_is_asked_for) {
  installed_.report_every(0);
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_FALSE(std::filesystem::exists(installed_.file("status.json")));
  program.signal(SIGUSR1);
  ASSERT_TRUE(within(soon_s, [&] { return installed_.status().is_object(); })) << program.told();
  const nlohmann::json first = installed_.status();
  EXPECT_EQ(first["state"], "running");
  program.signal(SIGUSR1);
  EXPECT_TRUE(within(soon_s, [&] {
    const nlohmann::json next = installed_.status();
    return next.is_object() && next["up_s"] > first["up_s"];
  }));
  EXPECT_TRUE(program.runs()) << "a question does not end the flight";
  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
}

TEST_F(RigDisplay, a_chip_lost_in_flight_stops_the_heartbeat_and_the_flight_goes_on) {
  chip_.pull(display_on, true);
  Process program(installed_.program(), installed_.file("errors"));
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(booted(program)) << program.told();
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  chip_.vanish();
  EXPECT_TRUE(within(soon_s, [&] { return program.times_told("lines: a GPIO line") == 1; }));
  EXPECT_TRUE(within(soon_s, [&] {
    const nlohmann::json status = installed_.status();
    return status.is_object() && status["lines"]["line_lost"] == true;
  }));
  EXPECT_TRUE(program.runs());
  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
}

TEST_F(RigDisplay, a_monitor_shows_the_flight) {
  if (!std::filesystem::exists("/dev/dri/card0")) GTEST_SKIP() << "this kernel has no card";
  installed_.configure_monitor();
  chip_.pull(display_on, true);
  Process program(installed_.program(), installed_.file("errors"));
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_EQ(program.times_told("screen: kms /dev/dri/card0"), 1) << program.told();
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(within(soon_s, [&] {
    const nlohmann::json status = installed_.status();
    return status.is_object() && status["latency_ms"]["count"] > 0;
  })) << "no page flip has told when the picture was shown";
  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
  EXPECT_EQ(installed_.status()["frames"]["present_faults"], 0) << program.told();
  std::cout << program.told();
}

void expect_refused(const Installation& installed, const std::string& words) {
  Process program(installed.program(), installed.file("errors"));
  EXPECT_EQ(program.status(soon_s), 3) << program.told();
  EXPECT_EQ(program.times_told("ridgeline-display: "), 1) << program.told();
  EXPECT_EQ(program.times_told(words), 1) << program.told();
}

TEST_F(RigDisplay, what_is_missing_at_boot_is_refused_by_name) {
  installed_.configure("tiles", "rig0", "rig-no-such-line");
  expect_refused(installed_, "line 'rig-no-such-line': no GPIO line has the configured name");
  installed_.configure("tiles", "rig7", "rig-beat");
  expect_refused(installed_, "bus 'rig7': no CAN interface has the configured name");
  installed_.configure("no-tiles", "rig0", "rig-beat");
  expect_refused(installed_, "no-tiles: folder cannot be read");
}

}  // namespace
}  // namespace ridgeline
