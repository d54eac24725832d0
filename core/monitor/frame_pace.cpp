#include "core/monitor/frame_pace.hpp"

#include <algorithm>

#include "core/base/assert.hpp"

namespace ridgeline {

std::int64_t FramePace::read(FrameStage stage, const FrameWork& done) {
  const ShadeDetail detail = record_.plan.detail;
  const std::int64_t elapsed_ns =
      std::max(clock_.elapsed_ns(stage, done, detail), last_ns_);  // a clock that went back stands
  const auto k = static_cast<std::size_t>(stage);
  tally_.spent_ns[k] += elapsed_ns - last_ns_;
  tally_.nominal_ns[k] += nominal_ns(done - counted_, detail);
  last_ns_ = elapsed_ns;
  counted_ = done;
  return elapsed_ns;
}

FramePlan FramePace::begin(int bus_frames) {
  record_ = {next_plan(budget_), {}};
  tally_ = {};
  tally_.plan = record_.plan;
  counted_ = {};
  last_ns_ = 0;
  FrameWork done;
  done.bus_frames = bus_frames;
  reached(FrameStage::input, done, {}, false);
  return record_.plan;
}

LateVerdict FramePace::reached(FrameStage stage, const FrameWork& done, const FrameWork& left,
                               bool can_coarsen) {
  const std::int64_t elapsed_ns = read(stage, done);
  LateQuestion question;
  question.plan = record_.plan;
  question.elapsed_ns = elapsed_ns;
  question.left_ns = nominal_ns(left, record_.plan.detail);
  question.can_coarsen = can_coarsen && !tally_.coarser;
  const auto cast = static_cast<std::size_t>(FrameStage::cast);
  if (tally_.nominal_ns[cast] > 0) {
    question.cast_slowness =
        static_cast<double>(tally_.spent_ns[cast]) / static_cast<double>(tally_.nominal_ns[cast]);
  }
  const bool judged = stage == FrameStage::plan || stage == FrameStage::cast;
  const LateVerdict verdict = judged ? late_verdict(budget_, question) : LateVerdict::go_on;
  if (stage == FrameStage::plan && tally_.planned_ns == 0) {
    tally_.planned_ns = nominal_ns(left, record_.plan.detail);
  }
  tally_.coarser = tally_.coarser || verdict == LateVerdict::coarser;
  tally_.given_up = tally_.given_up || verdict == LateVerdict::give_up;
  const bool room = record_.readings.push_back({stage, elapsed_ns, verdict});
  RL_ASSERT(room);
  return verdict;
}

void FramePace::end(const FrameWork& done, double reached_px) {
  const std::int64_t elapsed_ns = read(FrameStage::shade, done);
  record_.readings.push_back({FrameStage::shade, elapsed_ns, LateVerdict::go_on});
  tally_.reached_px = reached_px;
  budget_ = after_frame(budget_, tally_);
}

}  // namespace ridgeline
