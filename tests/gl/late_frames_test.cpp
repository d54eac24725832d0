// A frame that runs late is finished with the larger bound that it has really reached, and every
// such picture is sound and complete for that bound.
#include <gtest/gtest.h>

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

class LateFrames : public testing::TestWithParam<Stall> {
 protected:
  /// Shoots all poses with every frame stalled so, and has every pixel judged.
  static void expect_sound_when_late(const Land& land) {
    const Stall& stall = GetParam();
    StallingClock clock;
    clock.stage = stall.stage;
    clock.reading = stall.reading;
    clock.stall_ns = 2 * limits::default_deadline_ns;
    FramePace pace({limits::default_deadline_ns, stall.error_px, limits::budget_most_px}, clock);
    // Each frame by itself, as if the ones before had been in time.
    Scene scene(land, options_of(stall.error_px), place);
    std::size_t drawn = 0;
    int coarser = 0;
    for (const Pose& pose : poses) {
      FramePace alone = pace;
      scene.settings().pace = &alone;
      const sim::Picture picture = scene.shoot(pose);
      const FrameReport& report = picture.report;
      if (report.availability.mode == Mode::removed) continue;
      ++drawn;
      coarser += report.finished_coarser ? 1 : 0;
      if (!report.finished_coarser) continue;
      EXPECT_EQ(report.bound_px, limits::budget_most_px);
      EXPECT_EQ(report.availability.mode, Mode::degraded);
      EXPECT_EQ(alone.budget().counters.late_finishes, 1U);
      EXPECT_EQ(report.work.rays, report.rays);
      EXPECT_LE(report.shared_px + report.budget.smallest_px(), report.bound_px);
    }
    EXPECT_GE(drawn, 4U);
    EXPECT_GE(coarser, 4);
    const oracle::VerifySummary summary = scene.judged(pixel_count);
    EXPECT_EQ(summary.frames - summary.removed_frames, drawn);
    EXPECT_EQ(summary.violations(), 0U) << (summary.details.empty() ? "" : summary.details.front());
    EXPECT_LE(summary.undecided, summary.pixels / 1000);
  }
};

TEST_P(LateFrames, are_sound_over_hills) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  expect_sound_when_late(land);
}

TEST_P(LateFrames, are_sound_over_spires) {
  const Land land(spires_m);
  land.add_tile(46, 8);
  expect_sound_when_late(land);
}

TEST_P(LateFrames, are_sound_over_rough_land_with_voids) {
  const RoughTile land;
  expect_sound_when_late(land);
}

INSTANTIATE_TEST_SUITE_P(Stalls, LateFrames,
                         testing::Values(Stall{FrameStage::plan, 1, 1.0},
                                         Stall{FrameStage::cast, 1, 0.3},
                                         Stall{FrameStage::cast, 1, 1.0},
                                         Stall{FrameStage::cast, 2, 1.5},
                                         Stall{FrameStage::cast, 3, 1.0}));

}  // namespace
}  // namespace ridgeline::test
