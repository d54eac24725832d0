#include "sim/replay/replay_pacing.hpp"

#include <cmath>

#include "sim/output/atomic_file.hpp"

namespace ridgeline::sim {

Outcome ReplayPacing::open(const PaceOptions& options, const SceneOptions& scene) {
  options_ = options;
  const double wanted_px = scene.settings.error_px;
  const bool in_step = scene.arrival == SceneOptions::Arrival::in_step;
  const std::string arrival = in_step ? "in-step" : "as-ready";
  BudgetSettings settings{static_cast<std::int64_t>(std::llround(options.deadline_ms * 1e6)),
                          wanted_px, options.most_px};
  const std::string& file = options.decisions_file;
  if (!file.empty()) {
    if (Outcome read = read_decisions(file, decisions_); !read.ok()) return read;
    settings = decisions_.settings;
    if (settings.wanted_px != wanted_px) {
      return {Fault::file_malformed, file + ":1: was recorded with another --error"};
    }
    if (decisions_.arrival != arrival) {
      return {Fault::file_malformed, file + ":1: was recorded with another --arrival"};
    }
    pace_.emplace(settings, recorded_clock_);
  } else if (options.kind == PaceOptions::Kind::work) {
    work_clock_.emplace(options.cost_scale);
    pace_.emplace(settings, *work_clock_);
  } else if (options.kind == PaceOptions::Kind::real) {
    pace_.emplace(settings, gpu_clock_);
  }
  recorded_ = decisions_head(settings, arrival);
  return {};
}

Outcome ReplayPacing::begin_frame(int index, std::int64_t time_ns, Session& session) {
  gpu_clock_.start_frame();
  if (options_.decisions_file.empty()) return {};
  const auto k = static_cast<std::size_t>(index);
  if (k >= decisions_.frames.size()) {
    return {Fault::file_malformed, options_.decisions_file + ": has no frame " +
                                       std::to_string(index) +
                                       "; it was recorded from a shorter run"};
  }
  const FrameDecisions& frame = decisions_.frames[k];
  if (frame.time_ns != time_ns) {
    return {Fault::file_malformed, options_.decisions_file + ":" + std::to_string(frame.line) +
                                       ": is of another time: other log, --from or --rate"};
  }
  recorded_clock_.start_frame(frame.record);
  session.expect_blocks(frame.blocks);
  return {};
}

Outcome ReplayPacing::end_frame(int index, std::int64_t time_ns, Session& session) {
  if (!pace_) return {};
  const FrameDecisions frame{time_ns, pace_->record(), session.blocks_in_rounds(), 0};
  if (!options_.record_file.empty()) recorded_ += decisions_line(index, frame);
  if (options_.decisions_file.empty()) return {};
  const FrameDecisions& then = decisions_.frames[static_cast<std::size_t>(index)];
  if (same_decisions(then.record, frame.record)) return {};
  return {Fault::file_malformed,
          options_.decisions_file + ":" + std::to_string(then.line) +
              ": this program decides otherwise: other terrain or options, or "
              "another version recorded it"};
}

Outcome ReplayPacing::finish() {
  if (options_.record_file.empty()) return {};
  return write_file(options_.record_file, recorded_);
}

}  // namespace ridgeline::sim
