// `warp` on the real GL objects, judged by the oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
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
                      {{46.5, 8.6, 4500}, {0, -25, 250}}};

TEST(Warp, error_on_smooth_land_is_small_and_falls_with_the_grid) {
  const OneTile land(smooth_m);
  MethodStand stand(land, image, range_m, first);
  for (const Pose& pose : poses) {
    double last_mean_px = 1e9;
    for (const char* grid : {"64", "128", "256", "512"}) {
      stand.use(std::string("warp:grid=") + grid);
      const JudgedPicture judged = stand.judge(stand.draw(pose));
      std::printf("[ warp ] grid %s: mean %.4f px, max %.3f px, over 1 px %.3f %%\n", grid,
                  judged.mean_px(), judged.max_px(), judged.percent_over(1));
      EXPECT_LT(judged.mean_px(), last_mean_px);
      last_mean_px = judged.mean_px();
    }
    EXPECT_LT(last_mean_px, 0.05);
  }
}

TEST(Warp, unknown_ground_stays_unknown_and_known_ground_known) {
  const OneTile land(plain_with_hole_m);
  MethodStand stand(land, image, range_m, first);
  const Pose pose{{46.42, 8.5, 2500}, {5, -14, 3}};
  stand.use_ours();
  const sim::Picture ours = stand.draw(pose);
  for (const char* spec : {"warp", "warp:grid=64", "warp:detail=1"}) {
    stand.use(spec);
    const UnknownCount count = count_unknown(ours, stand.draw(pose));
    std::printf("[ unknown ] %s: %d unknown, %d lost, %d invented\n", spec, count.unknown,
                count.lost, count.invented);
    EXPECT_GT(count.unknown, 1000);
    EXPECT_LT(count.lost, count.unknown / 50);
    EXPECT_LT(count.invented, count.unknown / 5);  // triangles over the rim are unknown
  }
}

TEST(Warp, every_pixel_is_written_and_two_draws_give_the_same_bits) {
  const RoughTile land;
  MethodStand stand(land, image, range_m, first);
  for (const char* spec : {"warp", "warp:grid=33,map=17", "warp:detail=1"}) {
    sim::Method& method = stand.use(spec);
    const sim::Picture picture = stand.draw(poses[0]);
    expect_all_written(picture, range_m);
    stand.use_ours();  // what is left of another picture must not show
    stand.draw({{46.5, 8.5, 5000}, {0, -89, 0}});
    stand.use(spec);
    EXPECT_EQ(bits_of(picture), bits_of(stand.draw(poses[0]))) << spec;
    EXPECT_EQ(method.facts().bound_px, 0.0);
    EXPECT_GT(method.facts().gpu_bytes, 1U << 16U);
  }
}

TEST(Warp, a_frame_allocates_nothing_and_makes_no_gl_objects) {
  const RoughTile land;
  MethodStand stand(land, image, range_m, first);
  stand.use("warp");
  stand.draw(poses[0]);
  const auto heap = heap_allocations_counted(), objects = gl_creations_counted();
  const auto heap_seen = heap_allocations_seen();
  for (const Pose& pose : poses) stand.draw(pose);
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
  EXPECT_GT(heap_allocations_seen(), heap_seen);  // pictures are allocated: counting works
}

TEST(Warp, near_ground_is_whole_at_every_attitude) {
  const OneTile land(rough_m);
  MethodStand stand(land, image, 20'000, first);
  for (const Attitude& attitude :
       {Attitude{0, -5, 0}, Attitude{60, -5, 90}, Attitude{180, -10, 200}, Attitude{-90, -20, 300},
        Attitude{0, -50, 45}, Attitude{30, -90, 10}, Attitude{10, -75, 120}}) {
    const Pose pose{{46.5, 8.5, 2600}, attitude};
    stand.use_ours();
    const sim::Picture ours = stand.draw(pose);
    stand.use("warp");
    const sim::Picture picture = stand.draw(pose);
    int lost = 0, near = 0;
    for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
      if (!(ours.range_m[i] < 10'000)) continue;
      ++near;
      lost += picture.range_m[i] < 20'000 ? 0 : 1;
    }
    EXPECT_GT(near, 1000);
    EXPECT_LE(lost, near / 500) << attitude.roll_deg << ' ' << attitude.pitch_deg;
  }
}

TEST(Warp, detail_changes_rough_land_leaves_the_sea_and_says_so) {
  const OneTile rough(rough_m), sea([](double, double) { return 0.0; });
  const Pose low{{46.4, 8.5, 1500}, {0, -12, 20}};
  MethodStand over_rough(rough, image, range_m, first);
  const std::string plain_words = over_rough.use("warp").params();
  const sim::Picture plain = over_rough.draw(low);
  const std::string words = over_rough.use("warp:detail=1").params();
  const sim::Picture detailed = over_rough.draw(low);
  EXPECT_EQ(plain_words.find("not the data"), std::string::npos);
  EXPECT_NE(words.find("not the data"), std::string::npos);
  int moved = 0, lit = 0, sky = 0;
  for (std::size_t i = 0; i < plain.range_m.size(); ++i) {
    const double a = plain.range_m[i], b = detailed.range_m[i];
    const int change = std::abs(plain.rgb[3 * i + 1] - detailed.rgb[3 * i + 1]);
    if (std::isfinite(a) && std::isfinite(b)) moved += std::abs(a / b - 1) > 1e-4 ? 1 : 0;
    if (std::isfinite(a) && std::isfinite(b)) lit += change > 3 ? 1 : 0;
    if (std::isinf(a) && std::isinf(b)) sky += change > 0 ? 1 : 0;
  }
  EXPECT_GT(moved, 2000);
  EXPECT_GT(lit, 5000);
  EXPECT_EQ(sky, 0);

  MethodStand over_sea(sea, image, range_m, first);
  over_sea.use("warp");
  const sim::Picture calm = over_sea.draw(low);
  over_sea.use("warp:detail=1");
  const sim::Picture as_calm = over_sea.draw(low);
  int changed = 0;
  for (std::size_t i = 0; i < calm.rgb.size(); ++i) {
    changed += std::abs(calm.rgb[i] - as_calm.rgb[i]) > 3 ? 1 : 0;  // blending rounds
  }
  EXPECT_LT(changed, 100);  // where a grid line falls upon the next pixel
  EXPECT_LT(over_sea.judge(as_calm).mean_px(), 0.02);
}

TEST(Warp, says_which_setting_is_wrong) {
  for (const char* text : {"warp:grid=4", "warp:grid=many", "warp:detail=2", "warp:edge=0",
                           "warp:colour=red", "warp:map=9999"}) {
    sim::MethodSpec spec;
    ASSERT_TRUE(sim::parse_method(text, spec).ok()) << text;
    std::string problem;
    EXPECT_EQ(sim::make_method(spec, problem), nullptr) << text;
    EXPECT_NE(problem.find("warp"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace ridgeline::test
