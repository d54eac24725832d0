#include "tests/oracle/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/oracle/scenes.hpp"

/// The judge on frames that are wrong by a known amount.
namespace ridgeline::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A frame of exact rays over one tile, and the judge of it after changes.
class Bench {
 public:
  Bench(const scenes::Surface& surface, const scenes::Shot& shot)
      : terrain_({scenes::tile(46, 8, 1200, 600, surface)}, Geoid()),
        frame(scenes::drawn(terrain_, shot)) {}

  [[nodiscard]] Judgement judged(int u, int v, bool strict_edge = false) const {
    const Tracer tracer(terrain_, frame.eye, frame.range_m);
    const Tracer longer(terrain_, frame.eye, frame.range_m * (1 + 2 * eta));
    return Judge(tracer, longer, frame, strict_edge).judge({u, v, std::nullopt, true});
  }
  /// What is truly seen at a place of the image, m.
  [[nodiscard]] double truth_m(double x, double y) const {
    return Tracer(terrain_, frame.eye, frame.range_m)
        .first_hit(Camera(frame).direction({x, y}))
        .distance_m;
  }
  void show(int u, int v, double z) {
    frame.range[static_cast<std::size_t>(v * frame.width + u)] = static_cast<float>(z);
  }

 private:
  Terrain terrain_;

 public:
  Frame frame;
};

scenes::Shot level_shot() {
  scenes::Shot shot;
  shot.eye = {46.2, 8.25, 1500};
  shot.pitch_deg = -6;
  shot.heading_deg = 20;
  shot.focal_px = 200;
  return shot;
}

double plain(double /*lat*/, double /*lon*/) {
  return 300;
}

/// A slope across the line of sight, so that the nearest place of a distance is not straight below.
double slope(double /*lat*/, double lon) {
  return std::round(40000 * (lon - 8.25)) + 1000;
}

TEST(Judge, the_error_on_a_plane_is_the_shift_that_was_made) {
  Bench bench(plain, level_shot());
  const ImagePoint down = Camera(bench.frame).image_down({32.5, 30.5});
  for (const double shift_px : {0.4, -0.4, 0.1, 0.02, -0.003, 4e-4}) {
    bench.show(32, 30, bench.truth_m(32.5 + shift_px * down.x, 30.5 + shift_px * down.y));
    const Judgement judgement = bench.judged(32, 30);
    EXPECT_EQ(judgement.soundness, Verdict::holds);
    ASSERT_TRUE(judgement.error_without_slack_px.has_value());
    const double size_px = std::abs(shift_px);
    EXPECT_LE(*judgement.error_without_slack_px, 1.03 * size_px) << shift_px;
    // The slack of 1e-6 and the float32 of the distance are worth 3e-5 px here.
    EXPECT_GE(*judgement.error_without_slack_px, 0.97 * size_px - 4e-5) << shift_px;
    // With the contract's slack the same is worth 2e-3 px.
    EXPECT_LE(judgement.error_px, *judgement.error_without_slack_px);
    EXPECT_GE(judgement.error_px, size_px - 0.01) << shift_px;
  }
}

TEST(Judge, the_nearest_place_is_found_across_a_slope) {
  scenes::Shot shot = level_shot();
  shot.eye.height_m = 9000;
  shot.heading_deg = 0;
  shot.pitch_deg = -25;
  Bench bench(slope, shot);
  const double centre_m = bench.truth_m(32.5, 24.5);
  const double down_m = (bench.truth_m(32.5, 24.6) - centre_m) / 0.1;
  const double right_m = (bench.truth_m(32.6, 24.5) - centre_m) / 0.1;
  ASSERT_GT(std::abs(right_m), 0.5 * std::abs(down_m));
  const double size = std::hypot(down_m, right_m);
  for (const double shift_px : {0.3, -0.3, 0.01}) {
    bench.show(32, 24,
               bench.truth_m(32.5 + shift_px * right_m / size, 24.5 + shift_px * down_m / size));
    const Judgement judgement = bench.judged(32, 24);
    EXPECT_NEAR(*judgement.error_without_slack_px, std::abs(shift_px),
                0.03 * std::abs(shift_px) + 1e-3);
  }
}

TEST(Judge, the_error_found_in_mountains_is_seldom_more_than_the_shift_made) {
  scenes::Shot shot = level_shot();
  shot.eye.height_m = 2600;
  Bench bench(scenes::rugged(2500, 3), shot);
  const Frame exact = bench.frame;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int judged = 0;
  int larger = 0;
  for (int i = 0; i < 400; ++i) {
    const int u = 2 + static_cast<int>(60 * unit(random));
    const int v = 2 + static_cast<int>(44 * unit(random));
    const double radius = 0.4 * unit(random);
    const double angle = 2 * pi * unit(random);
    bench.frame = exact;
    bench.show(
        u, v,
        bench.truth_m(u + 0.5 + radius * std::cos(angle), v + 0.5 + radius * std::sin(angle)));
    const Judgement judgement = bench.judged(u, v);
    EXPECT_EQ(judgement.soundness, Verdict::holds) << u << ' ' << v;
    ++judged;
    larger += judgement.error_px > 1.01 * radius + 0.002 ? 1 : 0;
    EXPECT_LE(judgement.error_px, 0.5);
  }
  EXPECT_LE(larger, judged / 40);
}

TEST(Judge, an_exact_pixel_has_no_error_at_all) {
  const Bench bench(scenes::rugged(2500, 3), level_shot());
  for (int u = 1; u < 64; u += 7) {
    const Judgement judgement = bench.judged(u, 40);
    EXPECT_EQ(judgement.error_px, 0);
    EXPECT_EQ(judgement.error_without_slack_px.value_or(1), 0);
    EXPECT_EQ(judgement.doubt, Doubt::none);
  }
}

TEST(Judge, a_hair_of_the_slack_leaves_undecided_and_more_violates) {
  scenes::Shot shot = level_shot();
  shot.bound_px = 1e-6;
  Bench bench(plain, shot);
  const double truth_m = bench.truth_m(32.5, 30.5);
  bench.show(32, 30, truth_m / (1 - 0.999 * eta));
  EXPECT_EQ(bench.judged(32, 30).soundness, Verdict::holds);
  bench.show(32, 30, truth_m / (1 - 1.0012 * eta));
  const Judgement hair = bench.judged(32, 30);
  EXPECT_EQ(hair.soundness, Verdict::undecided);
  EXPECT_EQ(hair.doubt, Doubt::slack_by_a_hair);
  bench.show(32, 30, truth_m / (1 - 1.01 * eta));
  const Judgement wrong = bench.judged(32, 30);
  EXPECT_EQ(wrong.soundness, Verdict::violated);
  EXPECT_EQ(wrong.doubt, Doubt::none);
}

TEST(Judge, a_hair_of_the_radius_leaves_undecided_and_more_violates) {
  Bench bench(plain, level_shot());
  const ImagePoint up = -1.0 * Camera(bench.frame).image_down({32.5, 30.5});
  const auto shown_at = [&](double part) {
    const double radius = part * *bench.frame.bound_px;
    bench.show(32, 30, bench.truth_m(32.5 + radius * up.x, 30.5 + radius * up.y) / (1 - eta));
    return bench.judged(32, 30);
  };
  EXPECT_EQ(shown_at(1 - 1e-4).soundness, Verdict::holds);
  const Judgement hair = shown_at(1 + 1e-4);
  EXPECT_EQ(hair.soundness, Verdict::undecided);
  EXPECT_EQ(hair.doubt, Doubt::radius_by_a_hair);
  EXPECT_EQ(shown_at(1 + 1e-3).soundness, Verdict::violated);
}

TEST(Judge, the_end_of_the_display_range_is_a_reason_of_its_own) {
  scenes::Shot shot = level_shot();
  shot.bound_px = 1e-6;
  Bench bench(plain, shot);
  const double truth_m = bench.truth_m(32.5, 30.5);
  bench.show(32, 30, infinity);
  bench.frame.range_m = truth_m * (1 + 0.5 * eta);
  const Judgement at_end = bench.judged(32, 30);
  EXPECT_EQ(at_end.soundness, Verdict::undecided);
  EXPECT_EQ(at_end.doubt, Doubt::end_of_range);
  EXPECT_EQ(at_end.completeness, Verdict::undecided);
  bench.frame.range_m = truth_m * (1 + 2 * eta);
  EXPECT_EQ(bench.judged(32, 30).soundness, Verdict::violated);
}

TEST(Judge, the_edge_of_the_image_lends_pixels_unless_it_is_strict) {
  scenes::Shot shot = level_shot();
  shot.bound_px = 1.01;
  Bench bench(plain, shot);
  const Frame exact = bench.frame;
  // Every pixel shows what stands one pixel higher: the last row's own ground is nowhere.
  for (int v = 1; v < exact.height; ++v) {
    for (int u = 0; u < exact.width; ++u) bench.show(u, v, exact.z(u, v - 1));
  }
  const Judgement inside = bench.judged(32, 30, true);
  EXPECT_EQ(inside.completeness, Verdict::holds);
  EXPECT_FALSE(inside.leans_on_edge);
  const Judgement lent = bench.judged(32, 47);
  EXPECT_EQ(lent.soundness, Verdict::holds);
  EXPECT_EQ(lent.completeness, Verdict::holds);
  EXPECT_TRUE(lent.leans_on_edge);
  EXPECT_EQ(bench.judged(32, 47, true).completeness, Verdict::violated);
}

/// A ridge across the line of sight.
double ridge(double lat, double /*lon*/) {
  return 300 + std::max(0.0, 900 - 90'000 * std::abs(lat - 46.3));
}

// 2026-11-23: a crest that passes a pixel's centre by less than the frame's own rounding.
TEST(Judge, what_rounding_can_move_is_told_from_what_is_left_out) {
  scenes::Shot shot = level_shot();
  shot.roll_deg = 10;  // the crest passes pixels' centres at every distance
  Bench bench(ridge, shot);
  bench.frame.bound_px = 0.25;
  int found = 0;
  for (int v = 1; v < bench.frame.height; ++v) {
    for (int u = 0; u < bench.frame.width; ++u) {
      const double here = bench.truth_m(u + 0.5, v + 0.5), above = bench.truth_m(u + 0.5, v + 0.42);
      if (!(here < 0.9 * above)) continue;
      ++found;
      const double shown = bench.frame.z(u, v);
      bench.show(u, v, above);
      bench.frame.geometry_px = std::nullopt;
      EXPECT_EQ(bench.judged(u, v).completeness, Verdict::violated);
      bench.frame.geometry_px = 0.01;
      EXPECT_EQ(bench.judged(u, v).completeness, Verdict::violated);
      bench.frame.geometry_px = 0.09;
      const Judgement within = bench.judged(u, v);
      EXPECT_EQ(within.soundness, Verdict::holds);
      EXPECT_EQ(within.completeness, Verdict::undecided);
      EXPECT_EQ(within.doubt, Doubt::completeness_within_geometry);
      bench.show(u, v, shown);
    }
  }
  EXPECT_GT(found, 0);
}

// 2026-11-23: the plane through a probe that meets the sky led to a ray of no direction.
TEST(Judge, an_error_beside_the_sky_is_measured_as_any_other) {
  Bench bench(ridge, level_shot());
  for (int v = 0; v < bench.frame.height; ++v) {
    for (int u = 0; u < bench.frame.width; u += 7) {
      const double z = bench.frame.z(u, v);
      if (!std::isfinite(z)) continue;
      bench.show(u, v, z * (1 + 3 * eta));
      const Judgement judgement = bench.judged(u, v);
      EXPECT_TRUE(std::isfinite(judgement.error_px));
    }
  }
}

TEST(Judge, every_doubt_has_a_name) {
  for (std::size_t i = 0; i < doubt_count; ++i) {
    EXPECT_NE(std::string(name_of(static_cast<Doubt>(i))), "");
  }
  EXPECT_STREQ(name_of(Doubt::completeness_by_a_hair), "completeness_by_a_hair");
}

}  // namespace
}  // namespace ridgeline::oracle
