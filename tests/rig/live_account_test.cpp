#include "tests/rig/live_account.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ridgeline::rig {
namespace {

/// Ten frames a second, each with a heartbeat, on a bus of 300 frames a second.
std::vector<LiveSample> good_run() {
  std::vector<LiveSample> samples;
  for (std::uint64_t second = 0; second < 120; ++second) {
    LiveSample s;
    s.up_s = 5.0 + static_cast<double>(second);
    s.mode = "svs";
    s.drawn = 10 * second;
    s.edges = s.edges_seen = 10 * second;
    s.refused = {{"bound_missing", 3}, {"finished_late", 0}};
    s.overruns = {{"cast", 0}, {"machine", 0}};
    s.received = s.sent = s.decoded = 300 * second;
    s.anonymous_kib = second < 30 ? 90'000 + 100 * static_cast<double>(second) : 93'000;
    s.latency_count = 10 * second;
    s.latency_p99_ms = 40;
    samples.push_back(s);
  }
  return samples;
}

bool passed(const std::vector<LiveSample>& samples) {
  const std::vector<Finding> findings = account(samples);
  return std::all_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.good; });
}

/// From second 60 on, ten frames' heartbeats are refused.
std::vector<LiveSample> with_refused(const std::string& reason) {
  std::vector<LiveSample> samples = good_run();
  for (std::size_t second = 60; second < samples.size(); ++second) {
    samples[second].refused[reason] += 10;
    samples[second].edges -= 10;
    samples[second].edges_seen -= 10;
  }
  return samples;
}

TEST(LiveAccount, of_a_run_without_a_fault_is_good) {
  EXPECT_TRUE(passed(good_run()));
}

TEST(LiveAccount, names_each_thing_that_must_not_be) {
  const auto with = [](const auto& change) {
    std::vector<LiveSample> samples = good_run();
    change(samples.back());
    return passed(samples);
  };
  EXPECT_FALSE(with([](LiveSample& s) { s.allocations = 1; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.gl_creations = 1; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.drawn += 2; })) << "frames that were never judged";
  EXPECT_FALSE(with([](LiveSample& s) { s.edges_seen -= 3; })) << "edges that were not on the line";
  EXPECT_FALSE(with([](LiveSample& s) { s.present_faults = 1; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.log_dropped = 1; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.dropped = 1; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.sent += 100; })) << "frames that nobody received";
  EXPECT_FALSE(with([](LiveSample& s) { s.anonymous_kib += 600; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.latency_p99_ms = 101; }));
  EXPECT_FALSE(with([](LiveSample& s) { s.mode = "removed"; }));
}

TEST(LiveAccount, asks_for_the_cause_of_each_heartbeat_that_did_not_come) {
  EXPECT_FALSE(passed(with_refused("finished_late")));
  EXPECT_FALSE(passed(with_refused("bound_missing")));

  std::vector<LiveSample> stalled = with_refused("finished_late");
  std::vector<LiveSample> overrun = stalled, elsewhere = stalled, fewer = stalled;
  for (std::size_t second = 60; second < stalled.size(); ++second) {
    stalled[second].away_ms = 400;
    overrun[second].overruns["cast"] = 10;
    fewer[second].overruns["cast"] = 9;
  }
  for (std::size_t second = 70; second < elsewhere.size(); ++second) {
    elsewhere[second].away_ms = 400;
  }
  EXPECT_TRUE(passed(stalled));
  EXPECT_TRUE(passed(overrun));
  EXPECT_FALSE(passed(fewer));
  EXPECT_FALSE(passed(elsewhere)) << "the machine stood still ten seconds later";

  std::vector<LiveSample> given_up = with_refused("bound_missing");
  given_up[60].reasons = {"overload"};
  EXPECT_TRUE(passed(given_up));
}

TEST(LiveAccount, reads_a_report_of_the_flight_program) {
  const nlohmann::json interface = {{"frames", 20}, {"dropped", 1}};
  const nlohmann::json times = {{"count", 4}, {"p50", 1.0}, {"p99", 2.0}, {"max", 3.0}};
  const nlohmann::json status = {
      {"up_s", 7.5},
      {"boot_to_first_frame_ms", 900.0},
      {"boot_to_first_terrain_ms", nullptr},
      {"frames",
       {{"drawn", 5},
        {"late", 1},
        {"degraded", 2},
        {"removed", 3},
        {"present_faults", 0},
        {"mode", "removed"},
        {"reasons", {"overload"}}}},
      {"latency_ms", times},
      {"frame_ms", times},
      {"monitor", {{"overruns", {{"cast", 6}}}, {"sheds", 1}, {"late_finishes", 0}}},
      {"bus", {{"interfaces", {interface, interface}}, {"decoded", 30}, {"ignored", 8}}},
      {"integrity", {{"replayed", 2}}},
      {"lines",
       {{"heartbeat_edges", 9},
        {"picture_stalls", 0},
        {"heartbeat_refused", {{"input_stale", 4}}}}},
      {"real_time", {{"allocations_after_boot", 0}, {"gl_creations_after_boot", 0}}},
      {"log", {{"dropped", 0}}}};
  const LiveSample sample = sample_of(status);
  EXPECT_EQ(sample.up_s, 7.5);
  EXPECT_EQ(sample.mode, "removed");
  EXPECT_EQ(sample.reasons, std::vector<std::string>{"overload"});
  EXPECT_EQ(sample.received, 40u);
  EXPECT_EQ(sample.dropped, 2u);
  EXPECT_EQ(sample.refused.at("input_stale"), 4u);
  EXPECT_EQ(sample.overruns.at("cast"), 6u);
  EXPECT_EQ(sample.first_terrain_ms, 0);
  EXPECT_EQ(sample.latency_max_ms, 3.0);
  nlohmann::json without = status;
  without.erase("lines");
  EXPECT_THROW(static_cast<void>(sample_of(without)), nlohmann::json::exception);
}

}  // namespace
}  // namespace ridgeline::rig
