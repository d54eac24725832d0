#include "core/monitor/frame_budget.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/assert.hpp"

namespace ridgeline {
namespace {

constexpr int shade_steps = shade_detail_count - 1;
/// Guesses until frames have shown what a step saves.
constexpr double guess_of_shading = 0.95, guess_of_rung = 0.88, guess_of_all_rungs = 0.45;
constexpr double least_relative = 0.01, most_relative = 1.5;
constexpr double least_expected_ns = 100'000.0;  ///< of a stage, when looking for what was slow
constexpr double substantial = 0.05;  ///< share of a frame below which a stage is not asked
constexpr double alike = 0.6;  ///< stages slowed down at least so much of the slowest: the machine

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The second largest of the recent ones; the only one where there is no other.
double second_largest(const std::array<double, limits::budget_recent_frames>& recent, int count) {
  double first = 0, second = 0;
  const int known = std::min(count, limits::budget_recent_frames);
  for (int k = 0; k < known; ++k) {
    const double value = recent[at(k)];
    if (value > first) {
      second = first;
      first = value;
    } else {
      second = std::max(second, value);
    }
  }
  return known == 1 ? first : second;
}

double overhead_of(const FrameBudget& budget) {
  return second_largest(budget.overhead_ns, budget.recent);
}

std::int64_t sum_of(const StageTimes& times) {
  return std::accumulate(times.begin(), times.end(), std::int64_t{0});
}

std::int64_t head_of(const StageTimes& times) {
  return times[at(static_cast<int>(FrameStage::input))] +
         times[at(static_cast<int>(FrameStage::terrain))];
}

void count(FrameBudget& budget, const FrameBudget& before, const FrameTally& tally) {
  BudgetCounters& counters = budget.counters;
  const std::int64_t elapsed_ns = sum_of(tally.spent_ns);
  const OverrunCause cause = overrun_cause(before, tally);
  ++counters.frames;
  ++counters.overruns[static_cast<std::size_t>(cause)];
  counters.late_finishes += tally.coarser ? 1 : 0;
  counters.given_up += tally.given_up ? 1 : 0;
  counters.frames_without_terrain += !tally.plan.terrain || tally.given_up ? 1 : 0;
  if (elapsed_ns > counters.worst_ns) {
    counters.worst_ns = elapsed_ns;
    counters.worst_cause = cause;
  }
  for (std::size_t k = 0; k < frame_stage_count; ++k) {
    counters.worst_stage_ns[k] = std::max(counters.worst_stage_ns[k], tally.spent_ns[k]);
  }
  const bool for_time = tally.coarser || tally.plan.error_px > budget.settings.wanted_px;
  if (for_time) counters.worst_px = std::max(counters.worst_px, tally.reached_px);
}

void measure(FrameBudget& budget, const FrameTally& tally) {
  const std::size_t place = at(budget.recent % limits::budget_recent_frames);
  const std::int64_t spent_ns = sum_of(tally.spent_ns) - head_of(tally.spent_ns);
  const std::int64_t nominal = sum_of(tally.nominal_ns) - head_of(tally.nominal_ns);
  budget.slowness[place] =
      static_cast<double>(spent_ns) / static_cast<double>(std::max<std::int64_t>(nominal, 1));
  budget.overhead_ns[place] = static_cast<double>(head_of(tally.spent_ns));
  // Counts on over the end of the ring, but never out of its type.
  if (++budget.recent >= 2 * limits::budget_recent_frames) {
    budget.recent = limits::budget_recent_frames;
  }
}

/// Two neighbouring frames at two steps show what one saves over the other.
void learn(FrameBudget& budget, const FrameTally& tally) {
  if (tally.planned_ns <= 0) {
    budget.last_step = -1;
    return;
  }
  const auto planned_ns = static_cast<double>(tally.planned_ns);
  const int step = tally.plan.step, last = budget.last_step;
  if (last >= 0 && last != step) {
    const double before = budget.relative[at(step)];
    const double now = budget.relative[at(last)] * planned_ns / budget.last_planned_ns;
    budget.relative[at(step)] = std::clamp(now, least_relative, most_relative);
    budget.relative_known[at(step)] = budget.relative_known[at(last)] = true;
    // What was only guessed beyond it moves along.
    for (int k = step + 1; k < budget.none_step(); ++k) {
      if (!budget.relative_known[at(k)])
        budget.relative[at(k)] *= budget.relative[at(step)] / before;
    }
  }
  budget.last_step = step;
  budget.last_planned_ns = planned_ns;
  budget.base_ns = planned_ns / budget.relative[at(step)];
}

void shed_to(FrameBudget& budget, int step) {
  if (budget.better_lasts && budget.since_better < budget.hold_frames) {
    budget.hold_frames = std::min(2 * budget.hold_frames, limits::budget_most_hold_frames);
  }
  if (step == budget.none_step()) {
    budget.hold_frames = std::max(budget.hold_frames, limits::budget_none_hold_frames);
  }
  budget.better_lasts = false;
  budget.step = step;
  budget.calm_frames = 0;
  ++budget.counters.sheds;
}

void restore_to(FrameBudget& budget, int step) {
  budget.on_trial = budget.step == budget.none_step();
  budget.step = step;
  budget.calm_frames = 0;
  budget.since_better = 0;
  budget.better_lasts = true;
  ++budget.counters.restores;
}

/// The first step from `first` on that is predicted to need no more than a share of the deadline.
int first_that_fits(const FrameBudget& budget, int first, double share) {
  const double limit_ns = share * static_cast<double>(budget.settings.deadline_ns);
  int step = first;
  while (step < budget.none_step() && predicted_ns(budget, step) > limit_ns) ++step;
  return step;
}

void choose(FrameBudget& budget, const FrameTally& tally) {
  const auto deadline_ns = static_cast<double>(budget.settings.deadline_ns);
  const int none = budget.none_step(), step = budget.step;
  budget.on_trial = false;
  if (budget.better_lasts &&
      ++budget.since_better > limits::budget_forget_holds * budget.hold_frames) {
    budget.hold_frames = limits::budget_hold_frames;
    budget.better_lasts = false;  // and counts as good
  }
  if (tally.given_up) return shed_to(budget, none);
  if (step == none) {
    // Whether terrain fits again is not known from frames without it: it is tried.
    if (++budget.calm_frames >= budget.hold_frames) restore_to(budget, none - 1);
    return;
  }
  if (!(budget.base_ns > 0)) return;
  if (predicted_ns(budget, step) > limits::budget_full_share * deadline_ns) {
    const int fits = first_that_fits(budget, step + 1, limits::budget_aim_share);
    // Terrain does not go on a guess: the largest bound is tried before.
    const bool guessed = fits == none && step < none - 1 && !budget.relative_known[at(none - 1)];
    return shed_to(budget, guessed ? none - 1 : fits);
  }
  const int better = first_that_fits(budget, 0, limits::budget_calm_share);
  budget.calm_frames = better < step ? budget.calm_frames + 1 : 0;
  if (budget.calm_frames < budget.hold_frames) return;
  restore_to(budget, step - (step - better + 1) / 2);
}

}  // namespace

const char* stage_word(FrameStage stage) {
  constexpr std::array<const char*, frame_stage_count> words = {"input", "terrain", "plan", "cast",
                                                                "shade"};
  return words[static_cast<std::size_t>(stage)];
}

const char* cause_word(OverrunCause cause) {
  constexpr std::array<const char*, overrun_cause_count> words = {
      "none", "input", "terrain", "plan", "cast", "shade", "machine"};
  return words[static_cast<std::size_t>(cause)];
}

FrameBudget frame_budget(const BudgetSettings& settings) {
  RL_ASSERT(settings.deadline_ns >= limits::min_deadline_ns);
  RL_ASSERT(settings.deadline_ns <= limits::max_deadline_ns && settings.wanted_px > 0);
  FrameBudget budget;
  budget.settings = settings;
  budget.settings.most_px = std::max(settings.most_px, settings.wanted_px);
  const double span = budget.settings.most_px / settings.wanted_px;
  if (span > 1) {
    const double wanted = std::log(span) / std::log(limits::budget_rung_ratio);
    budget.rungs = std::clamp(static_cast<int>(std::floor(wanted)), 1, limits::budget_rungs);
    budget.ratio = std::pow(span, 1.0 / budget.rungs);
  }
  double relative = 1;
  for (int step = 0; step < limits::budget_steps; ++step) {
    budget.relative[at(step)] = relative;
    relative *= step < shade_steps ? guess_of_shading : guess_of_rung;
    relative = std::max(relative, guess_of_all_rungs);
  }
  return budget;
}

FramePlan next_plan(const FrameBudget& budget) {
  FramePlan plan;
  plan.step = budget.step;
  plan.terrain = budget.step < budget.none_step();
  plan.on_trial = budget.on_trial;
  plan.detail = static_cast<ShadeDetail>(std::min(budget.step, shade_steps));
  const int rung = std::clamp(budget.step - shade_steps, 0, budget.rungs);
  plan.error_px = rung == 0              ? budget.settings.wanted_px
                  : rung == budget.rungs ? budget.settings.most_px
                                         : budget.settings.wanted_px * std::pow(budget.ratio, rung);
  return plan;
}

double slowness_of(const FrameBudget& budget) {
  return budget.recent == 0 ? 1.0 : second_largest(budget.slowness, budget.recent);
}

double predicted_ns(const FrameBudget& budget, int step) {
  if (!(budget.base_ns > 0)) return 0;
  return overhead_of(budget) + budget.base_ns * budget.relative[at(step)] * slowness_of(budget);
}

LateVerdict late_verdict(const FrameBudget& budget, const LateQuestion& question) {
  // In the very first frame nothing is known of the machine but what the frame itself shows.
  const double before = budget.recent == 0 ? 0.0 : slowness_of(budget);
  const double slowness = std::max(before, question.cast_slowness);
  const double end_ns =
      static_cast<double>(question.elapsed_ns) + slowness * static_cast<double>(question.left_ns);
  if (end_ns <= limits::budget_late_share * static_cast<double>(budget.settings.deadline_ns)) {
    return LateVerdict::go_on;
  }
  if (question.can_coarsen) return LateVerdict::coarser;
  return question.plan.on_trial ? LateVerdict::give_up : LateVerdict::go_on;
}

FrameBudget after_frame(const FrameBudget& before, const FrameTally& tally) {
  FrameBudget budget = before;
  count(budget, before, tally);
  measure(budget, tally);
  learn(budget, tally);
  choose(budget, tally);
  return budget;
}

OverrunCause overrun_cause(const FrameBudget& before, const FrameTally& tally) {
  if (sum_of(tally.spent_ns) <= before.settings.deadline_ns) return OverrunCause::none;
  const double slowness = slowness_of(before);
  std::array<double, frame_stage_count> expected_ns{};
  double all_ns = 0, most_ns = 0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < frame_stage_count; ++k) {
    expected_ns[k] =
        std::max(slowness * static_cast<double>(tally.nominal_ns[k]), least_expected_ns);
    all_ns += expected_ns[k];
    const double more_ns = static_cast<double>(tally.spent_ns[k]) - expected_ns[k];
    if (more_ns > most_ns) {
      most_ns = more_ns;
      worst = k;
    }
  }
  // No stage took notably longer than its work explains: it is more than the machine can do.
  if (most_ns < substantial * static_cast<double>(before.settings.deadline_ns)) {
    return OverrunCause::machine;
  }
  const double worst_ratio = static_cast<double>(tally.spent_ns[worst]) / expected_ns[worst];
  bool all_alike = true;
  int others = 0;
  for (std::size_t k = 0; k < frame_stage_count; ++k) {
    if (k == worst || expected_ns[k] < substantial * all_ns) continue;
    ++others;
    all_alike =
        all_alike && static_cast<double>(tally.spent_ns[k]) / expected_ns[k] >= alike * worst_ratio;
  }
  if (others > 0 && all_alike) return OverrunCause::machine;
  return static_cast<OverrunCause>(worst + 1);
}

}  // namespace ridgeline
