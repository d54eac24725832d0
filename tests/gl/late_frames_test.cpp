// A frame that runs late is finished with the larger bound that it has really reached, and every
// such picture is sound and complete for that bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/monitor/frame_pace.hpp"
#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{256, 200, 60};
constexpr int pixel_count = image.width_px * image.height_px;
constexpr GeodeticPosition place{46.5, 8.5, 0};

double hills_m(double latitude_deg, double longitude_deg) {
  return 400 + 60 * std::sin(150 * latitude_deg) * std::cos(110 * longitude_deg);
}

double spires_m(double latitude_deg, double longitude_deg) {
  const auto row = std::llround(latitude_deg * 1200), column = std::llround(longitude_deg * 1200);
  return hills_m(latitude_deg, longitude_deg) + (row % 17 == 3 && column % 13 == 5 ? 500.0 : 0.0);
}

const std::vector<Pose> poses{{{46.5, 8.5, 900}, {0, -4, 30}},
                              {{46.51, 8.47, 1100}, {37, -12, 160}},
                              {{46.48, 8.52, 700}, {-90, -6, 275}},
                              {{46.5, 8.5, 1800}, {180, -35, 80}},
                              {{46.5, 8.5, 2500}, {0, -80, 10}}};

/// A fast machine that stops once in every frame: when the reading of a stage comes round for the
/// `reading`-th time.
class StallingClock : public FrameClock {
 public:
  FrameStage stage = FrameStage::cast;
  int reading = 1;
  std::int64_t stall_ns = 0;

  std::int64_t elapsed_ns(FrameStage at, const FrameWork& /*done*/, ShadeDetail) override {
    if (at == FrameStage::input) {
      now_ns_ = 0;
      readings_ = 0;
    }
    if (at == stage && ++readings_ == reading) now_ns_ += stall_ns;
    return now_ns_ += 1000;
  }

 private:
  std::int64_t now_ns_ = 0;
  int readings_ = 0;
};

sim::SceneOptions options_of(double error_px) {
  sim::SceneOptions options;
  options.settings.image = image;
  options.settings.error_px = error_px;
  options.settings.range_m = 12'000;
  return options;
}

struct Stall {
  FrameStage stage;
  int reading;
  double error_px;
};

/// Draws all poses with every frame stalled so, has every pixel of every picture judged, and
/// expects so many frames finished with a larger bound.
void expect_sound_when_late(const Land& land, const Stall& stall, int least_coarser) {
  StallingClock clock;
  clock.stage = stall.stage;
  clock.reading = stall.reading;
  clock.stall_ns = 2 * limits::default_deadline_ns;
  const FramePace in_time({limits::default_deadline_ns, stall.error_px, limits::budget_most_px},
                          clock);
  Scene scene(land, options_of(stall.error_px), place);
  std::size_t drawn = 0;
  int coarser = 0;
  for (const Pose& pose : poses) {
    FramePace pace = in_time;  // each frame by itself, as if those before had been in time
    scene.settings().pace = &pace;
    const sim::Picture picture = scene.shoot(pose);
    const FrameReport& report = picture.report;
    if (report.availability.mode == Mode::removed) continue;
    ++drawn;
    EXPECT_EQ(report.work.rays, report.rays);
    if (!report.finished_coarser) continue;
    ++coarser;
    EXPECT_EQ(report.bound_px, limits::budget_most_px);
    EXPECT_EQ(report.availability.mode, Mode::degraded);
    EXPECT_EQ(pace.budget().counters.late_finishes, 1U);
    EXPECT_LE(report.shared_px + report.budget.smallest_px(), report.bound_px);
  }
  EXPECT_GE(coarser, least_coarser);
  const oracle::VerifySummary summary = scene.judged(pixel_count);
  EXPECT_EQ(summary.frames - summary.removed_frames, drawn);
  EXPECT_EQ(summary.violations(), 0U) << (summary.details.empty() ? "" : summary.details.front());
  EXPECT_LE(summary.undecided, summary.pixels / 1000);
}

TEST(LateFrames, are_sound_when_planned_anew_from_the_start) {
  const Land land(spires_m);
  land.add_tile(46, 8);
  expect_sound_when_late(land, {FrameStage::plan, 1, 1.0}, 4);
}

TEST(LateFrames, are_sound_when_cut_below_single_rays) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  expect_sound_when_late(land, {FrameStage::cast, 1, 0.3}, 4);
}

TEST(LateFrames, are_sound_when_cut_below_shared_rays) {
  const Land land(spires_m);
  land.add_tile(46, 8);
  expect_sound_when_late(land, {FrameStage::cast, 1, 1.0}, 4);
  expect_sound_when_late(land, {FrameStage::cast, 2, 1.5}, 4);
}

TEST(LateFrames, are_sound_beside_voids) {
  const RoughTile land;
  expect_sound_when_late(land, {FrameStage::cast, 1, 1.0}, 3);
}

/// After the last band nothing is left that could be coarser: the frame is finished as planned, and
/// is late.
TEST(LateFrames, keep_their_bound_where_too_little_is_left) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  StallingClock clock;
  const BudgetSettings settings{limits::default_deadline_ns, 1.0, limits::budget_most_px};
  FramePace in_time(settings, clock), late(settings, clock);
  Scene scene(land, options_of(1.0), place);
  scene.settings().pace = &in_time;
  scene.draw(poses.front());
  clock.reading = static_cast<int>(
      std::ranges::count(in_time.record().readings.view(), FrameStage::cast, &PaceReading::stage));
  EXPECT_GT(clock.reading, 1);
  clock.stall_ns = 2 * limits::default_deadline_ns;
  scene.settings().pace = &late;
  const sim::Picture picture = scene.draw(poses.front());
  EXPECT_FALSE(picture.report.finished_coarser);
  EXPECT_EQ(picture.report.bound_px, 1.0);
  EXPECT_EQ(late.budget().counters.overruns[static_cast<std::size_t>(OverrunCause::cast)], 1U);
}

/// On trial, after frames without terrain, a frame that is late goes without it as well.
TEST(LateFrames, on_trial_are_given_up) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  WorkClock slow(300.0);
  FramePace pace({limits::default_deadline_ns, 1.0, limits::budget_most_px}, slow);
  Scene scene(land, options_of(1.0), place);
  scene.settings().pace = &pace;
  int without = 0;
  for (int k = 0; k < 2 + limits::budget_none_hold_frames + 3; ++k) {
    const sim::Picture picture = scene.draw(poses.front());
    without += picture.report.availability.mode == Mode::removed ? 1 : 0;
    if (pace.budget().counters.given_up > 0) {
      EXPECT_EQ(picture.report.availability.mode, Mode::removed);
      EXPECT_EQ(picture.report.bound_px, 0);
      break;
    }
  }
  EXPECT_EQ(pace.budget().counters.given_up, 1U);
  EXPECT_GE(without, limits::budget_none_hold_frames);
}

/// A monitor that has nothing to do changes no bit of the ranges and the colours.
TEST(LateFrames, in_time_are_the_frames_without_a_monitor) {
  const Land land(spires_m);
  land.add_tile(46, 8);
  StallingClock clock;
  FramePace pace({limits::default_deadline_ns, 1.0, limits::budget_most_px}, clock);
  Scene scene(land, options_of(1.0), place);
  for (const Pose& pose : poses) {
    scene.settings().pace = nullptr;
    const sim::Picture without = scene.draw(pose);
    scene.settings().pace = &pace;
    const sim::Picture with = scene.draw(pose);
    EXPECT_EQ(with.rgb, without.rgb);
    ASSERT_EQ(with.range_m.size(), without.range_m.size());
    for (std::size_t k = 0; k < with.range_m.size(); ++k) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(with.range_m[k]),
                std::bit_cast<std::uint32_t>(without.range_m[k]));
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
