// The frame-budget monitor on a model of the display: decisions and bounds, never wall time.
#include <gtest/gtest.h>

#include <set>

#include "tests/unit/monitor/model_display.hpp"

namespace ridgeline {
namespace {

using testing::ModelDisplay;
using testing::ModelFrame;
using testing::ModelMachine;

constexpr BudgetSettings settings{limits::default_deadline_ns, 0.25, limits::budget_most_px};
constexpr std::int64_t ms = 1'000'000;

/// A machine on which the full picture takes so many deadlines.
double slowness_for(const ModelDisplay& display, double deadlines) {
  return deadlines * static_cast<double>(settings.deadline_ns) /
         static_cast<double>(display.nominal_frame_ns(settings.wanted_px));
}

double share_in_time(const std::vector<ModelFrame>& frames, std::size_t from) {
  std::size_t in_time = 0;
  for (std::size_t k = from; k < frames.size(); ++k) {
    in_time += frames[k].in_time(settings.deadline_ns) ? 1 : 0;
  }
  return static_cast<double>(in_time) / static_cast<double>(frames.size() - from);
}

std::uint64_t overruns(const FramePace& pace) {
  std::uint64_t all = 0;
  for (std::size_t k = 1; k < overrun_cause_count; ++k) all += pace.budget().counters.overruns[k];
  return all;
}

std::uint64_t overruns_by(const FramePace& pace, OverrunCause cause) {
  return pace.budget().counters.overruns[static_cast<std::size_t>(cause)];
}

TEST(FrameBudget, a_fast_machine_draws_as_configured_and_stays_there) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  for (const ModelFrame& frame : display.frames(3000)) {
    ASSERT_EQ(frame.plan.step, 0);
    ASSERT_EQ(frame.bound_px, settings.wanted_px);
  }
  EXPECT_EQ(overruns(display.pace), 0U);
  EXPECT_EQ(display.pace.budget().counters.sheds, 0U);
}

TEST(FrameBudget, a_machine_three_times_too_slow_keeps_the_deadline_with_a_larger_bound) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 3.0);
  const std::vector<ModelFrame> frames = display.frames(3000);
  EXPECT_GE(share_in_time(frames, 30), 0.99);
  for (std::size_t k = 30; k < frames.size(); ++k) {
    EXPECT_GT(frames[k].bound_px, settings.wanted_px) << k;
    EXPECT_LE(frames[k].bound_px, settings.most_px) << k;
  }
}

TEST(FrameBudget, where_no_bound_is_coarse_enough_terrain_goes_and_is_tried_again_rarely) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 6.0);
  const std::vector<ModelFrame> frames = display.frames(6000);
  EXPECT_GE(share_in_time(frames, 30), 0.99);
  int trials = 0;
  for (std::size_t k = 30; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].bound_px, 0) << k;
    trials += frames[k].plan.on_trial ? 1 : 0;
  }
  EXPECT_GE(trials, 5);
  EXPECT_LE(trials, 20);
  EXPECT_EQ(display.pace.budget().counters.given_up, static_cast<std::uint64_t>(trials));
}

TEST(FrameBudget, a_load_that_ends_gives_the_configured_bound_back) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  const double fast = slowness_for(display, 0.6);
  for (const double load : {2.0, 4.0, 8.0}) {
    machine.slowness = load * fast;
    display.frames(200);
    EXPECT_GT(next_plan(display.pace.budget()).step, 0) << load;
    machine.slowness = fast;
    display.frames(1200);
    for (const ModelFrame& frame : display.frames(300)) ASSERT_EQ(frame.plan.step, 0) << load;
  }
}

TEST(FrameBudget, sheds_lines_then_soft_light_then_the_bound_then_terrain) {
  FrameBudget budget = frame_budget(settings);
  FramePlan before = next_plan(budget);
  EXPECT_EQ(before.detail, ShadeDetail::full);
  EXPECT_EQ(before.error_px, settings.wanted_px);
  for (budget.step = 1; budget.step < budget.none_step(); ++budget.step) {
    const FramePlan plan = next_plan(budget);
    EXPECT_TRUE(plan.terrain);
    EXPECT_EQ(plan.detail, budget.step == 1 ? ShadeDetail::no_lines : ShadeDetail::facets);
    if (budget.step <= 2) {
      EXPECT_EQ(plan.error_px, settings.wanted_px);
    } else {
      EXPECT_GT(plan.error_px, before.error_px);
    }
    before = plan;
  }
  EXPECT_EQ(before.error_px, settings.most_px);
  EXPECT_FALSE(next_plan(budget).terrain);
}

TEST(FrameBudget, one_stalled_frame_is_counted_and_changes_no_step) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  display.frames(50);
  for (const auto& [stage, cause] : {std::pair(FrameStage::cast, OverrunCause::cast),
                                     std::pair(FrameStage::shade, OverrunCause::shade),
                                     std::pair(FrameStage::terrain, OverrunCause::terrain),
                                     std::pair(FrameStage::plan, OverrunCause::plan),
                                     std::pair(FrameStage::input, OverrunCause::input)}) {
    machine.extra_ns = [stage = stage](FrameStage now) { return now == stage ? 40 * ms : 0; };
    const ModelFrame stalled = display.frame();
    machine.extra_ns = [](FrameStage) { return 0; };
    EXPECT_FALSE(stalled.in_time(settings.deadline_ns));
    EXPECT_EQ(overruns_by(display.pace, cause), 1U) << cause_word(cause);
    for (const ModelFrame& frame : display.frames(30)) {
      EXPECT_EQ(frame.plan.step, 0) << stage_word(stage);
      EXPECT_EQ(frame.bound_px, settings.wanted_px);
    }
  }
  EXPECT_EQ(display.pace.budget().counters.sheds, 0U);
}

TEST(FrameBudget, a_stall_in_the_cast_is_finished_in_time_with_the_bound_reached) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  display.frames(50);
  int readings = 0;
  machine.extra_ns = [&](FrameStage stage) {
    return stage == FrameStage::cast && ++readings == 1 ? 12 * ms : 0;
  };
  const ModelFrame frame = display.frame();
  EXPECT_TRUE(frame.coarser);
  EXPECT_EQ(frame.bound_px, settings.most_px);
  EXPECT_TRUE(frame.in_time(settings.deadline_ns));
  EXPECT_EQ(display.pace.budget().counters.late_finishes, 1U);
  EXPECT_EQ(display.pace.budget().counters.worst_px, settings.most_px);
}

TEST(FrameBudget, a_flooded_bus_makes_the_picture_coarser_not_late) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  display.frames(50);
  display.bus_frames = 300'000;  // 60 ms of the reference machine
  const std::vector<ModelFrame> frames = display.frames(600);
  EXPECT_GE(share_in_time(frames, 30), 0.99);
  EXPECT_GT(frames.back().plan.step, 0);
  EXPECT_TRUE(frames.back().plan.terrain);
}

TEST(FrameBudget, a_slow_disk_makes_the_picture_coarser_not_late) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  display.frames(50);
  machine.extra_ns = [](FrameStage stage) { return stage == FrameStage::terrain ? 15 * ms : 0; };
  const std::vector<ModelFrame> frames = display.frames(600);
  EXPECT_GE(share_in_time(frames, 30), 0.99);
  EXPECT_GT(frames.back().plan.step, 0);
  EXPECT_TRUE(frames.back().plan.terrain);
}

TEST(FrameBudget, a_busy_machine_is_named_as_such) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  display.frames(50);
  machine.slowness *= 6;
  display.frames(3);
  EXPECT_GE(overruns_by(display.pace, OverrunCause::machine), 1U);
  EXPECT_EQ(overruns(display.pace), overruns_by(display.pace, OverrunCause::machine));
}

TEST(FrameBudget, does_not_swing_when_the_better_picture_is_just_too_much) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  // Every better step lasts until something else takes a little time, again and again.
  machine.slowness = slowness_for(display, 0.75);
  int frame = 0;
  machine.extra_ns = [&](FrameStage stage) {
    return stage == FrameStage::shade && frame % 90 < 20 ? 9 * ms : 0;
  };
  std::uint64_t sheds_before = 0;
  for (frame = 0; frame < 9000; ++frame) {
    display.frame();
    if (frame == 4500) sheds_before = display.pace.budget().counters.sheds;
  }
  const std::uint64_t sheds = display.pace.budget().counters.sheds - sheds_before;
  EXPECT_LE(sheds, 4500U / limits::budget_most_hold_frames + 1) << "50 loads came and went";
}

TEST(FrameBudget, a_clock_that_goes_back_stands_still) {
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 0.7);
  machine.extra_ns = [](FrameStage stage) { return stage == FrameStage::plan ? -50 * ms : 0; };
  const ModelFrame frame = display.frame();
  EXPECT_GE(frame.elapsed_ns, 0);
  for (const PaceReading& reading : display.pace.record().readings) {
    EXPECT_GE(reading.elapsed_ns, 0);
  }
}

TEST(FrameBudget, the_same_readings_decide_the_same) {
  struct Again final : FrameClock {
    std::vector<std::int64_t> readings;
    std::size_t next = 0;
    std::int64_t elapsed_ns(FrameStage, const FrameWork&, ShadeDetail) override {
      return readings.at(next++);
    }
  };
  ModelMachine machine;
  ModelDisplay display(settings, machine);
  machine.slowness = slowness_for(display, 1.5);
  int count = 0;
  machine.extra_ns = [&](FrameStage) { return ++count % 41 == 0 ? 9 * ms : 0; };
  Again again;
  std::vector<ModelFrame> frames;
  for (int k = 0; k < 400; ++k) {
    frames.push_back(display.frame());
    for (const PaceReading& reading : display.pace.record().readings) {
      again.readings.push_back(reading.elapsed_ns);
    }
  }
  struct Player : ModelMachine {
    explicit Player(Again& from) : from_(from) {}
    std::int64_t elapsed_ns(FrameStage stage, const FrameWork& done, ShadeDetail detail) override {
      return from_.elapsed_ns(stage, done, detail);
    }
    Again& from_;
  } player(again);
  ModelDisplay second(settings, player);
  std::set<int> steps;
  for (const ModelFrame& frame : frames) {
    const ModelFrame repeated = second.frame();
    ASSERT_EQ(repeated.plan.step, frame.plan.step);
    ASSERT_EQ(repeated.bound_px, frame.bound_px);
    ASSERT_EQ(repeated.coarser, frame.coarser);
    steps.insert(frame.plan.step);
  }
  EXPECT_GE(steps.size(), 2U);
  EXPECT_EQ(again.next, again.readings.size());
}

TEST(FrameBudget, a_wanted_bound_past_the_largest_leaves_the_steps_of_shading) {
  const FrameBudget budget = frame_budget({limits::default_deadline_ns, 20.0, 8.0});
  EXPECT_EQ(budget.rungs, 0);
  EXPECT_EQ(budget.none_step(), 3);
  EXPECT_EQ(next_plan(budget).error_px, 20.0);
}

}  // namespace
}  // namespace ridgeline
