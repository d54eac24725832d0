#include "config/limits_bus.hpp"
#include "tests/rig/display_fixture.hpp"

namespace ridgeline::rig {
namespace {

constexpr const char* pitch = "137";
constexpr const char* roll = "138";
constexpr const char* heading = "46D";
constexpr const char* latitude = "40C";
constexpr const char* longitude = "40D";
constexpr const char* height = "40E";
constexpr std::size_t header_digits = 8;  // of a CANaerospace frame: node, type, service, code

bool is_one_of(const std::string& id, std::initializer_list<const char*> ids) {
  return std::any_of(ids.begin(), ids.end(), [&](const char* one) { return id == one; });
}

/// What a sender does wrong, and the word that takes the terrain away for it.
struct BadLog {
  const char* reason;
  FrameEdit edit;
};

void value_becomes(std::string& data, const char* digits) {
  data.replace(header_digits, std::string::npos, digits);
}

const BadLog bad_logs[] = {
    {"attitude_stale",
     [](const std::string& id, std::string&) {
       return !is_one_of(id, {pitch, roll});
     }},
    {"heading_stale", [](const std::string& id, std::string&) { return id != heading; }},
    {"position_stale",
     [](const std::string& id, std::string&) {
       return !is_one_of(id, {latitude, longitude});
     }},
    {"height_stale", [](const std::string& id, std::string&) { return id != height; }},
    {"attitude_invalid",  // no number
     [](const std::string& id, std::string& data) {
       if (id == pitch) value_becomes(data, "7FC00000");
       return true;
     }},
    {"attitude_stale",  // a byte short: not read
     [](const std::string& id, std::string& data) {
       if (id == roll) data.resize(data.size() - 2);
       return true;
     }},
    {"heading_stale",  // a whole number where the table has a fraction: not read
     [](const std::string& id, std::string& data) {
       if (id == heading) data.replace(2, 2, "04");
       return true;
     }},
    {"height_invalid",  // 1,000,000 m
     [](const std::string& id, std::string& data) {
       if (id == height) value_becomes(data, "49742400");
       return true;
     }},
    {"position_invalid",  // what receivers without a fix send
     [](const std::string& id, std::string& data) {
       if (is_one_of(id, {latitude, longitude})) value_becomes(data, "00000000");
       return true;
     }},
};

TEST_F(RigDisplay, each_fault_of_a_value_takes_the_terrain_away_with_its_word) {
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(booted(program)) << program.told();
  const auto fly_well = [&] {
    const Process player(installed_.player(), installed_.file("player"));
    EXPECT_TRUE(lines_say(true, false)) << program.told();
  };
  const auto fly_badly = [&](const std::string& log, const char* reason) {
    const Process player(installed_.player("rig0", log), installed_.file("player"));
    EXPECT_TRUE(picture_is("removed", reason)) << reason << "\n" << program.told();
    EXPECT_TRUE(lines_are(false, true)) << reason;
    EXPECT_TRUE(is_still()) << reason;
  };
  for (const BadLog& bad : bad_logs) {
    fly_well();
    installed_.write_log("bad.log", bad.edit);
    fly_badly("bad.log", bad.reason);
  }
  fly_well();
  installed_.write_log("bad.log", 46.6, 1500.0, 5.0);  // 11 km further, which no speed explains
  {
    const std::uint64_t refused = installed_.status()["bus"]["implausible"];
    const Process player(installed_.player("rig0", "bad.log"), installed_.file("player"));
    EXPECT_TRUE(reported([&](const nlohmann::json& status) {
      return status["bus"]["implausible"] >= refused + limits::position_persist_count - 1;
    })) << program.told();
    // For half a second: at one picture a second it may be none that is drawn without the position.
    const bool seen = tells(program, "picture: removed position_implausible");
    EXPECT_TRUE(seen || is_emulated()) << program.told();
    EXPECT_TRUE(tells(program, "jump_believed")) << program.told();
    EXPECT_TRUE(lines_say(true, false)) << program.told();
  }
  expect_stopped(program);
}

TEST_F(RigDisplay, without_terrain_below_the_eye_nothing_is_drawn) {
  const auto fly = [&](double latitude_deg, double height_m, const char* reason) {
    installed_.write_log("bad.log", latitude_deg, height_m, 5.0);
    Process program(installed_.program(), installed_.file("errors"));
    const Process player(installed_.player("rig0", "bad.log"), installed_.file("player"));
    ASSERT_TRUE(booted(program)) << program.told();
    EXPECT_TRUE(picture_is("removed", reason)) << reason << "\n" << program.told();
    EXPECT_TRUE(lines_are(false, true)) << reason;
    EXPECT_TRUE(is_still()) << reason;
    EXPECT_EQ(program.times_told("heartbeat: beats"), 0) << reason;
    expect_stopped(program);
  };
  fly(48.5, 1500.0, "terrain_missing");
  fly(46.5, 300.0, "below_terrain");
}

TEST_F(RigDisplay, two_buses_carry_each_other_and_are_compared) {
  const VirtualCan second_bus("rig1");
  InstallationSettings settings;
  settings.buses = {"rig0", "rig1"};
  installed_.configure(settings);
  installed_.write_log("banked.log", 46.5, 1500.0, 25.0);
  Process program(installed_.program(), installed_.file("errors"));
  ASSERT_TRUE(booted(program)) << program.told();
  const Process second(installed_.player("rig1"), installed_.file("second player"));
  {
    const Process first(installed_.player("rig0"), installed_.file("player"));
    ASSERT_TRUE(lines_say(true, false)) << program.told();
    ASSERT_TRUE(reported([](const auto& status) {
      const auto& interfaces = status["bus"]["interfaces"];
      return interfaces[0]["frames"] > 100 && interfaces[1]["frames"] > 100;
    }));
    EXPECT_TRUE(lines_are(true, false)) << program.told();
    bus_.down();
    EXPECT_TRUE(tells(program, "bus rig0: the CAN interface is down"));
  }
  EXPECT_TRUE(beats());
  EXPECT_TRUE(lines_are(true, false)) << program.told();
  EXPECT_EQ(program.times_told("_stale"), 0) << program.told();
  bus_.up();
  const Process third(installed_.player("rig0", "banked.log"), installed_.file("player"));
  EXPECT_TRUE(picture_is("removed", "attitude_disagrees")) << program.told();
  EXPECT_TRUE(lines_are(false, true));
  EXPECT_TRUE(is_still());
  expect_stopped(program);
}

}  // namespace
}  // namespace ridgeline::rig
