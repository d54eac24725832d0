// The unit as shipped, under a systemd that is the first process of the machine.
#include "tests/rig/service.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "tests/rig/display_fixture.hpp"
#include "tests/rig/held_thread.hpp"

namespace ridgeline::rig {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void wait(int seconds) {
  std::this_thread::sleep_for(std::chrono::seconds(seconds));
}

/// A line of a process's status, without its name.
std::string status_of(int process, const std::string& key) {
  return output_of("sed -n 's/^" + key + ":[\t ]*//p' /proc/" + std::to_string(process) +
                   "/status");
}

class RigService : public RigDisplay {
 protected:
  RigService() {
    std::filesystem::create_symlink("/run/ridgeline/status.json", installed_.file("status.json"));
    configure({});
  }
  /// What differs from cockpit.toml is the flight; where the report goes is as there.
  void configure(InstallationSettings settings) {
    settings.terrain = installed_.file("tiles");
    settings.status_file = "/run/ridgeline/status.json";
    settings.last_frame_folder = "";
    installed_.configure(settings);
    Service::configure(installed_.file("rig.toml"));
  }
  /// Starts it and a flight on the bus.
  void fly() {
    ASSERT_TRUE(Service::control("start")) << journal();
    player_ = std::make_unique<Process>(installed_.player(), installed_.file("player"));
    ASSERT_TRUE(lines_say(true, false)) << journal();
  }
  static std::string journal() { return output_of("journalctl -n 30 -o cat"); }
  /// The program that was there is gone, and another one flies.
  static bool is_another(int before) {
    const int now = Service::main_process();
    return now != 0 && now != before && Service::is("active");
  }
  /// Waits for systemd to end a program that `hangs`, and to start it again.
  void expect_ended_and_started(const char* what, int before, HeldThread* held) {
    const Clock::time_point start = Clock::now();
    const int told = service_.times_told("Failed with result 'watchdog'");
    const std::string process = "/proc/" + std::to_string(before);
    EXPECT_TRUE(within(2 * soon_s,
                       [&] {
                         if (held != nullptr) held->bury();
                         return !std::filesystem::exists(process);
                       }))
        << what << "\n"
        << journal();
    const double ended_s = seconds_since(start);
    EXPECT_TRUE(within(boot_s, [&] { return is_another(before); })) << what << "\n" << journal();
    EXPECT_EQ(service_.times_told("Failed with result 'watchdog'"), told + 1) << journal();
    EXPECT_TRUE(lines_say(true, false)) << what << "\n" << journal();
    std::printf("%s: ended after %.1f s, flies again after %.1f s\n", what, ended_s,
                seconds_since(start));
    if (is_emulated()) return;
    EXPECT_GT(ended_s, 3.0) << what;
    EXPECT_LT(ended_s, 15.0) << what << ": the unit says 5 s, a busy machine more";
  }

  Service service_;
  std::unique_ptr<Process> player_;
};

/// The configuration is a pipe, so that boot lasts as long as the test wants.
TEST_F(RigService, it_is_active_only_after_its_first_frame) {
  std::filesystem::remove(Service::configuration);
  ASSERT_EQ(::mkfifo(Service::configuration, 0644), 0);
  ASSERT_TRUE(Service::control("start --no-block"));
  const int pipe = ::open(Service::configuration, O_WRONLY);
  wait(2);
  EXPECT_TRUE(Service::is("activating"));
  const int process = Service::main_process();
  EXPECT_GT(process, 0);
  EXPECT_TRUE(Service::control("kill -s USR1")) << "a question before boot";
  std::ifstream settings(installed_.file("rig.toml"));
  const std::string text{std::istreambuf_iterator<char>(settings),
                         std::istreambuf_iterator<char>()};
  ASSERT_EQ(::write(pipe, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(pipe);
  ASSERT_TRUE(within(boot_s, [] { return !Service::is("activating"); }));
  EXPECT_TRUE(Service::is("active")) << journal();
  EXPECT_EQ(Service::main_process(), process);
  EXPECT_EQ(Service::property("StatusText").rfind("picture: removed attitude_missing", 0), 0u)
      << Service::property("StatusText");
  ASSERT_TRUE(reported([](const auto& status) { return status["frames"]["drawn"] > 0; }));
  const double frame_us = 1e3 * installed_.status()["boot_to_first_frame_ms"].get<double>();
  const double started_us = std::stod(Service::property("ExecMainStartTimestampMonotonic"));
  EXPECT_GT(std::stod(Service::property("ActiveEnterTimestampMonotonic")), started_us + frame_us);
  EXPECT_GT(frame_us, 0);
}

TEST_F(RigService, systemctl_tells_what_the_picture_is_and_the_journal_how_much_it_matters) {
  fly();
  EXPECT_EQ(Service::property("WatchdogUSec"), is_emulated() ? "1min" : "5s");
  EXPECT_EQ(Service::property("NotifyAccess"), "main");
  EXPECT_TRUE(within(soon_s, [] {
    return Service::property("StatusText").rfind("picture: degraded ", 0) == 0;
  })) << Service::property("StatusText");
  player_.reset();
  EXPECT_TRUE(within(soon_s, [] {
    return Service::property("StatusText").rfind("picture: removed attitude_stale", 0) == 0;
  })) << Service::property("StatusText");
  const std::string page = output_of("systemctl status --no-pager ridgeline-display");
  EXPECT_NE(page.find("Status: \"picture: removed attitude_stale"), std::string::npos) << page;
  EXPECT_NE(page.find("Active: active (running)"), std::string::npos) << page;
  EXPECT_GE(service_.times_told("terrain: 1 tiles", "-p 6..6"), 1) << page;
  EXPECT_GE(service_.times_told("picture: removed", "-p 4..4"), 1) << page;
  EXPECT_EQ(service_.times_told("picture: removed", "-p 3"), 0) << page;
}

TEST_F(RigService, whatever_hangs_is_killed_and_started_again) {
  fly();
  const int first = Service::main_process();
  ::kill(first, SIGSTOP);
  expect_ended_and_started("whole program", first, nullptr);
  for (const char* thread : {"render", "bus", "ridgeline-displ"}) {
    ASSERT_TRUE(Service::control("reset-failed"));  // counts starts of a minute
    const int before = Service::main_process();
    HeldThread held(before, thread);
    ASSERT_TRUE(held.holds()) << thread;
    expect_ended_and_started(thread, before, &held);
  }
  EXPECT_EQ(Service::property("NRestarts"), "1") << "since the last reset-failed";
}

TEST_F(RigService, what_boot_refuses_stays_refused) {
  const auto refused = [&](const InstallationSettings& settings, const std::string& words) {
    configure(settings);
    EXPECT_FALSE(Service::control("start")) << words;
    EXPECT_TRUE(Service::is("failed")) << words;
    wait(4);  // the unit waits for one before it starts again
    EXPECT_TRUE(Service::is("failed")) << words;
    EXPECT_EQ(Service::property("Result"), "exit-code") << words;
    EXPECT_EQ(Service::property("ExecMainStatus"), "3") << words;
    EXPECT_EQ(Service::property("NRestarts"), "0") << words;
    EXPECT_EQ(service_.times_told(words), 1) << words << "\n" << journal();
  };
  InstallationSettings wrong_key, wrong_line, wrong_bus, wrong_terrain;
  wrong_key.more = "[extra]\n";
  refused(wrong_key, "cockpit.toml:");
  wrong_line.heartbeat = "rig-no-such-line";
  refused(wrong_line, "line 'rig-no-such-line': no GPIO line has the configured name");
  wrong_bus.buses = {"rig7"};
  refused(wrong_bus, "bus 'rig7': no CAN interface has the configured name");
  wrong_terrain.geoid = "/no-geoid.pgm";
  refused(wrong_terrain, "/no-geoid.pgm: geoid file cannot be read");
  configure({});
  fly();
  EXPECT_TRUE(Service::is("active")) << "once the cause is gone, a person starts it";
}

TEST_F(RigService, a_stop_is_a_success_and_leaves_boot_levels_and_the_report) {
  fly();
  ASSERT_TRUE(Service::control("stop"));
  EXPECT_TRUE(Service::is("inactive"));
  EXPECT_EQ(Service::property("Result"), "success");
  EXPECT_EQ(Service::property("ExecMainCode"), "1") << "ended by itself";
  EXPECT_EQ(Service::property("ExecMainStatus"), "0");
  EXPECT_FALSE(chip_.value(SimulatedChip::svs_valid));
  const nlohmann::json status = installed_.status();
  ASSERT_TRUE(status.is_object()) << "the report must outlive the program";
  EXPECT_EQ(status["state"], "stopped");
  EXPECT_EQ(status["lines"]["svs_valid"], false);
  EXPECT_EQ(status["lines"]["svs_fail"], true);
  EXPECT_EQ(service_.times_told("left behind"), 0);
  EXPECT_EQ(service_.times_told("ridgeline-display.service: Deactivated successfully."), 1);
}

TEST_F(RigService, what_the_unit_grants_and_what_it_takes_away_are_in_force) {
  fly();
  EXPECT_TRUE(beats());
  const int process = Service::main_process();
  std::map<std::string, int> priorities;
  for (const auto& entry :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    const pid_t thread = std::stoi(entry.path().filename());
    sched_param parameters{};
    if (::sched_getscheduler(thread) != SCHED_FIFO) continue;
    ASSERT_EQ(::sched_getparam(thread, &parameters), 0);
    priorities[text_of(entry.path() / "comm")] = parameters.sched_priority;
  }
  EXPECT_EQ(priorities,
            (std::map<std::string, int>{{"bus", 60}, {"render", 40}, {"ridgeline-displ", 50}}));
  EXPECT_GT(std::atoi(status_of(process, "VmLck").c_str()), 10'000) << "kB locked in memory";
  for (const char* part : {"memory_lock", "bus_thread", "supervisor", "render_thread"}) {
    EXPECT_EQ(installed_.status()["real_time"][part], "granted") << part;
  }
  EXPECT_EQ(status_of(process, "NoNewPrivs"), "1");
  EXPECT_EQ(status_of(process, "CapEff"), "0000000000a05000") << "what CapabilityBoundingSet says";
  EXPECT_EQ(status_of(process, "Seccomp"), "2") << "RestrictAddressFamilies is a filter";
  const auto inside = [&](const std::string& command) {
    return shell("nsenter -m -t " + std::to_string(process) + " sh -c '" + command +
                 "' 2>/dev/null");
  };
  EXPECT_TRUE(inside("touch /run/ridgeline/mine && cd /tmp && touch mine"));
  for (const char* file : {"/etc/mine", "/usr/mine", "/var/lib/mine", "/run/mine"}) {
    EXPECT_FALSE(inside(std::string("touch ") + file)) << file;
    EXPECT_TRUE(shell(std::string("touch ") + file)) << file << ": for others it can be written";
  }
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path("/tmp") / "mine"))
      << "its folder is its own";
}

TEST_F(RigService, a_monitor_can_be_had_under_the_unit) {
  ASSERT_TRUE(std::filesystem::exists("/dev/dri/card0"));
  configure(monitor_settings());
  fly();
  EXPECT_EQ(service_.times_told("screen: kms /dev/dri/card0"), 1) << journal();
  EXPECT_TRUE(reported([](const auto& status) { return status["latency_ms"]["count"] > 0; }))
      << "no page flip has told when the picture was shown";
  EXPECT_EQ(installed_.status()["frames"]["present_faults"], 0);
}

/// A crash is no refusal: it is started again, until five starts within a minute are enough.
TEST_F(RigService, one_that_dies_again_and_again_is_given_up) {
  fly();
  int dead = 0, deaths = 0;
  const Clock::time_point start = Clock::now();
  const auto is_new_or_given_up = [&] {
    const int now = Service::main_process();
    return (now != 0 && now != dead) || Service::is("failed");
  };
  // Those after the first die while they boot, so that a slow machine takes no longer. One more is
  // needed where the first start was more than a minute before.
  while (deaths < 6) {
    ASSERT_TRUE(within(soon_s, is_new_or_given_up)) << deaths << "\n" << journal();
    if (Service::is("failed")) break;
    const int now = Service::main_process();
    if (now == 0) continue;
    dead = now;
    ::kill(dead, SIGKILL);
    ++deaths;
  }
  const double deaths_s = seconds_since(start);
  if (!within(10, [] { return Service::is("failed"); }) && deaths_s > 50) {
    GTEST_SKIP() << deaths << " deaths took this machine " << deaths_s << " s, too long to count";
  }
  EXPECT_TRUE(Service::is("failed")) << journal();
  EXPECT_GE(deaths, 5) << "it is tried again";
  wait(4);
  EXPECT_TRUE(Service::is("failed"));
  EXPECT_EQ(Service::main_process(), 0);
}

}  // namespace
}  // namespace ridgeline::rig
