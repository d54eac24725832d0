// `loffler` on the real GL objects, judged by the oracle.
#include "sim/methods/loffler.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>

#include "platform/gl_counter.hpp"
#include "platform/heap_counter.hpp"
#include "tests/gl/scene.hpp"
#include "tests/methods/method_judge.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{256, 200, 60};
constexpr double range_m = 30'000;
constexpr PixelSet whole{0, 0, 256, 200, 1};
constexpr PixelSet sample{0, 0, 256, 200, 3};

/// A session over a land that draws with `loffler` in as many variants as wanted.
class Stand {
 public:
  explicit Stand(const Land& land, double reach_m = range_m)
      : scene_(land, image, 1.0, reach_m, {46.4, 8.5, 2500}), judge_(land.path()) {}

  /// `settings`: as on the command line, after the colon.
  sim::Loffler& use(const std::string& settings) {
    sim::MethodSpec spec;
    EXPECT_TRUE(sim::parse_method("loffler" + settings, spec).ok());
    std::string problem;
    const sim::LofflerSettings read = sim::loffler_settings(spec, problem);
    EXPECT_EQ(problem, "");
    auto method = std::make_unique<sim::Loffler>(read);
    sim::Loffler& result = *method;
    scene_.session().use(&scene_.session().keep(std::move(method)));
    return result;
  }
  /// The module's own passes again, with a ray for every pixel.
  void use_ours() {
    scene_.settings().cast_every_pixel = true;
    scene_.session().use(nullptr);
  }

  sim::Picture draw(const Pose& pose) {
    sim::Picture picture = scene_.draw(pose);
    EXPECT_TRUE(picture.problem.ok()) << picture.problem.message;
    EXPECT_NE(picture.report.availability.mode, Mode::removed);
    return picture;
  }
  [[nodiscard]] JudgedPicture judge(const sim::Picture& picture, const PixelSet& set,
                                    double claim_px) const {
    return judge_.judge(picture, set, claim_px);
  }

 private:
  Scene scene_;
  MethodJudge judge_;
};

class RoughLand : public Land {
 public:
  RoughLand() : Land(rough_m) { add_tile(46, 8); }
};

const Pose poses[] = {{{46.4, 8.5, 2200}, {0, -4, 20}},
                      {{46.55, 8.4, 2600}, {25, -8, 130}},
                      {{46.5, 8.6, 4500}, {0, -25, 250}}};

std::vector<std::uint32_t> bits(const sim::Picture& picture) {
  std::vector<std::uint32_t> words;
  for (const float z : picture.range_m) words.push_back(std::bit_cast<std::uint32_t>(z));
  return words;
}

TEST(Loffler, warped_grid_beats_the_uniform_one_in_error_pixels_and_mean) {
  const RoughLand land;
  Stand stand(land);
  double uniform_over = 0, uniform_mean = 0, warped_over = 0, warped_mean = 0;
  for (const Pose& pose : {poses[0], poses[1]}) {
    stand.use(":grid=512x256,warp=0,rays=0");
    const JudgedPicture uniform = stand.judge(stand.draw(pose), sample, 1);
    stand.use(":grid=512x256,warp=1,rays=0");
    const JudgedPicture warped = stand.judge(stand.draw(pose), sample, 1);
    uniform_over += uniform.percent_over(1);
    warped_over += warped.percent_over(1);
    uniform_mean += uniform.mean_px();
    warped_mean += warped.mean_px();
    std::printf("[ claim ] over 1 px %.2f -> %.2f %%, mean %.3f -> %.3f px, max %.1f -> %.1f px\n",
                uniform.percent_over(1), warped.percent_over(1), uniform.mean_px(),
                warped.mean_px(), uniform.max_px(), warped.max_px());
  }
  EXPECT_LT(warped_over, uniform_over);
  EXPECT_LT(warped_mean, uniform_mean);
}

TEST(Loffler, rays_from_the_eye_are_exact_wherever_the_error_passes_the_threshold) {
  const RoughLand land;
  Stand stand(land);
  for (const Pose& pose : poses) {
    sim::Loffler& method = stand.use(":grid=256x128,from=eye,gamma=0.5");
    const sim::Picture picture = stand.draw(pose);
    std::vector<float> errors(picture.range_m.size());
    method.read_errors(errors);
    const JudgedPicture judged = stand.judge(picture, sample, 0.05);
    int cast = 0, wrong = 0, others = 0;
    for (const JudgedPixel& pixel : judged.pixels) {
      const bool is_cast = errors[static_cast<std::size_t>(pixel.v) * image.width_px + pixel.u] > 0;
      cast += is_cast ? 1 : 0;
      wrong += is_cast && pixel.unsound ? 1 : 0;
      others += !is_cast && pixel.unsound ? 1 : 0;
    }
    std::printf("[ rays ] %d of %zu cast, %d of them wrong, %d of the others\n", cast,
                judged.pixels.size(), wrong, others);
    EXPECT_GT(cast, 100);
    EXPECT_EQ(wrong, 0);
  }
}

TEST(Loffler, rays_make_the_picture_better_and_a_smaller_threshold_casts_more) {
  const RoughLand land;
  Stand stand(land);
  const Pose& pose = poses[0];
  stand.use(":grid=512x256,rays=0");
  const JudgedPicture grid = stand.judge(stand.draw(pose), sample, 1);
  double last_share = 0;
  for (const char* gamma : {"4", "1", "0.25"}) {
    stand.use(std::string(":grid=512x256,gamma=") + gamma);
    const sim::Picture picture = stand.draw(pose);
    EXPECT_GT(picture.method.ray_cast_share, last_share);
    last_share = picture.method.ray_cast_share;
    const JudgedPicture judged = stand.judge(picture, sample, 1);
    std::printf("[ gamma ] %s px: %.1f %% cast, over 1 px %.2f %% (grid alone %.2f %%)\n", gamma,
                100 * last_share, judged.percent_over(1), grid.percent_over(1));
    if (last_share > 0.1) {
      EXPECT_LT(judged.percent_over(1), grid.percent_over(1));
    }
  }
}

TEST(Loffler, unknown_ground_stays_unknown_and_known_ground_known) {
  const auto island = [](double latitude_deg, double longitude_deg) {
    const bool hole = std::abs(latitude_deg - 46.5) < 0.02 && std::abs(longitude_deg - 8.5) < 0.03;
    return hole ? std::nan("") : 300 + 20 * std::sin(latitude_deg * 500);
  };
  Land land(island);
  land.add_tile(46, 8);
  Stand stand(land);
  const Pose pose{{46.42, 8.5, 2500}, {5, -14, 3}};
  stand.use_ours();
  const sim::Picture truth = stand.draw(pose);
  for (const char* settings : {"", ":rays=0", ":warp=0", ":from=eye,gamma=0.1"}) {
    stand.use(settings);
    const sim::Picture picture = stand.draw(pose);
    int unknown = 0, differ = 0;
    for (std::size_t i = 0; i < truth.range_m.size(); ++i) {
      unknown += std::isnan(truth.range_m[i]) ? 1 : 0;
      differ += std::isnan(truth.range_m[i]) != std::isnan(picture.range_m[i]) ? 1 : 0;
    }
    std::printf("[ unknown ] %s: %d unknown, %d differ\n", settings, unknown, differ);
    EXPECT_GT(unknown, 1000);
    EXPECT_LT(differ, unknown / 50);  // the rim, where the grid is a little off
  }
}

TEST(Loffler, every_pixel_is_written_and_two_draws_give_the_same_bits) {
  const RoughTile land;
  Stand stand(land);
  for (const char* settings : {"", ":rays=0", ":warp=0,grid=64x32", ":grid=400x1900"}) {
    sim::Loffler& method = stand.use(settings);
    const std::vector<std::uint32_t> first = bits(stand.draw(poses[0]));
    // What is left of another picture must not show.
    stand.use_ours();
    stand.draw({{46.5, 8.5, 5000}, {0, -89, 0}});
    stand.use(settings);
    EXPECT_EQ(first, bits(stand.draw(poses[0]))) << settings;
    for (const std::uint32_t word : first) {
      const double z = static_cast<double>(std::bit_cast<float>(word));
      EXPECT_TRUE(std::isnan(z) || std::isinf(z) || (z > 0 && z <= 1.0001 * range_m)) << z;
    }
    EXPECT_GT(method.facts().gpu_bytes, 1U << 16U);
  }
}

TEST(Loffler, a_frame_allocates_nothing_and_makes_no_gl_objects) {
  const RoughTile land;
  Stand stand(land);
  stand.use("");
  stand.draw(poses[0]);
  const auto heap = heap_allocations_counted(), objects = gl_creations_counted();
  const auto heap_seen = heap_allocations_seen();
  for (const Pose& pose : poses) stand.draw(pose);
  EXPECT_EQ(heap_allocations_counted(), heap);
  EXPECT_EQ(gl_creations_counted(), objects);
  EXPECT_GT(heap_allocations_seen(), heap_seen);  // pictures are allocated: counting works
}

TEST(Loffler, draws_every_attitude_without_a_gap_at_the_edge) {
  // Between the ground and the border of the picture there must be no sky: the grid reaches it.
  const RoughLand land;
  Stand stand(land, 20'000);
  for (const Attitude& attitude :
       {Attitude{0, -5, 0}, Attitude{60, -5, 90}, Attitude{180, -10, 200}, Attitude{-90, -20, 300},
        Attitude{0, -50, 45}, Attitude{30, -90, 10}, Attitude{10, -75, 120}}) {
    const Pose pose{{46.5, 8.5, 2600}, attitude};
    stand.use_ours();
    const sim::Picture truth = stand.draw(pose);
    stand.use(":rays=0");
    const sim::Picture picture = stand.draw(pose);
    int lost = 0;
    for (std::size_t i = 0; i < truth.range_m.size(); ++i) {
      const bool near = truth.range_m[i] < 5000;
      lost += near && !(picture.range_m[i] < 20'000) ? 1 : 0;
    }
    EXPECT_LE(lost, 2) << attitude.roll_deg << ' ' << attitude.pitch_deg;
  }
}

TEST(Loffler, says_which_setting_is_wrong) {
  for (const char* text : {"loffler:warp=2", "loffler:grid=8x8", "loffler:grid=512",
                           "loffler:from=moon", "loffler:colour=red", "loffler:gamma=-1"}) {
    sim::MethodSpec spec;
    ASSERT_TRUE(sim::parse_method(text, spec).ok()) << text;
    std::string problem;
    EXPECT_EQ(sim::make_method(spec, problem), nullptr) << text;
    EXPECT_NE(problem, "") << text;
  }
}

}  // namespace
}  // namespace ridgeline::test
