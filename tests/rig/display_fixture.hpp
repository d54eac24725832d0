#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <string>

#include "tests/rig/flight_process.hpp"
#include "tests/rig/installation.hpp"
#include "tests/rig/link.hpp"
#include "tests/rig/simulated_chip.hpp"

namespace ridgeline::rig {

// An emulated machine on a busy one: nothing here is about how long things take.
inline constexpr int boot_s = 600, soon_s = 60;

/// The whole flight program on a bus, with lines that are read back.
class RigDisplay : public testing::Test {
 protected:
  RigDisplay() { chip_.pull(SimulatedChip::display_on, true); }

  /// Levels of the heartbeat that follow each other: until there were so many, or the time is over.
  int edges(int seconds, int most) const {
    int count = 0;
    bool level = chip_.value(SimulatedChip::heartbeat);
    within(seconds, [&] {
      if (chip_.value(SimulatedChip::heartbeat) != level) ++count;
      level = chip_.value(SimulatedChip::heartbeat);
      return count >= most;
    });
    return count;
  }
  bool beats() const { return edges(soon_s, 2) == 2; }
  /// For three frames.
  bool is_still() const { return edges(is_emulated() ? 4 : 1, 1) == 0; }
  bool lines_say(bool valid, bool fail) const {
    return within(soon_s, [&] { return lines_are(valid, fail); });
  }
  bool lines_are(bool valid, bool fail) const {
    return chip_.value(SimulatedChip::svs_valid) == valid &&
           chip_.value(SimulatedChip::svs_fail) == fail;
  }
  static bool booted(Process& program) {
    return within(boot_s, [&] { return program.times_told("picture:") > 0 || !program.runs(); });
  }
  static bool tells(Process& program, const std::string& text) {
    return within(soon_s, [&] { return program.times_told(text) > 0; });
  }
  /// Whether a status report comes of which it is true.
  bool reported(const std::function<bool(const nlohmann::json&)>& is_so) const {
    return within(soon_s, [&] {
      const nlohmann::json status = installed_.status();
      return status.is_object() && is_so(status);
    });
  }
  /// Whether the picture comes to be this one, with this reason first.
  bool picture_is(const std::string& mode, const std::string& reason) const {
    const nlohmann::json before = installed_.status();  // may tell of what was before
    return reported([&](const nlohmann::json& status) {
      const nlohmann::json& frames = status["frames"];
      const bool is_new = !before.is_object() || before["up_s"] != status["up_s"];
      return is_new && frames["mode"] == mode && !frames["reasons"].empty() &&
             frames["reasons"][0] == reason;
    });
  }
  void expect_stopped(Process& program) const {
    program.signal(SIGTERM);
    EXPECT_EQ(program.status(soon_s), 0) << program.told();
    EXPECT_FALSE(chip_.value(SimulatedChip::svs_valid));
    const nlohmann::json status = installed_.status();
    EXPECT_EQ(status["state"], "stopped");
    EXPECT_EQ(status["real_time"]["allocations_after_boot"], 0);
    EXPECT_EQ(status["real_time"]["gl_creations_after_boot"], 0);
  }

  VirtualCan bus_{"rig0"};
  SimulatedChip chip_;
  Installation installed_;
};

}  // namespace ridgeline::rig
