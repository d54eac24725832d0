#include "sim/replay/replay_report.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numeric>
#include <string>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "sim/output/percentile.hpp"
#include "sim/session/display_json.hpp"

namespace ridgeline::sim {
namespace {

constexpr int rss_every = 100;  ///< frames

constexpr const char* pass_names[pass_count] = {"grid", "ray_cast", "shade"};

nlohmann::ordered_json percentiles(const std::vector<double>& values) {
  return {{"median", percentile(values, 0.5)},
          {"p99", percentile(values, 0.99)},
          {"max", percentile(values, 1.0)}};
}

/// Kilobytes of one line of /proc/self/status; 0 where there is none.
long status_kib(const char* name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name, 0) == 0) return std::strtol(line.c_str() + std::strlen(name), nullptr, 10);
  }
  return 0;
}

nlohmann::ordered_json memory_json(int index) {
  return {{"frame", index},
          {"peak_rss_kib", status_kib("VmHWM:")},
          {"anonymous_kib", status_kib("RssAnon:")},
          {"file_kib", status_kib("RssFile:")}};
}

nlohmann::ordered_json window_json(const Session& session) {
  const LevelSizes& sizes = session.window();
  const PostLattice& lattice = session.lattice();
  const double posts = static_cast<double>(sizes.posts());
  return {{"levels", sizes.levels},
          {"columns", sizes.columns()},
          {"rows", sizes.rows()},
          {"latitude_step_arcsec", 3600.0 * lattice.latitude_step_deg},
          {"longitude_step_arcsec", 3600.0 * lattice.longitude_step_deg},
          {"gpu_bytes", posts * gpu_bytes_per_post},
          {"loader_bytes", session.loader_bytes()},
          {"sea_cells", session.sea_cells()},
          {"idle_sea_cells", session.idle_sea_cells()}};
}

nlohmann::ordered_json log_json(const CandumpLog& log) {
  const CandumpStatistics& s = log.statistics;
  return {{"lines", s.lines},
          {"data_frames", s.data_frames},
          {"fd_frames", s.fd_frames},
          {"remote_frames", s.remote_frames},
          {"error_frames", s.error_frames},
          {"xl_frames", s.xl_frames},
          {"comment_lines", s.comment_lines},
          {"bad_lines", s.bad_lines},
          {"lost_frames", s.lost_frames},
          {"time_reversals", s.time_reversals},
          {"problems", log.notes.problems},
          {"interfaces", log.notes.interfaces}};
}

nlohmann::ordered_json budget_json(const FrameBudget& budget) {
  const BudgetCounters& c = budget.counters;
  nlohmann::ordered_json json = {
      {"deadline_ms", 1e-6 * static_cast<double>(budget.settings.deadline_ns)},
      {"wanted_px", budget.settings.wanted_px},
      {"most_px", budget.settings.most_px},
      {"frames", c.frames},
      {"sheds", c.sheds},
      {"restores", c.restores},
      {"late_finishes", c.late_finishes},
      {"given_up", c.given_up},
      {"frames_without_terrain", c.frames_without_terrain},
      {"worst_ms", 1e-6 * static_cast<double>(c.worst_ns)},
      {"worst_cause", cause_word(c.worst_cause)},
      {"worst_px", c.worst_px}};
  for (std::size_t k = 1; k < overrun_cause_count; ++k) {
    json["overruns"][cause_word(static_cast<OverrunCause>(k))] = c.overruns[k];
  }
  for (std::size_t k = 0; k < frame_stage_count; ++k) {
    json["worst_stage_ms"][stage_word(static_cast<FrameStage>(k))] =
        1e-6 * static_cast<double>(c.worst_stage_ns[k]);
  }
  return json;
}

nlohmann::ordered_json bus_json(const UpdateCounters& c) {
  return {{"frames", c.frames},
          {"decoded", c.decoded},
          {"ignored", c.ignored},
          {"not_data", c.not_data},
          {"other_channel", c.other_channel},
          {"other_source", c.other_source},
          {"bad_length", c.bad_length},
          {"type_mismatch", c.type_mismatch},
          {"out_of_range", c.out_of_range},
          {"not_finite", c.not_finite},
          {"bad_parity", c.bad_parity},
          {"no_computed_data", c.no_computed_data},
          {"functional_test", c.functional_test},
          {"failure_warning", c.failure_warning},
          {"suspect", c.suspect},
          {"unpaired_words", c.unpaired_words},
          {"implausible", c.implausible},
          {"out_of_order", c.out_of_order},
          {"from_future", c.from_future},
          {"duplicated", c.duplicated},
          {"replayed", c.replayed},
          {"unpaired_halves", c.unpaired_halves},
          {"unpaired_fixes", c.unpaired_fixes},
          {"jumps_believed", c.jumps_believed},
          {"source_changes", c.source_changes},
          {"clock_resets", c.clock_resets}};
}

nlohmann::ordered_json integrity_json(const UpdateCounters& c, const GroundWatch& ground) {
  return {{"disagreements", c.disagreements},
          {"freezes", c.freezes},
          {"outvoted", c.outvoted},
          {"jumps_believed", c.jumps_believed},
          {"clock_resets", c.clock_resets},
          {"clock_steps", c.clock_steps},
          {"replay_bursts", c.replay_bursts},
          {"lost_in_sequence", c.lost_in_sequence},
          {"radio_height_disagreements", ground.radio.disagreements},
          {"air_ground_disagreements", ground.air_ground.disagreements}};
}

}  // namespace

void ReplayReport::add(int index, const Picture& picture) {
  const FrameReport& report = picture.report;
  nlohmann::ordered_json frame;
  frame["index"] = index;
  frame["time_s"] = static_cast<double>(report.time_ns) * 1e-9;
  frame["mode"] = mode_word(report.availability.mode);
  frame["reasons"] = nlohmann::ordered_json::array();
  for (const Reason reason : report.availability.reasons) {
    frame["reasons"].push_back(reason_word(reason));
    ++reasons_[std::string(reason_word(reason))];
  }
  const bool removed = report.availability.mode == Mode::removed;
  removed_ += removed ? 1 : 0;
  degraded_ += report.availability.mode == Mode::degraded ? 1 : 0;
  const bool promised = !removed && report.bound_px > 0;  // methods without a proof promise none
  frame["bound_px"] =
      promised ? nlohmann::ordered_json(report.bound_px) : nlohmann::ordered_json(nullptr);
  frame["range_m"] = report.range_m;
  if (auto display = display_json(report.display); !display.is_null()) frame["display"] = display;
  frame["cpu_ms"] = picture.cpu_ms;
  const auto& ms = picture.counts.pass_ms;
  const double gpu_ms = std::accumulate(ms.begin(), ms.end(), 0.0);
  frame["gpu_ms"] = gpu_ms > 0 ? nlohmann::ordered_json(gpu_ms) : nlohmann::ordered_json(nullptr);
  frame["passes"] = nlohmann::ordered_json::array();
  for (int pass = 0; pass < pass_count && !removed; ++pass) {
    frame["passes"].push_back({{"name", pass_names[pass]}, {"gpu_ms", ms[pass]}});
  }
  frame["ray_cast_share"] = picture.counts.ray_cast_share;
  frame["planes"] = report.planes;
  frame["rows"] = report.rows;
  frame["nodes"] = report.nodes;
  frame["rays"] = report.rays;
  frame["geometry_px"] = report.budget.geometry_px;
  frame["level_px"] = report.budget.level_px;
  if (picture.elapsed_ns > 0) {
    frame["budget"] = {{"step", picture.plan.step},
                       {"planned_px", picture.plan.error_px},
                       {"elapsed_ms", 1e-6 * static_cast<double>(picture.elapsed_ns)},
                       {"finished_coarser", report.finished_coarser}};
  }
  frame["blocks_arrived"] = report.window.blocks_arrived;
  frame["upload_ms"] = picture.take.upload_ms;
  frame["wait_ms"] = picture.take.wait_ms;
  frames_.push_back(frame);
  track_recovery(picture);
  if (report.window.blocks_arrived > 0) upload_ms_.push_back(picture.take.upload_ms);
  if (index % rss_every == 0) rss_.push_back(memory_json(index));
  if (removed) return;
  if (first_terrain_ms_ < 0) first_terrain_ms_ = picture.since_start_ms;
  if (report.availability.mode == Mode::svs && first_svs_ms_ < 0) {
    first_svs_ms_ = picture.since_start_ms;
  }
  bounds_held_ += promised && report.bound_px <= picture.wanted_px ? 1 : 0;
  cpu_ms_.push_back(picture.cpu_ms);
  gpu_ms_.push_back(gpu_ms);
  largest_bound_px_ = std::max(largest_bound_px_, report.bound_px);
}

/// A recovery runs from the first frame that shows less than it should, because terrain is still on
/// its way, to the first that shows all of it again.
void ReplayReport::track_recovery(const Picture& picture) {
  const FrameReport& report = picture.report;
  const bool placed = report.availability.mode != Mode::removed || report.window.known_posts > 0 ||
                      report.window.blocks_arrived > 0;
  const bool short_of =
      placed && !report.window.complete &&
      (report.bound_px > picture.wanted_px || report.availability.mode == Mode::removed ||
       report.range_m < picture.wanted_range_m);
  const double at_s = static_cast<double>(report.time_ns) * 1e-9;
  if (short_of && !recovery_) recovery_ = Recovery{at_s, 0, 0};
  if (!recovery_) return;
  if (short_of) {
    ++recovery_->frames;
    recovery_->worst_px = std::max(recovery_->worst_px, report.bound_px);
    return;
  }
  recoveries_.push_back({{"from_s", recovery_->from_s},
                         {"seconds", at_s - recovery_->from_s},
                         {"frames", recovery_->frames},
                         {"worst_bound_px", recovery_->worst_px}});
  recovery_.reset();
}

double ReplayReport::median_cpu_ms() const {
  return percentile(cpu_ms_, 0.5);
}

nlohmann::ordered_json ReplayReport::finished(const CandumpLog& log, const OwnshipState& state,
                                              const GroundWatch& ground, const Session& session,
                                              const std::string& log_file) const {
  nlohmann::ordered_json json;
  json["log"] = log_file;
  json["labels"] = log.notes.labels;
  json["driver"] = session.driver();
  json["geoid"] = session.geoid_name();
  json["frame_count"] = frames_.size();
  json["removed_frames"] = removed_;
  json["degraded_frames"] = degraded_;
  json["largest_bound_px"] = largest_bound_px_;
  json["reason_counts"] = reasons_;
  json["cpu_ms"] = percentiles(cpu_ms_);
  json["gpu_ms"] = percentiles(gpu_ms_);
  json["frames_within_error"] = bounds_held_;
  json["first_terrain_ms"] = first_terrain_ms_;
  json["first_svs_ms"] = first_svs_ms_;
  json["recoveries"] = recoveries_;
  json["upload_ms"] = percentiles(upload_ms_);
  json["window"] = window_json(session);
  json["blocks_loaded"] = session.blocks_loaded();
  json["memory_samples"] = rss_;
  json["allocations_after_boot"] = heap_allocations_counted();
  json["gl_creations_after_boot"] = gl_creations_counted();
  json["gl_creations"] = gl_creations_seen();
  json["heap_bytes"] = mallinfo2().uordblks + mallinfo2().hblkhd;
  json["gpu_bytes"] = gl_bytes_allocated();
  json["mapped_bytes"] = session.mapped_bytes();
  json["bad_lines"] = log.statistics.bad_lines;
  json["log_lines"] = log_json(log);
  json["bus"] = bus_json(state.counters);
  json["integrity"] = integrity_json(state.counters, ground);
  if (session.settings().pace != nullptr) {
    json["budget"] = budget_json(session.settings().pace->budget());
  }
  json["frames"] = frames_;
  return json;
}

}  // namespace ridgeline::sim
