#include "tests/oracle/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/tracer.hpp"
#include "tests/unit/oracle/verify_scene.hpp"

namespace ridgeline::oracle {
namespace {

using scenes::changed;
using scenes::count;
using scenes::mountain_scene;
using scenes::mountain_shot;
using scenes::report;
using scenes::shifted;
using scenes::sky;
using scenes::unknown;
using Scene = scenes::VerifiedScene;

TEST(Verify, a_dump_of_exact_rays_holds) {
  const Frame frame = mountain_scene().drawn(mountain_shot());
  ASSERT_GT(count(frame, [](float z) { return z == sky; }), 100U);
  ASSERT_GT(count(frame, [](float z) { return std::isnan(z); }), 10U);
  ASSERT_GT(count(frame, [](float z) { return std::isfinite(z); }), 1000U);
  const VerifySummary summary = mountain_scene().verified(frame);
  EXPECT_EQ(summary.violations(), 0U) << report(summary);
  EXPECT_EQ(summary.undecided, 0U) << report(summary);
  EXPECT_EQ(summary.pixels, 400U);
  EXPECT_EQ(summary.error_max_px, 0);
  EXPECT_EQ(exit_status(summary), 0);
}

TEST(Verify, the_result_does_not_depend_on_the_threads) {
  const Frame frame = shifted(mountain_scene().drawn(mountain_shot()), 1, 0);
  EXPECT_EQ(report(mountain_scene().verified(frame, 1)),
            report(mountain_scene().verified(frame, 3)));
}

TEST(Verify, a_shift_is_measured_and_fails_only_beyond_the_bound) {
  const Frame exact = mountain_scene().drawn(mountain_shot());
  for (const auto& [du, dv] : {std::pair{1, 0}, std::pair{0, -1}, std::pair{2, 0}}) {
    Frame frame = shifted(exact, du, dv);
    const double size = std::hypot(du, dv);
    frame.bound_px = size * 1.01;
    const VerifySummary within = mountain_scene().verified(frame);
    EXPECT_EQ(within.soundness_violations, 0U) << du << ' ' << dv << report(within);
    EXPECT_GT(within.error_max_px, 0.8 * size);
    frame.bound_px = 0.5 * size;
    const VerifySummary beyond = mountain_scene().verified(frame);
    EXPECT_GT(beyond.soundness_violations, 20U) << du << ' ' << dv << report(beyond);
    EXPECT_LT(beyond.undecided, 12U) << report(beyond);
    EXPECT_EQ(exit_status(beyond), 1);
  }
}

/// A frame each of whose pixels shows what is truly there at a random place of its disc.
Frame random_choice(const scenes::Shot& shot, unsigned seed) {
  Frame frame = mountain_scene().drawn(shot);
  const Tracer tracer(mountain_scene().truth(), shot.eye, shot.range_m);
  const Camera camera(frame);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int v = 0; v < frame.height; ++v) {
    for (int u = 0; u < frame.width; ++u) {
      const double radius = 0.99 * shot.bound_px * std::sqrt(unit(random));
      const double angle = 2 * pi * unit(random);
      const FirstHit hit = tracer.first_hit(camera.direction(
          {u + 0.5 + radius * std::cos(angle), v + 0.5 + radius * std::sin(angle)}));
      frame.range[static_cast<std::size_t>(v * frame.width + u)] =
          hit.must_be_unknown ? unknown : static_cast<float>(hit.distance_m);
    }
  }
  return frame;
}

TEST(Verify, any_choice_within_the_bound_is_sound) {
  scenes::Shot shot = mountain_shot();
  shot.focal_px = 220;
  shot.height = 40;
  shot.pitch_deg = 0;
  for (const double bound_px : {1.5, 3.0, 6.0, 12.0}) {
    shot.bound_px = bound_px;
    const VerifySummary summary = mountain_scene().verified(random_choice(shot, 9));
    EXPECT_EQ(summary.soundness_violations, 0U) << report(summary);
    EXPECT_LE(summary.undecided, 1U) << report(summary);
    EXPECT_GT(summary.error_max_px, 0.45 * bound_px);
    EXPECT_LE(summary.error_max_px, bound_px);
    EXPECT_GT(summary.error_mean_px, 0.05 * bound_px);
  }
}

TEST(Verify, the_one_hill_of_a_large_disc_is_found_from_above) {
  // 2026-11: of a disc this large, seen steeply, rings of rays alone missed the nearest point.
  scenes::Shot shot = mountain_shot();
  shot.width = 160;
  shot.height = 120;
  shot.focal_px = 220;
  shot.pitch_deg = -75;
  shot.bound_px = 12;
  const VerifySummary summary = mountain_scene().verified(random_choice(shot, 9), 2, 3000);
  EXPECT_EQ(summary.soundness_violations, 0U) << report(summary);
  EXPECT_LE(summary.undecided, 1U) << report(summary);
}

TEST(Verify, distances_too_long_by_one_percent_fail) {
  const Frame exact = mountain_scene().drawn(mountain_shot());
  for (const float factor : {1.01F, 0.99F}) {
    Frame frame = changed(exact, [&](float z) { return z * factor; });
    frame.bound_px = 0.05;
    const VerifySummary summary = mountain_scene().verified(frame);
    EXPECT_GT(summary.soundness_violations, 100U) << report(summary);
    EXPECT_GT(summary.completeness_violations, 5U) << report(summary);
  }
}

TEST(Verify, a_look_straight_down_holds_and_fails_alike) {
  scenes::Shot shot = mountain_shot();
  shot.eye.height_m = 5000;
  shot.pitch_deg = -90;
  const Frame exact = mountain_scene().drawn(shot);
  const VerifySummary good = mountain_scene().verified(exact);
  EXPECT_EQ(good.violations() + good.undecided, 0U) << report(good);
  const VerifySummary off =
      mountain_scene().verified(changed(exact, [](float z) { return z * 1.05F; }));
  EXPECT_GT(off.soundness_violations, 200U) << report(off);
}

TEST(Verify, an_erased_spire_is_missed) {
  const auto spire = [](double lat, double lon) {
    return std::hypot(lat - 46.4, lon - 8.5) < 1e-6 ? 1500.0 : 100.0;
  };
  const Scene with(spire);
  const Scene without([](double, double) { return 100.0; });
  scenes::Shot shot;
  shot.eye = {46.3, 8.5, 1000};
  shot.focal_px = 200;
  shot.heading_deg = 0;
  const VerifySummary good = with.verified(with.drawn(shot));
  EXPECT_EQ(good.violations(), 0U) << report(good);
  const Frame erased = without.drawn(shot);
  const Scene* const scene = &with;
  const VerifySummary bad = scene->verified(erased);
  EXPECT_GT(bad.completeness_violations, 0U) << report(bad);
  // And a spire where none is.
  const VerifySummary invented = without.verified(with.drawn(shot));
  EXPECT_GT(invented.soundness_violations, 0U) << report(invented);
}

TEST(Verify, ground_that_must_be_unknown_may_be_painted_neither_as_sea_nor_as_sky) {
  const Scene scene(scenes::plain_with_void);
  scenes::Shot shot;
  shot.eye = {46.3, 8.5, 1500};
  shot.pitch_deg = -6;
  const Frame exact = scene.drawn(shot);
  const std::size_t unknowns = count(exact, [](float z) { return std::isnan(z); });
  ASSERT_GT(unknowns, 200U);
  const VerifySummary good = scene.verified(exact);
  EXPECT_EQ(good.violations() + good.undecided, 0U) << report(good);
  const Scene sea([](double, double) { return 0.0; });
  Frame sea_level = exact;
  const Frame flat = sea.drawn(shot);
  for (std::size_t i = 0; i < exact.range.size(); ++i) {
    if (std::isnan(exact.range[i])) sea_level.range[i] = flat.range[i];
  }
  const VerifySummary painted = scene.verified(sea_level);
  EXPECT_GT(painted.soundness_violations, 100U) << report(painted);
  const VerifySummary as_sky =
      scene.verified(changed(exact, [](float z) { return std::isnan(z) ? sky : z; }));
  EXPECT_GT(as_sky.soundness_violations, 100U) << report(as_sky);
}

TEST(Verify, known_ground_may_not_be_called_unknown) {
  const Scene scene([](double, double) { return 500.0; });
  scenes::Shot shot;
  shot.eye = {46.4, 8.5, 900};
  shot.pitch_deg = -30;
  shot.range_m = 20000;
  const Frame exact = scene.drawn(shot);
  const VerifySummary summary = scene.verified(changed(exact, [](float) { return unknown; }));
  EXPECT_GT(summary.soundness_violations, 390U) << report(summary);
}

TEST(Verify, a_missing_tile_is_unknown_ground) {
  const Scene scene([](double, double) { return 200.0; });
  scenes::Shot shot;
  shot.eye = {46.95, 8.5, 1200};  // looking out of the coverage
  shot.pitch_deg = -10;
  const Frame exact = scene.drawn(shot);
  ASSERT_GT(count(exact, [](float z) { return std::isnan(z); }), 100U);
  const VerifySummary good = scene.verified(exact);
  EXPECT_EQ(good.violations() + good.undecided, 0U) << report(good);
  const VerifySummary as_sky =
      scene.verified(changed(exact, [](float z) { return std::isnan(z) ? sky : z; }));
  EXPECT_GT(as_sky.soundness_violations, 60U) << report(as_sky);
}

TEST(Verify, sky_and_ground_may_not_change_places) {
  const Frame exact = mountain_scene().drawn(mountain_shot());
  const VerifySummary lost = mountain_scene().verified(changed(exact, [](float) { return sky; }));
  EXPECT_GT(lost.soundness_violations, 100U);
  EXPECT_GT(lost.completeness_violations, 100U);
  const VerifySummary invented =
      mountain_scene().verified(changed(exact, [](float z) { return z == sky ? 30000.0F : z; }));
  EXPECT_GT(invented.soundness_violations, 100U);
  EXPECT_GT(invented.completeness_violations, 50U);
}

TEST(Verify, a_wrong_attitude_is_a_fault_of_the_frame) {
  Frame frame = mountain_scene().drawn(mountain_shot());
  frame.pitch_deg += 0.01;
  const VerifySummary summary = mountain_scene().verified(frame);
  EXPECT_EQ(summary.frame_faults, 3U) << report(summary);
  EXPECT_EQ(exit_status(summary), 1);
}

TEST(Verify, an_attitude_is_that_of_the_axes_to_double_precision) {
  Frame frame = mountain_scene().drawn(mountain_shot());
  frame.heading_deg += 1e-6;
  EXPECT_GT(mountain_scene().verified(frame).frame_faults, 0U);
}

TEST(Verify, a_removed_frame_holds_no_bound_and_no_distances) {
  Frame frame = mountain_scene().drawn(mountain_shot());
  frame.mode = Mode::removed;
  frame.reasons = {"attitude"};
  EXPECT_EQ(mountain_scene().verified(frame).frame_faults, 2U);
  frame.bound_px.reset();
  frame.has_range_file = false;
  const VerifySummary summary = mountain_scene().verified(frame);
  EXPECT_EQ(summary.frame_faults, 0U) << report(summary);
  EXPECT_EQ(summary.removed_frames, 1U);
  EXPECT_EQ(summary.pixels, 0U);
}

TEST(Verify, a_drawn_frame_needs_a_bound) {
  Frame frame = mountain_scene().drawn(mountain_shot());
  frame.bound_px.reset();
  EXPECT_EQ(mountain_scene().verified(frame).frame_faults, 1U);
}

TEST(Verify, a_frame_drawn_with_another_geoid_is_refused) {
  Frame frame = mountain_scene().drawn(mountain_shot());
  frame.geoid = "egm96_15.gtx";
  EXPECT_THROW((void)mountain_scene().verified(frame), InputError);
}

}  // namespace
}  // namespace ridgeline::oracle
