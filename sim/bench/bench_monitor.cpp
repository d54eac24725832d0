#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "platform/gpu_clock.hpp"
#include "sim/bench/bench.hpp"
#include "sim/output/atomic_file.hpp"
#include "sim/output/percentile.hpp"

namespace ridgeline::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array shares_of_budget{0.5, 0.75, 0.9, 1.0, 1.25, 1.5, 2.0};

/// What the frames of a flight took, with the monitor or without.
struct TimedFlight {
  const char* monitor = "";
  std::vector<double> frame_ms, bound_px;
  int without_terrain = 0, finished_coarser = 0;

  [[nodiscard]] double percent_within(double limit_ms) const {
    const auto within =
        std::count_if(frame_ms.begin(), frame_ms.end(), [&](double ms) { return ms <= limit_ms; });
    return 100.0 * static_cast<double>(within) /
           static_cast<double>(std::max<std::size_t>(frame_ms.size(), 1));
  }
  void add(const Picture& picture, double elapsed_ms) {
    frame_ms.push_back(elapsed_ms);
    finished_coarser += picture.report.finished_coarser ? 1 : 0;
    if (picture.report.availability.mode == Mode::removed) {
      ++without_terrain;
    } else {
      bound_px.push_back(picture.report.bound_px);
    }
  }
};

Json flight_json(const TimedFlight& flight, double deadline_ms) {
  Json json = {{"monitor", flight.monitor},
               {"frames", flight.frame_ms.size()},
               {"percent_in_time", flight.percent_within(deadline_ms)},
               {"frame_ms_median", percentile(flight.frame_ms, 0.5)},
               {"frame_ms_p90", percentile(flight.frame_ms, 0.9)},
               {"frame_ms_p99", percentile(flight.frame_ms, 0.99)},
               {"frame_ms_max", percentile(flight.frame_ms, 1.0)},
               {"bound_px_median", percentile(flight.bound_px, 0.5)},
               {"bound_px_max", percentile(flight.bound_px, 1.0)},
               {"without_terrain", flight.without_terrain},
               {"finished_coarser", flight.finished_coarser}};
  for (const double share : shares_of_budget) {
    json["percent_within"].push_back(
        {{"of_deadline", share}, {"percent", flight.percent_within(share * deadline_ms)}});
  }
  return json;
}

void print_flights(const std::array<TimedFlight, 2>& flights, double deadline_ms) {
  std::printf(
      "deadline %.2f ms\n\n| monitor | frames | %% in time | median ms | p90 | p99 | max |"
      " bound px median | max | without terrain | finished coarser |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n",
      deadline_ms);
  for (const TimedFlight& flight : flights) {
    std::printf("| %s | %zu | %.1f | %.1f | %.1f | %.1f | %.1f | %.2f | %.2f | %d | %d |\n",
                flight.monitor, flight.frame_ms.size(), flight.percent_within(deadline_ms),
                percentile(flight.frame_ms, 0.5), percentile(flight.frame_ms, 0.9),
                percentile(flight.frame_ms, 0.99), percentile(flight.frame_ms, 1.0),
                percentile(flight.bound_px, 0.5), percentile(flight.bound_px, 1.0),
                flight.without_terrain, flight.finished_coarser);
  }
  std::printf("\n| %% of the frames within this share of the deadline |");
  for (const double share : shares_of_budget) std::printf(" %.2f |", share);
  std::printf("\n|---|---|---|---|---|---|---|---|\n");
  for (const TimedFlight& flight : flights) {
    std::printf("| monitor %s |", flight.monitor);
    for (const double share : shares_of_budget) {
      std::printf(" %.1f |", flight.percent_within(share * deadline_ms));
    }
    std::printf("\n");
  }
}

}  // namespace

Outcome bench_monitor(const BenchOptions& options, double deadline_ms) {
  BusProfile profile;
  profile.header_rule = HeaderRule::field;
  profile.heading_reference = HeadingReference::true_north;
  const std::vector<BenchView> views = log_views(options.log_file, profile, options.log_views);
  if (views.empty()) {
    return {Fault::file_malformed, options.log_file + ": holds no view to measure at"};
  }
  SceneOptions scene = options.scene;
  scene.arrival = SceneOptions::Arrival::in_step;
  Session session;
  if (Outcome opened = session.open(scene, views.front().input.eye); !opened.ok()) return opened;
  GpuClock clock;
  FramePace pace({static_cast<std::int64_t>(deadline_ms * 1e6), scene.settings.error_px,
                  limits::budget_most_px},
                 clock);
  session.draw(views.front().input, false);  // the window is settled, and not part of it
  std::array<TimedFlight, 2> flights;
  flights[0].monitor = "off";
  flights[1].monitor = "on";
  for (std::size_t k = 0; k < views.size(); ++k) {
    // In turn, so that noise and the blocks that come in hit both alike.
    for (const std::size_t which : {k % 2, 1 - k % 2}) {
      session.settings().pace = which == 1 ? &pace : nullptr;
      clock.start_frame();
      const Picture picture = session.draw(views[k].input, false);
      const double elapsed_ms = which == 1 ? 1e-6 * static_cast<double>(picture.elapsed_ns)
                                           : 1e-6 * static_cast<double>(clock.elapsed_ns(
                                                        FrameStage::shade, {}, ShadeDetail::full));
      flights[which].add(picture, elapsed_ms);
    }
  }
  print_flights(flights, deadline_ms);
  const BudgetCounters& counters = pace.budget().counters;
  Json causes;
  std::printf("\noverruns with the monitor:");
  for (std::size_t k = 1; k < overrun_cause_count; ++k) {
    const char* word = cause_word(static_cast<OverrunCause>(k));
    causes[word] = counters.overruns[k];
    std::printf(" %s %llu", word, static_cast<unsigned long long>(counters.overruns[k]));
  }
  std::printf("; steps down %llu, up %llu\n", static_cast<unsigned long long>(counters.sheds),
              static_cast<unsigned long long>(counters.restores));
  if (options.json_file.empty()) return {};
  const Json json = {
      {"driver", session.driver()},
      {"deadline_ms", deadline_ms},
      {"flights", {flight_json(flights[0], deadline_ms), flight_json(flights[1], deadline_ms)}},
      {"overruns", causes}};
  return write_file(options.json_file, json.dump(1) + "\n");
}

}  // namespace ridgeline::sim
