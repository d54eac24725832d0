// `pgm` on the real GL objects, judged by the oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "tests/methods/lost_inside.hpp"
#include "tests/methods/method_stand.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{256, 200, 60};
constexpr double range_m = 30'000;
constexpr GeodeticPosition first{46.4, 8.5, 2500};

class OneTile : public Land {
 public:
  explicit OneTile(sim::HeightFunction height_m) : Land(std::move(height_m)) { add_tile(46, 8); }
};

const Pose poses[] = {{{46.4, 8.5, 1600}, {0, -4, 20}},
                      {{46.55, 8.4, 2600}, {25, -8, 130}},
                      {{46.5, 8.6, 4500}, {0, -25, 250}},
                      {{46.5, 8.5, 5000}, {15, -80, 10}}};

/// Two metres up each post northwards, one eastwards: whole metres, so the tile stores it exactly.
double slope_m(double latitude_deg, double longitude_deg) {
  return std::round((latitude_deg - 46) * 1200) * 2 + std::round((longitude_deg - 8) * 1200) - 1500;
}

// Averages, their places and the blending of levels reproduce a plane, whatever the grid. What is
// left is the bend of the Earth between vertices.
TEST(Pgm, an_even_slope_is_drawn_as_it_is_by_any_grid) {
  const OneTile land(slope_m);
  MethodStand stand(land, image, range_m, first);
  for (const char* spec : {"pgm:grid=64x64", "pgm:grid=400x300"}) {
    stand.use(spec);
    for (const Pose& pose : poses) {
      const JudgedPicture judged = stand.judge(stand.draw(pose));
      std::printf("[ pgm ] %s: mean %.4f, max %.3f px\n", spec, judged.mean_px(), judged.max_px());
      EXPECT_LT(judged.percent_over(0.1), 1.0);
      EXPECT_LT(judged.mean_px(), 0.02);
    }
  }
}

TEST(Pgm, error_on_smooth_land_falls_with_the_grid) {
  const OneTile land(smooth_m);
  MethodStand stand(land, image, range_m, first);
  for (const Pose& pose : poses) {
    double last_px = 1e9;
    for (const char* spec : {"pgm:grid=32x32", "pgm:grid=128x128", "pgm:grid=512x512"}) {
      stand.use(spec);
      const JudgedPicture judged = stand.judge(stand.draw(pose));
      std::printf("[ pgm ] %s: mean %.4f, max %.3f px\n", spec, judged.mean_px(), judged.max_px());
      EXPECT_LT(judged.mean_px(), 0.5 * last_px) << spec;
      last_px = judged.mean_px();
    }
    EXPECT_LT(last_px, 0.02);
  }
}

TEST(Pgm, unknown_ground_stays_unknown) {
  const OneTile land(plain_with_hole_m);
  MethodStand stand(land, image, range_m, first);
  for (const Pose& pose :
       {Pose{{46.42, 8.5, 2500}, {5, -14, 3}}, Pose{{46.42, 8.5, 1200}, {0, -5, 0}}}) {
    stand.use_ours();
    const sim::Picture ours = stand.draw(pose);
    for (const char* spec : {"pgm", "pgm:grid=64x32"}) {
      stand.use(spec);
      const sim::Picture picture = stand.draw(pose);
      const UnknownCount count = count_unknown(ours, picture);
      std::printf("[ unknown ] %s: %d unknown, %d lost, %d invented\n", spec, count.unknown,
                  count.lost, count.invented);
      EXPECT_GT(count.unknown, 100);
      EXPECT_EQ(lost_inside(ours, picture), 0);
      EXPECT_LT(count.lost, count.unknown / 50);
    }
  }
}

// A mean over a void post's stored value would be a pit kilometres deep.
TEST(Pgm, a_single_void_post_is_unknown_and_no_pit) {
  const OneTile land(plain_with_specks_m);
  MethodStand stand(land, image, range_m, first);
  const Pose pose{{46.42, 8.5, 1500}, {0, -20, 3}};
  stand.use_ours();
  const sim::Picture ours = stand.draw(pose);
  for (const char* spec : {"pgm", "pgm:grid=64x32"}) {
    stand.use(spec);
    const sim::Picture picture = stand.draw(pose);
    EXPECT_EQ(elsewhere(ours, picture), 0);
    const UnknownCount count = count_unknown(ours, picture);
    std::printf("[ specks ] %s: %d unknown, %d lost\n", spec, count.unknown, count.lost);
    EXPECT_GT(count.unknown, 1000);
    EXPECT_LT(count.lost, count.unknown / 5);
  }
}

TEST(Pgm, every_pixel_is_written_and_two_draws_give_the_same_bits) {
  const RoughTile land;
  MethodStand stand(land, image, range_m, first);
  for (const char* spec : {"pgm", "pgm:grid=150x600"}) {
    sim::Method& method = stand.use(spec);
    const sim::Picture picture = stand.draw(poses[0]);
    expect_all_written(picture, range_m);
    stand.use_ours();  // what is left of another picture must not show
    stand.draw(poses[3]);
    stand.use(spec);
    EXPECT_EQ(bits_of(picture), bits_of(stand.draw(poses[0]))) << spec;
    EXPECT_EQ(method.facts().bound_px, 0.0);
    EXPECT_GT(method.facts().gpu_bytes, 1U << 16U);
  }
}

TEST(Pgm, a_frame_allocates_nothing_and_makes_no_gl_objects) {
  const RoughTile land;
  MethodStand stand(land, image, range_m, first);
  stand.use("pgm");
  stand.draw(poses[0]);
  const auto heap = heap_allocations_counted(), objects = gl_creations_counted();
  const auto heap_seen = heap_allocations_seen();
  for (const Pose& pose : poses) stand.draw(pose);
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
  EXPECT_GT(heap_allocations_seen(), heap_seen);  // pictures are allocated: counting works
}

// The grid reaches every part of the picture, however the camera looks: what is lost are peaks, not
// foregrounds, corners or whole columns.
TEST(Pgm, ground_is_whole_at_every_attitude) {
  const OneTile land(smooth_m);
  MethodStand stand(land, image, 20'000, first);
  for (const Attitude& attitude :
       {Attitude{0, -5, 0}, Attitude{60, -5, 90}, Attitude{180, -10, 200}, Attitude{-90, -20, 300},
        Attitude{0, -50, 45}, Attitude{30, -90, 10}, Attitude{10, -75, 120}, Attitude{0, 10, 60}}) {
    const Pose pose{{46.5, 8.5, 2600}, attitude};
    stand.use_ours();
    const sim::Picture ours = stand.draw(pose);
    stand.use("pgm:grid=256x256");
    const sim::Picture picture = stand.draw(pose);
    int ground = 0, lost = 0;
    for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
      const bool here = std::isfinite(ours.range_m[i]);
      ground += here ? 1 : 0;
      lost += here && !std::isfinite(picture.range_m[i]) ? 1 : 0;
    }
    EXPECT_LT(lost, ground / 100 + image.width_px)
        << attitude.roll_deg << ' ' << attitude.pitch_deg;
  }
}

TEST(Pgm, a_wrong_grid_is_refused_with_its_reason) {
  for (const char* spec : {"pgm:grid=8x300", "pgm:grid=300", "pgm:size=300x300"}) {
    sim::MethodSpec parsed;
    ASSERT_TRUE(sim::parse_method(spec, parsed).ok());
    std::string problem;
    EXPECT_EQ(sim::make_method(parsed, problem), nullptr);
    EXPECT_NE(problem.find("pgm"), std::string::npos) << problem;
  }
}

}  // namespace
}  // namespace ridgeline::test
