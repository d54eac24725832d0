#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ridgeline::rig {

/// What was known at one moment of a live run: counters of the flight program's status report, and
/// what was seen from outside.
struct LiveSample {
  double up_s = 0;  ///< since the program began, by its own report
  std::string mode;
  std::vector<std::string> reasons;
  std::uint64_t drawn = 0, late = 0, degraded = 0, removed = 0, present_faults = 0;
  std::uint64_t edges = 0, picture_stalls = 0;
  std::map<std::string, std::uint64_t> refused;   ///< heartbeats, by reason
  std::map<std::string, std::uint64_t> overruns;  ///< by cause
  std::uint64_t sheds = 0, late_finishes = 0;
  std::uint64_t received = 0, dropped = 0, decoded = 0, ignored = 0, replayed = 0;
  std::uint64_t allocations = 0, gl_creations = 0, log_dropped = 0;
  double latency_p50_ms = 0, latency_p99_ms = 0, latency_max_ms = 0;
  std::uint64_t latency_count = 0;
  double frame_p50_ms = 0, frame_p99_ms = 0, frame_max_ms = 0;
  double first_frame_ms = 0, first_terrain_ms = 0;
  // from outside
  std::uint64_t edges_seen = 0;  ///< of the heartbeat line
  double away_ms = 0;            ///< time in which nothing ran on the machine, together
  std::uint64_t sent = 0;        ///< frames that went over the bus
  double anonymous_kib = 0, resident_kib = 0;
};

/// The part of a sample that a status report has.
/// Domain: `status` is a report of ridgeline-display; what it lacks throws.
[[nodiscard]] LiveSample sample_of(const nlohmann::json& status);

/// One question about a run, its answer in words, and whether that is good.
struct Finding {
  bool good = false;
  std::string text;
};

/// What a run came to, between its first and its last sample. A heartbeat that did not come has a
/// cause where the machine stood still about then, where the frame overran for one that the program
/// names, or where the program gave the terrain up for time, which it says as well.
/// Domain: two samples at least, in order of time, the first with terrain in the picture.
[[nodiscard]] std::vector<Finding> account(const std::vector<LiveSample>& samples);

}  // namespace ridgeline::rig
