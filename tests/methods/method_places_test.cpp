// `warp` and `hybrid` where the terrain window is out of the ordinary: several levels, a polar
// chart, the rim of the known. The module's own picture, which is proven, is the measure.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/gl/scene.hpp"
#include "tests/methods/method_stand.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{200, 160, 60};

/// How far a picture is from ours.
struct Difference {
  int ground = 0;      ///< pixels of ground in both
  int far_off = 0;     ///< of them, distances that differ by more than 1 %
  int other_kind = 0;  ///< sky, ground or unknown in one and not in the other
};

int kind_of(float z) {
  return std::isnan(z) ? 2 : std::isinf(z) ? 1 : 0;
}

Difference difference_of(const sim::Picture& ours, const sim::Picture& other) {
  Difference d;
  EXPECT_EQ(ours.range_m.size(), other.range_m.size());
  for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
    const float a = ours.range_m[i], b = other.range_m[i];
    d.other_kind += kind_of(a) == kind_of(b) ? 0 : 1;
    if (kind_of(a) != 0 || kind_of(b) != 0) continue;
    ++d.ground;
    d.far_off += std::abs(b / a - 1.0f) > 0.01f ? 1 : 0;
  }
  return d;
}

class Places : public testing::TestWithParam<const char*> {
 protected:
  /// Draws the pose by the method and by ours, and compares.
  static void expect_alike(Scene& scene, const Pose& pose) {
    sim::MethodSpec spec;
    ASSERT_TRUE(sim::parse_method(GetParam(), spec).ok());
    std::string problem;
    auto method = sim::make_method(spec, problem);
    ASSERT_NE(method, nullptr) << problem;
    scene.session().use(&scene.session().keep(std::move(method)));
    const sim::Picture picture = scene.draw(pose);
    scene.session().use(nullptr);
    const sim::Picture ours = scene.draw(pose);
    ASSERT_TRUE(picture.problem.ok()) << picture.problem.message;
    ASSERT_NE(ours.report.availability.mode, Mode::removed);
    ASSERT_NE(picture.report.availability.mode, Mode::removed);
    const Difference d = difference_of(ours, picture);
    const int pixels = image.width_px * image.height_px;
    std::printf("[ places ] %s: %d ground, %.2f %% over 1 %% off, %.2f %% of another kind\n",
                GetParam(), d.ground, 100.0 * d.far_off / d.ground, 100.0 * d.other_kind / pixels);
    EXPECT_GT(d.ground, pixels / 4);
    EXPECT_LT(d.far_off, d.ground / 50);
    EXPECT_LT(d.other_kind, pixels / 100);
  }
};

TEST_P(Places, several_levels) {
  Land land(smooth_m);
  for (const int south : {45, 46}) {
    for (const int west : {8, 9}) land.add_tile(south, west);
  }
  sim::SceneOptions options;
  options.settings.image = image;
  options.settings.range_m = 60'000;
  options.terrain_gpu_bytes = 3.0 * 1024 * 1024;
  Scene scene(land, options, {46, 9, 2000});
  ASSERT_GT(scene.session().window().levels, 1);
  expect_alike(scene, {{46, 9, 2500}, {0, -8, 40}});
  expect_alike(scene, {{46.02, 9.03, 6000}, {20, -20, 160}});
}

TEST_P(Places, polar_chart) {
  const TemporaryFolder folder;
  const DtedShape shape = dted_shape(0, 89);
  const auto height_m = [](double latitude_deg, double longitude_deg) {
    return 900 + 400 * std::cos((90 - latitude_deg) * 20) +
           100 * std::sin(longitude_deg * 0.0523598776) * (90 - latitude_deg);
  };
  for (int west = -180; west < 180; ++west) {
    char name[32];
    std::snprintf(name, sizeof name, "n89_%c%03d.dt0", west < 0 ? 'w' : 'e', std::abs(west));
    write_dted(folder.file(name), 0, 89, west, [&](int row, int column) -> std::optional<int> {
      return sim::stored_height_m(
          height_m(89 + row / (shape.rows - 1.0), west + column / (shape.columns - 1.0)));
    });
  }
  Scene scene(folder.path(), image, 0.4, 60'000, {89.8, 30, 4000});
  expect_alike(scene, {{89.8, 30, 4000}, {0, -12, 0}});
  expect_alike(scene, {{89.75, -120, 5000}, {15, -20, 140}});
}

TEST_P(Places, rim_of_the_known) {
  Land land(smooth_m);
  land.add_tile(46, 8);
  Scene scene(land, image, 0.4, 40'000, {46.8, 8.5, 3000});
  expect_alike(scene, {{46.75, 8.5, 3000}, {0, -10, 10}});  // the tile ends 28 km ahead
}

INSTANTIATE_TEST_SUITE_P(Methods, Places,
                         testing::Values("warp", "hybrid:t=0", "hybrid:cell=48",
                                         "hybrid:t=1e9,k=0.01,cell=24", "pgm:grid=512x512",
                                         "clipmap:grid=255"),
                         [](const auto& spec) {
                           std::string name;
                           for (const char c : std::string(spec.param)) {
                             name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace ridgeline::test
