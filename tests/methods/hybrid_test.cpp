// `hybrid` on the real GL objects, judged by the oracle.
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

// Everything ray cast but what reaches behind the eye; at the highest and the lowest precision.
constexpr const char* finest = "hybrid:t=1e9,k=0.001,cell=32";
constexpr const char* coarsest = "hybrid:t=1e9,k=1000,cell=32";

/// Share of the pixels that a ray has found (the last bit of a distance says so) whose error is
/// above 0.01 px, %.
double percent_of_rays_off(const sim::Picture& picture, const JudgedPicture& judged) {
  const auto words = bits_of(picture);
  int off = 0, cast = 0;
  for (const JudgedPixel& pixel : judged.pixels) {
    const std::size_t at = static_cast<std::size_t>(pixel.v) * image.width_px + pixel.u;
    if (!std::isfinite(picture.range_m[at]) || (words[at] & 1U) == 0) continue;
    ++cast;
    off += pixel.error_px > 0.01 ? 1 : 0;
  }
  EXPECT_GT(cast, 1000);
  return 100.0 * off / cast;
}

TEST(Hybrid, error_on_smooth_land_is_small_and_falls_with_precision) {
  const OneTile land(smooth_m);
  MethodStand stand(land, image, range_m, first);
  for (const Pose& pose : poses) {
    std::vector<double> off;
    for (const char* spec : {coarsest, "hybrid:t=1e9,cell=32,k=2", finest}) {
      stand.use(spec);
      const sim::Picture picture = stand.draw(pose);
      const JudgedPicture judged = stand.judge(picture);
      off.push_back(percent_of_rays_off(picture, judged));
      std::printf("[ hybrid ] %s: %.2f %% of rays over 0.01 px; all: mean %.4f, max %.3f px\n",
                  spec, off.back(), judged.mean_px(), judged.max_px());
      EXPECT_LT(judged.mean_px(), 0.01);
    }
    EXPECT_LT(off[2], 0.3 * off[0]);
    EXPECT_LE(off[2], off[1]);
    EXPECT_LE(off[1], off[0]);
    EXPECT_LT(off[2], 0.1);
  }
}

TEST(Hybrid, without_rays_it_is_the_full_mesh) {
  const OneTile land(rough_m);
  MethodStand stand(land, image, range_m, first);
  for (const Pose& pose : poses) {
    stand.use("mesh");
    const auto mesh = bits_of(stand.draw(pose));
    stand.use("hybrid:t=0");
    const sim::Picture picture = stand.draw(pose);
    const auto hybrid = bits_of(picture);
    EXPECT_EQ(picture.method.ray_cast_share, 0.0);
    int differ = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) differ += (mesh[i] | 1U) != (hybrid[i] | 1U);
    EXPECT_EQ(differ, 0);  // but the last bit, which says by what it was found
  }
}

TEST(Hybrid, more_is_ray_cast_the_higher_t) {
  const OneTile land(smooth_m);
  MethodStand stand(land, image, range_m, first);
  double last_share = -1e-9;
  for (const char* t : {"0", "20", "70", "1e9"}) {
    stand.use(std::string("hybrid:cell=32,t=") + t);
    const double share = stand.draw(poses[0]).method.ray_cast_share;
    EXPECT_GE(share, last_share) << t;
    last_share = share;
  }
  EXPECT_GT(last_share, 0.3);
}

TEST(Hybrid, unknown_ground_stays_unknown_and_known_ground_known) {
  const OneTile land(plain_with_hole_m);
  MethodStand stand(land, image, range_m, first);
  const Pose pose{{46.42, 8.5, 2500}, {5, -14, 3}};
  stand.use_ours();
  const sim::Picture ours = stand.draw(pose);
  for (const char* spec : {"hybrid", "hybrid:t=0", finest, coarsest}) {
    stand.use(spec);
    const UnknownCount count = count_unknown(ours, stand.draw(pose));
    std::printf("[ unknown ] %s: %d unknown, %d lost, %d invented\n", spec, count.unknown,
                count.lost, count.invented);
    EXPECT_GT(count.unknown, 1000);
    EXPECT_LT(count.lost + count.invented, count.unknown / 10);  // along the rim
  }
}

TEST(Hybrid, every_pixel_is_written_and_two_draws_give_the_same_bits) {
  const RoughTile land;
  MethodStand stand(land, image, range_m, first);
  for (const char* spec : {"hybrid", "hybrid:t=0,cell=50", finest, coarsest}) {
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

TEST(Hybrid, a_frame_allocates_nothing_and_makes_no_gl_objects) {
  const RoughTile land;
  MethodStand stand(land, image, range_m, first);
  stand.use("hybrid:cell=32");
  stand.draw(poses[0]);
  const auto heap = heap_allocations_counted(), objects = gl_creations_counted();
  const auto heap_seen = heap_allocations_seen();
  for (const Pose& pose : poses) stand.draw(pose);
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
  EXPECT_GT(heap_allocations_seen(), heap_seen);  // pictures are allocated: counting works
}

TEST(Hybrid, ground_is_whole_at_every_attitude) {
  const OneTile land(rough_m);
  MethodStand stand(land, image, 20'000, first);
  for (const Attitude& attitude :
       {Attitude{0, -5, 0}, Attitude{60, -5, 90}, Attitude{180, -10, 200}, Attitude{-90, -20, 300},
        Attitude{0, -50, 45}, Attitude{30, -90, 10}, Attitude{10, -75, 120}}) {
    const Pose pose{{46.5, 8.5, 2600}, attitude};
    stand.use_ours();
    const sim::Picture ours = stand.draw(pose);
    for (const char* spec : {"hybrid:cell=32", finest}) {
      stand.use(spec);
      const sim::Picture picture = stand.draw(pose);
      int ground = 0, lost = 0;
      for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
        if (!(ours.range_m[i] < 10'000)) continue;
        ++ground;
        lost += picture.range_m[i] < 20'000 ? 0 : 1;
      }
      EXPECT_GT(ground, 1000);
      EXPECT_LE(lost, ground / 500)
          << spec << ' ' << attitude.roll_deg << ' ' << attitude.pitch_deg;
    }
  }
}

TEST(Hybrid, says_which_setting_is_wrong) {
  for (const char* text : {"hybrid:t=-1", "hybrid:k=0", "hybrid:cell=4", "hybrid:cell=300",
                           "hybrid:colour=red", "hybrid:t=much"}) {
    sim::MethodSpec spec;
    ASSERT_TRUE(sim::parse_method(text, spec).ok()) << text;
    std::string problem;
    EXPECT_EQ(sim::make_method(spec, problem), nullptr) << text;
    EXPECT_NE(problem.find("hybrid"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace ridgeline::test
