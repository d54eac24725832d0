#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/rig/display_fixture.hpp"
#include "tests/rig/held_thread.hpp"

namespace ridgeline::rig {
namespace {

TEST_F(RigDisplay, a_flight_on_the_bus_is_drawn_and_a_silent_bus_is_not) {
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(within(soon_s, [&] { return chip_.value(SimulatedChip::svs_fail); }))
      << program.told();
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_TRUE(lines_say(false, true)) << "no value was ever received";
  EXPECT_TRUE(is_still());
  {
    Process player(installed_.player(), installed_.file("player"));
    ASSERT_TRUE(lines_say(true, false)) << program.told();
    EXPECT_TRUE(beats()) << program.told();
    chip_.pull(SimulatedChip::display_on, false);
    EXPECT_TRUE(lines_say(false, false)) << "switched off is not failed";
    chip_.pull(SimulatedChip::display_on, true);
    EXPECT_TRUE(lines_say(true, false));
    bus_.down();
    EXPECT_TRUE(lines_say(false, true)) << program.told();
    EXPECT_TRUE(tells(program, "bus rig0: the CAN interface is down")) << program.told();
    bus_.up();
  }
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  player.signal(SIGSTOP);
  ASSERT_TRUE(lines_say(false, true)) << program.told();
  EXPECT_TRUE(is_still()) << "a silent bus must end the heartbeat";
  EXPECT_TRUE(picture_is("removed", "attitude_stale")) << program.told();
  player.signal(SIGCONT);
  ASSERT_TRUE(lines_say(true, false)) << program.told();

  expect_stopped(program);
  const nlohmann::json status = installed_.status();
  EXPECT_EQ(program.times_told("bus rig0: the CAN interface is down"), 1);
  EXPECT_EQ(status["bus"]["interfaces"][0]["link_downs"], 1);
  EXPECT_GT(status["latency_ms"]["count"], 0);
  EXPECT_GT(status["lines"]["heartbeat_edges"], 2);
  EXPECT_GT(status["boot_to_first_frame_ms"], 0.0);
  EXPECT_TRUE(rig::shell("'" RIDGELINE_PROGRAM "' verify " + installed_.file("last") +
                         " --terrain " + installed_.file("tiles") + " --pixels all"))
      << "the last frame must keep its promise";
  std::cout << status.dump(1) << "\n" << program.told();
}

TEST_F(RigDisplay, switches_change_the_picture_and_the_report_says_so) {
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(booted(program)) << program.told();
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  const auto display_says = [&](double luminance, bool fewer, const char* wheels) {
    return reported([&](const nlohmann::json& status) {
      return status["display"]["luminance"] == luminance &&
             status["display"]["declutter"] == fewer && status["display"]["air_ground"] == wheels;
    });
  };
  EXPECT_TRUE(display_says(1.0, false, "air"));
  chip_.pull(SimulatedChip::night, true);
  EXPECT_TRUE(display_says(0.15, false, "air"));
  chip_.pull(SimulatedChip::declutter, true);
  chip_.pull(SimulatedChip::on_ground, true);
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
  InstallationSettings settings;
  settings.status_interval_s = 0;
  installed_.configure(settings);
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_FALSE(std::filesystem::exists(installed_.file("status.json")));
  program.signal(SIGUSR1);
  ASSERT_TRUE(reported([](const nlohmann::json&) { return true; })) << program.told();
  const nlohmann::json first = installed_.status();
  EXPECT_EQ(first["state"], "running");
  program.signal(SIGUSR1);
  EXPECT_TRUE(reported([&](const nlohmann::json& next) { return next["up_s"] > first["up_s"]; }));
  EXPECT_TRUE(program.runs()) << "a question does not end the flight";
  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
}

TEST_F(RigDisplay, a_chip_lost_in_flight_stops_the_heartbeat_and_the_flight_goes_on) {
  // Half a tile beside the good one: refused and told, for as long as the flight lasts.
  std::ofstream(installed_.file("tiles/N46E009.hgt")) << std::string(1'000'000, '\1');
  Process program(installed_.program(), installed_.file("errors"));
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(booted(program)) << program.told();
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(picture_is("degraded", "tile_refused")) << program.told();
  {
    Process second(installed_.program(), installed_.file("errors of the second"));
    EXPECT_EQ(second.status(soon_s), 3);
    EXPECT_EQ(second.times_told("line 'rig-"), 1) << second.told();
    EXPECT_EQ(second.times_told("another program holds the GPIO line"), 1) << second.told();
  }
  EXPECT_TRUE(beats()) << "the first has its lines still";
  chip_.vanish();
  EXPECT_TRUE(tells(program, "lines: a GPIO line"));
  EXPECT_TRUE(reported([](const auto& status) { return status["lines"]["line_lost"] == true; }));
  EXPECT_TRUE(program.runs());
  program.signal(SIGTERM);
  EXPECT_EQ(program.status(soon_s), 0) << program.told();
  EXPECT_EQ(program.times_told("lines: a GPIO line"), 1) << program.told();
}

TEST_F(RigDisplay, a_thread_that_hangs_ends_the_heartbeat_and_fails) {
  InstallationSettings settings;
  settings.status_interval_s = 0;  // only when asked
  installed_.configure(settings);
  Process program(installed_.program(), installed_.file("errors"));
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(booted(program)) << program.told();
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  {
    const HeldThread render(program.id(), "render");
    ASSERT_TRUE(render.holds());
    EXPECT_TRUE(lines_say(false, true)) << program.told();
    EXPECT_TRUE(is_still());
    EXPECT_TRUE(tells(program, "picture: no new frame for"));
  }
  EXPECT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(beats());
  {
    const HeldThread bus(program.id(), "bus");
    ASSERT_TRUE(bus.holds());
    EXPECT_TRUE(lines_say(false, true)) << program.told();
    EXPECT_TRUE(is_still());
    EXPECT_TRUE(tells(program, "picture: removed attitude_stale heading_stale")) << program.told();
  }
  EXPECT_TRUE(lines_say(true, false)) << program.told();

  EXPECT_FALSE(installed_.status().is_object()) << "nobody asked";
  program.signal(SIGUSR1);
  EXPECT_TRUE(reported([](const auto& status) {
    return status["state"] == "running" && status["lines"]["picture_stalls"] >= 1;
  }));
  expect_stopped(program);
}

TEST_F(RigDisplay, a_monitor_shows_the_flight) {
  if (!std::filesystem::exists("/dev/dri/card0")) GTEST_SKIP() << "this kernel has no card";
  installed_.configure(monitor_settings());
  Process program(installed_.program(), installed_.file("errors"));
  Process player(installed_.player(), installed_.file("player"));
  ASSERT_TRUE(booted(program)) << program.told();
  EXPECT_EQ(program.times_told("screen: kms /dev/dri/card0"), 1) << program.told();
  ASSERT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(reported([](const auto& status) { return status["latency_ms"]["count"] > 0; }))
      << "no page flip has told when the picture was shown";
  EXPECT_EQ(installed_.status()["frames"]["present_faults"], 0) << program.told();

  const std::string connector = "/sys/class/drm/card0-Virtual-1/status";
  put(connector, "off");
  EXPECT_TRUE(lines_say(false, true)) << program.told();
  EXPECT_TRUE(tells(program, "screen: no monitor is connected")) << program.told();
  put(connector, "detect");
  EXPECT_TRUE(lines_say(true, false)) << program.told();
  EXPECT_TRUE(beats());
  expect_stopped(program);
  std::cout << program.told();
}

TEST_F(RigDisplay, what_is_missing_at_boot_is_refused_by_name) {
  const auto refused = [&](const auto& change, const std::string& words) {
    InstallationSettings settings;
    change(settings);
    installed_.configure(settings);
    Process program(installed_.program(), installed_.file("errors"));
    EXPECT_EQ(program.status(soon_s), 3) << program.told();
    EXPECT_EQ(program.times_told("ridgeline-display: "), 1) << program.told();
    EXPECT_EQ(program.times_told(words), 1) << words << "\n" << program.told();
  };
  refused([](auto& s) { s.heartbeat = "rig-no-such-line"; },
          "line 'rig-no-such-line': no GPIO line has the configured name");
  refused([](auto& s) { s.buses = {"rig7"}; },
          "bus 'rig7': no CAN interface has the configured name");
  refused([](auto& s) { s.terrain = "no-tiles"; }, "no-tiles: folder cannot be read");
  refused([](auto& s) { s.geoid = "no-geoid.pgm"; }, "no-geoid.pgm: geoid file cannot be read");
  refused([](auto& s) { s.more = "[extra]\n"; }, "rig.toml:");
  refused([](auto& s) { s.screen = "kms", s.card = "/dev/dri/card7"; }, "/dev/dri/card7");
}

}  // namespace
}  // namespace ridgeline::rig
