// Methods beside ours: what a session does with them, and mesh and Embree judged by the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/bench/bench_judge.hpp"
#include "sim/bench/bench_method.hpp"
#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{200, 150, 30};
constexpr double range_m = 26'000;
constexpr int judged = 1500;
const Pose down{{46.5, 8.5, 3000}, {3, -40, 20}};
const Pose along{{46.5, 8.5, 1700}, {-4, -6, 140}};

/// Posts are whole metres on a plane through latitude and longitude: no cell is bent.
double plane_m(double latitude_deg, double longitude_deg) {
  return 2 * std::round((latitude_deg - 46) * 1200) - std::round((longitude_deg - 8) * 1200) + 700;
}

/// The same with 0 to 4 m more at every post.
double uneven_m(double latitude_deg, double longitude_deg) {
  const auto bits = static_cast<std::uint64_t>(std::llround(latitude_deg * 1200) * 7919 +
                                               std::llround(longitude_deg * 1200) * 104'729);
  return plane_m(latitude_deg, longitude_deg) + static_cast<double>((bits ^ (bits >> 7U)) % 5);
}

class Flat : public Land {
 public:
  explicit Flat(sim::HeightFunction height_m) : Land(std::move(height_m)) { add_tile(46, 8); }
};

/// A scene drawn by one method, null where this build lacks it.
std::unique_ptr<Scene> scene_of(const Land& land, const char* method) {
  sim::SceneOptions options;
  options.settings.image = image;
  options.settings.range_m = range_m;
  EXPECT_TRUE(sim::parse_method(method, options.method).ok());
  std::string problem;
  const bool own = sim::is_own_method(options.method);
  if (!own && sim::make_method(options.method, problem) == nullptr) {
    EXPECT_NE(problem.find("absent"), std::string::npos) << problem;
    return nullptr;
  }
  const std::string wrong =
      own ? sim::apply_own_method(options.method, options.settings) : std::string{};
  EXPECT_EQ(wrong, "");
  return std::make_unique<Scene>(land, options, down.eye);
}

sim::SceneOptions oracle_scene(const Land& land) {
  sim::SceneOptions options;
  options.terrain_folder = land.path();
  return options;
}

sim::BenchError error_of(const Land& land, const sim::Picture& picture) {
  sim::BenchJudge judge(oracle_scene(land));
  judge.begin_view(picture, judged);
  return judge.error_of(picture);
}

TEST(Methods, on_a_plane_triangles_are_exact_but_for_rounding) {
  const Flat land(plane_m);
  for (const char* method : {"mesh", "embree"}) {
    const auto scene = scene_of(land, method);
    if (scene == nullptr) continue;
    for (const Pose& pose : {down, along}) {
      const sim::Picture picture = scene->draw(pose);
      ASSERT_EQ(picture.range_m.size(), 200U * 150U) << method;
      const sim::BenchError error = error_of(land, picture);
      EXPECT_EQ(error.wrong_class, 0) << method;
      EXPECT_LE(error.worst_px, 0.05) << method;
    }
  }
}

TEST(Methods, two_triangles_a_cell_are_within_a_quarter_of_the_corner_difference) {
  const Flat land(uneven_m);
  for (const char* method : {"mesh", "embree"}) {
    const auto scene = scene_of(land, method);
    if (scene == nullptr) continue;
    const sim::Picture picture = scene->draw(down);
    // |NE - NW - SE + SW| <= 8 m, so 2 m, seen from above at an angle: an upper bound on its image.
    double nearest_m = 1e9;
    for (const float z : picture.range_m) nearest_m = std::min(nearest_m, static_cast<double>(z));
    const double allowed_px = 2.0 * picture.report.camera.fx / nearest_m;
    const sim::BenchError error = error_of(land, picture);
    EXPECT_LE(error.worst_px, allowed_px) << method;
    EXPECT_GT(error.mean_px(), 0.005) << method << ": the departure is there and is seen";
  }
}

/// Whether all pixels within `radius` of one are unknown, or all are known.
bool is_uniform(const sim::Picture& picture, int u, int v, int radius) {
  const auto unknown = [&](int x, int y) {
    return std::isnan(picture.range_m[static_cast<std::size_t>(y) * image.width_px + x]);
  };
  for (int y = std::max(0, v - radius); y <= std::min(image.height_px - 1, v + radius); ++y) {
    for (int x = std::max(0, u - radius); x <= std::min(image.width_px - 1, u + radius); ++x) {
      if (unknown(x, y) != unknown(u, v)) return false;
    }
  }
  return true;
}

TEST(Methods, unknown_ground_is_unknown_to_all_but_for_its_border) {
  const RoughTile land;
  const auto exact = scene_of(land, "raycast");
  const Pose pose{{46.5, 8.5, 6000}, {0, -35, 60}};
  const sim::Picture truth = exact->draw(pose);
  constexpr int border_px = 5;  // a cell, or a little more
  for (const char* method : {"mesh", "embree"}) {
    const auto scene = scene_of(land, method);
    if (scene == nullptr) continue;
    const sim::Picture picture = scene->draw(pose);
    int unknown = 0, known = 0;
    for (int v = 0; v < image.height_px; ++v) {
      for (int u = 0; u < image.width_px; ++u) {
        if (!is_uniform(truth, u, v, border_px)) continue;
        const auto k = static_cast<std::size_t>(v) * image.width_px + u;
        const bool is_unknown = std::isnan(truth.range_m[k]);
        (is_unknown ? unknown : known) += 1;
        EXPECT_EQ(is_unknown, std::isnan(picture.range_m[k])) << method << ' ' << u << ' ' << v;
      }
    }
    EXPECT_GT(unknown, 20);
    EXPECT_GT(known, 10'000);
  }
}

TEST(Methods, a_method_follows_the_eye_into_another_window) {
  const Flat land(plane_m);
  for (const char* method : {"mesh", "embree"}) {
    const auto scene = scene_of(land, method);
    if (scene == nullptr) continue;
    scene->draw(down);
    Pose far = down;
    far.eye.latitude_deg += 0.3;  // more than five blocks
    far.eye.longitude_deg -= 0.25;
    const sim::Picture picture = scene->draw(far);
    const sim::BenchError error = error_of(land, picture);
    EXPECT_LE(error.worst_px, 0.05) << method;
    EXPECT_EQ(error.wrong_class, 0) << method;
  }
}

TEST(Methods, say_that_they_promise_nothing) {
  const Flat land(plane_m);
  const auto scene = scene_of(land, "mesh");
  const sim::Picture picture = scene->shoot(down);
  EXPECT_EQ(picture.report.availability.mode, Mode::degraded);
  EXPECT_EQ(picture.report.availability.reasons[0], Reason::unproven);
  EXPECT_EQ(picture.report.bound_px, 0);
  EXPECT_GT(picture.method.gpu_bytes, 0U);
  const oracle::VerifySummary summary = scene->judged(50);
  EXPECT_EQ(summary.pixels, 0U);
  EXPECT_EQ(summary.frame_faults, 1U);
  ASSERT_EQ(summary.details.size(), 1U);
  EXPECT_NE(summary.details[0].find("promises none"), std::string::npos) << summary.details[0];
}

TEST(Methods, leave_nothing_behind_in_the_frames_of_the_module) {
  const RoughTile land;
  const auto scene = scene_of(land, "ridgeline");
  const sim::Picture before = scene->draw(along);
  for (const std::string_view name : sim::method_names()) {
    std::string problem;
    auto method = sim::make_method({std::string(name), {}}, problem);
    if (method == nullptr) continue;
    scene->session().use(&scene->session().keep(std::move(method)));
    EXPECT_TRUE(scene->draw(along).problem.ok()) << name;
    scene->session().use(nullptr);
    const sim::Picture after = scene->draw(along);
    EXPECT_EQ(before.rgb, after.rgb) << name;
  }
}

TEST(BenchMethods, in_turn_each_bound_keeps_what_its_blocks_bear) {
  const Flat land(plane_m);
  Scene scene(land, image, 1.0, range_m, down.eye);
  std::vector<sim::MethodSpec> specs;
  ASSERT_TRUE(sim::parse_methods("ridgeline:error=1,ridgeline:error=8,mesh", specs).ok());
  std::vector<sim::BenchMethod> methods;
  std::vector<sim::AbsentMethod> absent;
  ASSERT_TRUE(sim::make_bench_methods(specs, false, scene.session(), methods, absent).ok());
  ASSERT_EQ(methods.size(), 3U);
  EXPECT_EQ(methods[2].bearing, nullptr);
  const auto draw_all = [&] {
    for (const sim::BenchMethod& method : methods) {
      scene.settings() = method.settings;
      scene.session().use(method.method, method.bearing.get());
      const sim::Picture picture = scene.draw(along);
      EXPECT_TRUE(picture.problem.ok());
      if (method.method == nullptr) {
        EXPECT_LT(picture.report.rays, image.width_px * image.height_px);
      }
    }
  };
  draw_all();
  const BlockBearing first = *methods[0].bearing, second = *methods[1].bearing;
  const auto asked = [](const BlockBearing& bearing) {
    return std::count_if(bearing.steepest.begin(), bearing.steepest.end(),
                         [](float slope) { return slope >= 0; });
  };
  EXPECT_GT(asked(first), 0);
  EXPECT_GT(asked(second), 0);
  EXPECT_LT(first.reach_px, second.reach_px);
  draw_all();
  for (const auto& [before, after] : {std::pair(&first, methods[0].bearing.get()),
                                      std::pair(&second, methods[1].bearing.get())}) {
    EXPECT_EQ(before->reach_px, after->reach_px);
    EXPECT_EQ(before->steepest, after->steepest);
  }
}

TEST(BenchJudge, our_own_pictures_are_within_their_bound_and_damage_is_measured) {
  const RoughTile land;
  const auto scene = scene_of(land, "ridgeline:error=1");
  const sim::Picture picture = scene->draw(along);
  sim::BenchJudge judge(oracle_scene(land));
  judge.begin_view(picture, judged);
  const sim::BenchError error = judge.error_of(picture);
  EXPECT_EQ(error.errors_px.size(), static_cast<std::size_t>(judged));
  EXPECT_LE(error.worst_px, picture.report.bound_px);

  sim::Picture shifted = picture;  // every pixel shows what its left neighbour two away shows
  shifted.report.bound_px = 0;
  for (std::size_t k = picture.range_m.size() - 1; k >= 2; --k) {
    shifted.range_m[k] = picture.range_m[k - 2];
  }
  const sim::BenchError moved = judge.error_of(shifted);
  EXPECT_GT(moved.worst_px, 1.7);
  EXPECT_LT(moved.mean_px(), 2.1);
  EXPECT_GT(moved.mean_px(), 0.3);

  sim::Picture empty = picture;
  empty.report.bound_px = 0;
  for (float& z : empty.range_m) z = std::numeric_limits<float>::infinity();
  const sim::BenchError lost = judge.error_of(empty);
  EXPECT_GT(lost.wrong_class, judged / 2);
  EXPECT_TRUE(lost.worst_is_larger);
  EXPECT_EQ(lost.worst_px, sim::BenchJudge::largest_px);
}

}  // namespace
}  // namespace ridgeline::test
