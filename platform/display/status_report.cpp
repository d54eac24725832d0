#include "platform/display/status_report.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "platform/display/supervisor.hpp"
#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"

namespace ridgeline {
namespace {

double ms(std::int64_t time_ns) {
  return static_cast<double>(time_ns) * 1e-6;
}

/// Pages of the process that are in memory, in bytes; 0 where /proc does not say.
std::uint64_t resident_bytes() {
  char text[128] = {};
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t length = ::read(file, text, sizeof text - 1);
  ::close(file);
  unsigned long long all = 0, resident = 0;
  if (length <= 0 || std::sscanf(text, "%llu %llu", &all, &resident) != 2) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void add_durations(JsonText& json, const char* name, const DurationHistogram& histogram) {
  json.open_object(name);
  json.add("count", histogram.count());
  json.add("p50", ms(histogram.quantile_ns(0.5)));
  json.add("p99", ms(histogram.quantile_ns(0.99)));
  json.add("max", ms(histogram.largest_ns()));
  json.close_object();
}

void add_frames(JsonText& json, const Exchange& exchange, const FrameFact& frame) {
  json.open_object("frames");
  json.add("drawn", frame.proof.frame);
  json.add("late", frame.late);
  json.add("degraded", frame.degraded);
  json.add("removed", frame.removed);
  json.add("present_faults", frame.present_faults);
  json.add("hidden", frame.hidden);
  json.add("mode", mode_word(frame.availability.mode));
  json.open_list("reasons");
  for (const Reason reason : frame.availability.reasons) json.add(nullptr, reason_word(reason));
  json.close_list();
  if (frame.bound_px > 0) {
    json.add("bound_px", frame.bound_px);
  } else {
    json.add_null("bound_px");
  }
  json.add("range_km", frame.range_km);
  json.close_object();
  const auto since_start = [&](const char* name, std::int64_t time_ns) {
    if (time_ns == 0) {
      json.add_null(name);
    } else {
      json.add(name, ms(time_ns - exchange.start_ns));
    }
  };
  since_start("boot_to_first_frame_ms", frame.first_frame_ns);
  since_start("boot_to_first_terrain_ms", frame.first_terrain_ns);
}

/// A counter by its name in the report.
struct Counted {
  const char* name;
  std::uint32_t UpdateCounters::*member;
};

void add_monitor(JsonText& json, const DisplayConfig& config, const FrameFact& frame) {
  const BudgetCounters& counters = frame.budget;
  json.open_object("monitor");
  json.add("on", config.monitor.on);
  json.add("deadline_ms", ms(budget_settings(config).deadline_ns));
  json.add("frames", counters.frames);
  json.add("step", std::int64_t{frame.budget_step});
  json.open_object("overruns");
  for (std::size_t k = 1; k < overrun_cause_count; ++k) {
    json.add(cause_word(static_cast<OverrunCause>(k)), counters.overruns[k]);
  }
  json.close_object();
  json.add("sheds", counters.sheds);
  json.add("restores", counters.restores);
  json.add("late_finishes", counters.late_finishes);
  json.add("given_up", counters.given_up);
  json.add("without_terrain", counters.frames_without_terrain);
  json.add("worst_ms", ms(counters.worst_ns));
  json.add("worst_cause", cause_word(counters.worst_cause));
  json.open_object("worst_stage_ms");
  for (std::size_t k = 0; k < frame_stage_count; ++k) {
    json.add(stage_word(static_cast<FrameStage>(k)), ms(counters.worst_stage_ns[k]));
  }
  json.close_object();
  json.add("worst_px", counters.worst_px);
  json.close_object();
}

/// What was refused, doubted or taken over; each counts up from 0.
void add_integrity(JsonText& json, const UpdateCounters& counters, const FrameFact& frame) {
  using U = UpdateCounters;
  constexpr Counted counted[] = {
      {"not_data", &U::not_data},
      {"other_channel", &U::other_channel},
      {"other_source", &U::other_source},
      {"type_mismatch", &U::type_mismatch},
      {"not_finite", &U::not_finite},
      {"bad_parity", &U::bad_parity},
      {"no_computed_data", &U::no_computed_data},
      {"functional_test", &U::functional_test},
      {"failure_warning", &U::failure_warning},
      {"suspect", &U::suspect},
      {"unpaired_words", &U::unpaired_words},
      {"unpaired_halves", &U::unpaired_halves},
      {"unpaired_fixes", &U::unpaired_fixes},
      {"duplicated", &U::duplicated},
      {"replayed", &U::replayed},
      {"replay_bursts", &U::replay_bursts},
      {"lost_in_sequence", &U::lost_in_sequence},
      {"jumps_believed", &U::jumps_believed},
      {"source_changes", &U::source_changes},
      {"disagreements", &U::disagreements},
      {"freezes", &U::freezes},
      {"outvoted", &U::outvoted},
      {"clock_resets", &U::clock_resets},
      {"clock_steps", &U::clock_steps},
  };
  json.open_object("integrity");
  for (const Counted& one : counted) json.add(one.name, std::uint64_t{counters.*one.member});
  json.add("ground_disagreements", frame.ground_disagreements);
  json.add("air_ground_disagreements", frame.air_ground_disagreements);
  json.close_object();
}

/// How the last frame was drawn, and what the air/ground switch said with it.
void add_display(JsonText& json, const FrameFact& frame) {
  constexpr const char* words[] = {"unknown", "air", "ground"};  // by AirGround
  json.open_object("display");
  json.add("luminance", frame.display.luminance);
  json.add("words_luminance", words_luminance(frame.display));
  json.add("declutter", frame.display.declutter);
  json.add("air_ground", words[static_cast<std::size_t>(frame.air_ground)]);
  json.close_object();
}

const char* link_word(CanLink link) {
  return link == CanLink::up ? "up" : link == CanLink::down ? "down" : "absent";
}

const char* controller_word(CanController controller) {
  switch (controller) {
    case CanController::active:
      return "active";
    case CanController::warning:
      return "warning";
    case CanController::passive:
      return "passive";
    case CanController::bus_off:
      break;
  }
  return "bus_off";
}

void add_bus(JsonText& json, const DisplayConfig& config, const BusStatus& bus,
             std::int64_t now_ns) {
  json.open_object("bus");
  json.open_list("interfaces");
  for (std::size_t i = 0; i < bus.interface_count; ++i) {
    const BusStatus::Interface& one = bus.interfaces[i];
    json.open_object();
    json.add("name", std::string_view(config.bus.interfaces[i]));
    json.add("link", link_word(one.link));
    json.add("controller", controller_word(one.controller));
    json.add("frames", one.received.frames);
    json.add("dropped", one.received.dropped);
    json.add("error_frames", one.received.error_frames);
    json.add("malformed", one.received.malformed);
    json.add("bus_offs", one.counters.bus_offs);
    json.add("link_downs", one.counters.link_downs);
    json.add("unplugs", one.counters.unplugs);
    json.add("read_faults", one.counters.read_faults);
    json.close_object();
  }
  json.close_list();
  const UpdateCounters& counters = bus.updates;
  json.add("decoded", std::uint64_t{counters.decoded});
  json.add("ignored", std::uint64_t{counters.ignored});
  json.add("bad_length", std::uint64_t{counters.bad_length});
  json.add("out_of_range", std::uint64_t{counters.out_of_range});
  json.add("implausible", std::uint64_t{counters.implausible});
  json.add("out_of_order", std::uint64_t{counters.out_of_order});
  json.add("from_future", std::uint64_t{counters.from_future});
  json.add("answers", bus.answers);
  if (bus.newest_frame_ns > 0) {
    json.add("silent_for_ms", ms(now_ns - bus.newest_frame_ns));
  } else {
    json.add_null("silent_for_ms");
  }
  json.close_object();
}

void add_lines(JsonText& json, const LineStatus& lines) {
  json.open_object("lines");
  json.add("heartbeat_edges", lines.heartbeat.edges);
  json.open_object("heartbeat_refused");
  for (std::size_t i = 1; i < heartbeat_refusal_count; ++i) {
    json.add(refusal_word(static_cast<HeartbeatRefusal>(i)), lines.heartbeat.refusals[i]);
  }
  json.close_object();
  json.add("svs_valid", lines.outputs[static_cast<std::size_t>(DiscreteOutput::svs_valid)]);
  json.add("svs_fail", lines.outputs[static_cast<std::size_t>(DiscreteOutput::svs_fail)]);
  constexpr const char* inputs[] = {"display_on", "declutter", "night", "on_ground"};
  for (std::size_t i = 0; i < discrete_input_count; ++i) json.add(inputs[i], lines.inputs[i]);
  json.add("line_lost", lines.line_lost);
  json.add("picture_stalls", lines.stalls);
  json.close_object();
}

/// "granted", "not asked for" or what the system said.
const char* grant_word(int error, bool asked) {
  return !asked       ? "not asked for"
         : error == 0 ? "granted"
         : error < 0  ? "pending"
                      : strerrordesc_np(error);
}

void add_real_time(JsonText& json, const DisplayConfig& config, const Exchange& exchange) {
  const DisplayConfig::RealTime& asked = config.real_time;
  const RealTimeStatus& got = exchange.real_time;
  json.open_object("real_time");
  json.add("memory_lock", grant_word(got.memory, asked.lock_memory));
  json.add("bus_thread", grant_word(got.bus, asked.bus_priority > 0));
  json.add("supervisor", grant_word(got.supervisor, asked.supervisor_priority > 0));
  json.add("render_thread", grant_word(got.render, asked.render_priority > 0));
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  json.add("major_page_faults", std::int64_t{usage.ru_majflt});
  json.add("allocations_after_boot", heap_allocations_counted());
  json.add("gl_creations_after_boot", gl_creations_counted());
  json.add("resident_bytes", resident_bytes());
  json.close_object();
}

}  // namespace

void read_sources(Exchange& exchange, StatusSources& sources) {
  exchange.bus_report.read(sources.bus);
  exchange.frame_status.read(sources.frame);
  exchange.line_status.read(sources.lines);
}

void write_status(JsonText& json, const DisplayConfig& config, const Exchange& exchange,
                  const StatusSources& sources, std::int64_t now_ns, const char* why) {
  json.clear();
  json.open_object();
  json.add("state", why);
  json.add("up_s", ms(now_ns - exchange.start_ns) * 1e-3);
  add_frames(json, exchange, sources.frame);
  add_display(json, sources.frame);
  add_durations(json, "latency_ms", exchange.latency);
  add_durations(json, "frame_ms", exchange.frame_time);
  add_monitor(json, config, sources.frame);
  add_bus(json, config, sources.bus, now_ns);
  add_integrity(json, sources.bus.updates, sources.frame);
  add_lines(json, sources.lines);
  add_real_time(json, config, exchange);
  json.open_object("log");
  json.add("dropped", exchange.bus_log.dropped_count() + exchange.render_log.dropped_count() +
                          exchange.supervisor_log.dropped_count());
  json.close_object();
  json.close_object();
}

}  // namespace ridgeline
