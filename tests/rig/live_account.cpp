#include "tests/rig/live_account.hpp"

#include <algorithm>

#include "sim/output/formatted.hpp"

namespace ridgeline::rig {
namespace {

using Json = nlohmann::json;
using sim::formatted;
using Counts = std::map<std::string, std::uint64_t>;

constexpr double latency_limit_ms = 100;
constexpr double flat_kib = 512;  // what a thread's stack or a driver's cache may still take
constexpr double still_ms = 10;   // of standing still in a second that may cost a frame its time
constexpr double settled_s = 60;  // caches of the driver and the terrain have filled by then
constexpr std::size_t at_the_end = 2;  // edges that the last report and the last look may be apart

double number(const Json& value) {
  return value.is_null() ? 0.0 : value.get<double>();
}

std::uint64_t sum(const Counts& counts) {
  std::uint64_t all = 0;
  for (const auto& [name, count] : counts) all += count;
  return all;
}

Counts since(const Counts& before, const Counts& now) {
  Counts grown;
  for (const auto& [name, count] : now) {
    const auto was = before.find(name);
    const std::uint64_t more = count - (was == before.end() ? 0 : was->second);
    if (more > 0) grown[name] = more;
  }
  return grown;
}

std::string words(const Counts& counts) {
  std::string all;
  for (const auto& [name, count] : counts) {
    all += (all.empty() ? "" : ", ") + name + " " + std::to_string(count);
  }
  return all.empty() ? "none" : all;
}

unsigned long long wide(std::uint64_t value) {
  return value;
}

Finding memory(const LiveSample& a, const LiveSample& b, const std::vector<LiveSample>& samples) {
  const auto settled = std::find_if(samples.begin(), samples.end(), [&](const LiveSample& sample) {
    return sample.up_s >= a.up_s + settled_s;
  });
  const LiveSample& from = settled == samples.end() ? a : *settled;
  const double grown_kib = b.anonymous_kib - from.anonymous_kib;
  return {
      grown_kib <= flat_kib,
      formatted("memory: anonymous %.0f KiB at %.0f s, %.0f KiB at the end: %+.0f; resident with "
                "files %.0f, then %.0f",
                from.anonymous_kib, from.up_s, b.anonymous_kib, grown_kib, from.resident_kib,
                b.resident_kib)};
}

Finding allocations(const LiveSample& b) {
  return {b.allocations == 0 && b.gl_creations == 0,
          formatted("allocations after boot: %llu, of GL objects %llu", wide(b.allocations),
                    wide(b.gl_creations))};
}

/// Totals: the log begins and ends within what the samples span, and so does the interface.
Finding bus(const LiveSample& b) {
  const std::uint64_t taken = b.decoded + b.ignored + b.replayed;
  // The bus goes on between the report and the count of the kernel: some rounds of the bus.
  const std::uint64_t accounted = b.received + b.dropped;
  const bool all_there = b.sent >= accounted && b.sent - accounted <= 64;
  return {
      b.dropped == 0 && all_there,
      formatted(
          "bus: %llu frames sent, %llu received, %llu dropped by the kernel; %llu of them values, "
          "%llu not in the table, %llu replayed; %llu otherwise refused",
          wide(b.sent), wide(b.received), wide(b.dropped), wide(b.decoded), wide(b.ignored),
          wide(b.replayed), wide(b.received - std::min(b.received, taken)))};
}

bool says(const LiveSample& sample, const char* reason) {
  return std::find(sample.reasons.begin(), sample.reasons.end(), reason) != sample.reasons.end();
}

/// Refused heartbeats of one interval that nothing is known to have caused. Causes count from one
/// interval before: a report may be made between a frame and its judgement.
std::uint64_t without_cause(const LiveSample& before, const LiveSample& a, const LiveSample& b,
                            Counts& causes) {
  const Counts refused = since(a.refused, b.refused);
  std::uint64_t open = sum(refused);
  if (open == 0) return 0;
  if (b.away_ms - before.away_ms >= still_ms) {
    causes["the machine stood still"] += open;
    return 0;
  }
  if (const auto late = refused.find("finished_late"); late != refused.end()) {
    for (const auto& [name, count] : since(before.overruns, b.overruns)) {
      const std::uint64_t by_it = std::min(late->second, count);
      causes["overrun in " + name] += std::min(open, by_it);
      open -= std::min(open, by_it);
    }
  }
  if (const auto none = refused.find("bound_missing"); none != refused.end()) {
    if (says(before, "overload") || says(a, "overload") || says(b, "overload")) {
      causes["terrain given up for time"] += std::min(open, none->second);
      open -= std::min(open, none->second);
    }
  }
  if (open > 0) causes["none known: " + words(refused)] += open;
  return open;
}

Finding heartbeats(const std::vector<LiveSample>& samples) {
  const LiveSample &a = samples.front(), &b = samples.back();
  Counts causes;
  std::uint64_t open = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    open += without_cause(samples[i < 2 ? 0 : i - 2], samples[i - 1], samples[i], causes);
  }
  const Counts refused = since(a.refused, b.refused);
  return {open == 0, formatted("heartbeats: %llu for %llu frames; missed: %s; causes: %s",
                               wide(b.edges - a.edges), wide(b.drawn - a.drawn),
                               words(refused).c_str(), words(causes).c_str())};
}

/// Every frame was judged, and the line did what the report says.
std::vector<Finding> edges(const LiveSample& a, const LiveSample& b) {
  const std::uint64_t judged = b.edges - a.edges + sum(since(a.refused, b.refused));
  const std::uint64_t drawn = b.drawn - a.drawn;
  const std::uint64_t unjudged = drawn - std::min(judged, drawn);
  const std::uint64_t told = b.edges, seen = b.edges_seen;  // watched since before the first
  const std::uint64_t apart = std::max(told, seen) - std::min(told, seen);
  return {{unjudged <= 1, formatted("frames that were never judged: %llu", wide(unjudged))},
          {apart <= at_the_end && seen > 0,
           formatted("edges of the heartbeat line: %llu reported, %llu seen on it", wide(told),
                     wide(seen))}};
}

Finding pictures(const LiveSample& a, const LiveSample& b) {
  // Removed ones have no heartbeat, so their cause is asked for there.
  const bool good =
      b.present_faults == a.present_faults && b.log_dropped == a.log_dropped && b.mode != "removed";
  return {
      good,
      formatted("pictures: %llu drawn, %llu late, %llu degraded, %llu removed, %llu not shown; "
                "stalls %llu, log lines dropped %llu",
                wide(b.drawn - a.drawn), wide(b.late - a.late), wide(b.degraded - a.degraded),
                wide(b.removed - a.removed), wide(b.present_faults - a.present_faults),
                wide(b.picture_stalls - a.picture_stalls), wide(b.log_dropped - a.log_dropped))};
}

Finding latency(const LiveSample& b) {
  return {
      b.latency_count > 0 && b.latency_p99_ms <= latency_limit_ms,
      formatted("latency, kernel's stamp to picture shown: p50 %.2f, p99 %.2f, max %.2f ms of %llu",
                b.latency_p50_ms, b.latency_p99_ms, b.latency_max_ms, wide(b.latency_count))};
}

}  // namespace

LiveSample sample_of(const Json& status) {
  LiveSample s;
  s.up_s = status.at("up_s");
  const Json& frames = status.at("frames");
  s.mode = frames.at("mode");
  s.reasons = frames.at("reasons").get<std::vector<std::string>>();
  s.drawn = frames.at("drawn");
  s.late = frames.at("late");
  s.degraded = frames.at("degraded");
  s.removed = frames.at("removed");
  s.present_faults = frames.at("present_faults");
  const Json& lines = status.at("lines");
  s.edges = lines.at("heartbeat_edges");
  s.picture_stalls = lines.at("picture_stalls");
  s.refused = lines.at("heartbeat_refused").get<Counts>();
  const Json& monitor = status.at("monitor");
  s.overruns = monitor.at("overruns").get<Counts>();
  s.sheds = monitor.at("sheds");
  s.late_finishes = monitor.at("late_finishes");
  const Json& bus = status.at("bus");
  for (const Json& interface : bus.at("interfaces")) {
    s.received += interface.at("frames").get<std::uint64_t>();
    s.dropped += interface.at("dropped").get<std::uint64_t>();
  }
  s.decoded = bus.at("decoded");
  s.ignored = bus.at("ignored");
  s.replayed = status.at("integrity").at("replayed");
  const Json& real_time = status.at("real_time");
  s.allocations = real_time.at("allocations_after_boot");
  s.gl_creations = real_time.at("gl_creations_after_boot");
  s.log_dropped = status.at("log").at("dropped");
  const Json &late = status.at("latency_ms"), &frame = status.at("frame_ms");
  s.latency_p50_ms = late.at("p50");
  s.latency_p99_ms = late.at("p99");
  s.latency_max_ms = late.at("max");
  s.latency_count = late.at("count");
  s.frame_p50_ms = frame.at("p50");
  s.frame_p99_ms = frame.at("p99");
  s.frame_max_ms = frame.at("max");
  s.first_frame_ms = number(status.at("boot_to_first_frame_ms"));
  s.first_terrain_ms = number(status.at("boot_to_first_terrain_ms"));
  return s;
}

std::vector<Finding> account(const std::vector<LiveSample>& samples) {
  const LiveSample &a = samples.front(), &b = samples.back();
  std::vector<Finding> all = {allocations(b), heartbeats(samples)};
  for (Finding& finding : edges(a, b)) all.push_back(std::move(finding));
  all.push_back(pictures(a, b));
  all.push_back(bus(b));
  all.push_back(memory(a, b, samples));
  all.push_back(latency(b));
  return all;
}

}  // namespace ridgeline::rig
