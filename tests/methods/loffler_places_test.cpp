// `loffler` where the ground map is unusual: a window of several levels, the antimeridian, a pole.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim/methods/loffler.hpp"
#include "tests/gl/scene.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{200, 160, 60};
constexpr double deg = std::numbers::pi / 180.0;

/// How much a picture of `loffler` differs from the module's own, %.
struct Difference {
  double classes = 0;  ///< of all pixels: sky, ground or unknown instead of another
  double far = 0;      ///< of those that are ground in both: distances more than 2 % apart
};

Difference difference(Scene& scene, const Pose& pose) {
  scene.session().use(nullptr);
  const sim::Picture ours = scene.draw(pose);
  EXPECT_NE(ours.report.availability.mode, Mode::removed);
  sim::LofflerSettings settings;
  settings.columns = 512;
  settings.rows = 256;
  scene.session().use(&scene.session().keep(std::make_unique<sim::Loffler>(settings)));
  const sim::Picture theirs = scene.draw(pose);
  EXPECT_TRUE(theirs.problem.ok()) << theirs.problem.message;
  if (ours.range_m.empty() || ours.range_m.size() != theirs.range_m.size()) {
    ADD_FAILURE() << "not drawn";
    return {100, 100};
  }
  int classes = 0, far = 0, ground = 0;
  for (std::size_t i = 0; i < ours.range_m.size(); ++i) {
    const auto a = static_cast<double>(ours.range_m[i]), b = static_cast<double>(theirs.range_m[i]);
    if (std::isfinite(a) && std::isfinite(b)) {
      ++ground;
      far += std::abs(a / b - 1) > 0.02 ? 1 : 0;
    } else {
      classes += std::isnan(a) == std::isnan(b) && std::isinf(a) == std::isinf(b) ? 0 : 1;
    }
  }
  EXPECT_GT(ground, 5000);
  const Difference d{100.0 * classes / static_cast<double>(ours.range_m.size()),
                     100.0 * far / std::max(ground, 1)};
  std::printf("[ place ] %.2f %% of another class, %.2f %% of the ground more than 2 %% off\n",
              d.classes, d.far);
  return d;
}

/// Hills some kilometres wide.
double hills_m(double latitude_deg, double longitude_deg) {
  return 600 + 250 * std::sin(latitude_deg * 150) * std::cos(longitude_deg * 110);
}

TEST(LofflerPlace, window_of_several_levels) {
  Land land(hills_m);
  land.add_tile(46, 8);
  sim::SceneOptions options;
  options.settings.image = image;
  options.settings.range_m = 12'000;
  options.settings.error_px = 64;
  options.terrain_gpu_bytes = 1.1 * 1024 * 1024;
  Scene scene(land, options, {46.5, 8.5, 1500});
  ASSERT_GT(scene.session().window().levels, 1);
  const Difference d = difference(scene, {{46.5, 8.5, 1500}, {0, -10, 40}});
  EXPECT_LT(d.classes, 1);
  EXPECT_LT(d.far, 2);
}

TEST(LofflerPlace, antimeridian) {
  // Continuous over it: longitude counts from the other side.
  const auto height = [](double latitude_deg, double longitude_deg) {
    return hills_m(latitude_deg, longitude_deg < 0 ? longitude_deg + 360 : longitude_deg);
  };
  Land land(height);
  land.add_tile(-17, 179);
  land.add_tile(-17, -180);
  Scene scene(land, image, 1, 30'000, {-16.5, 179.9, 1500});
  const Difference d = difference(scene, {{-16.5, 179.9, 1500}, {20, -6, 80}});
  EXPECT_LT(d.classes, 1);
  EXPECT_LT(d.far, 2);
}

TEST(LofflerPlace, across_a_pole) {
  TemporaryFolder folder;
  const DtedShape shape = dted_shape(0, 89);
  for (int west = -180; west < 180; ++west) {
    char name[32];
    std::snprintf(name, sizeof name, "n89_%c%03d.dt0", west < 0 ? 'w' : 'e', std::abs(west));
    write_dted(folder.file(name), 0, 89, west, [&](int row, int column) -> std::optional<int> {
      const double colatitude_km = (1.0 - row / (shape.rows - 1.0)) * 111.69;
      const double longitude = (west + column / (shape.columns - 1.0)) * deg;
      const double x = colatitude_km * std::sin(longitude), y = colatitude_km * std::cos(longitude);
      return sim::stored_height_m(600 + 200 * std::sin(x / 2.7) * std::cos(y / 3.3));
    });
  }
  const Pose pose{{90.0 - 15.0 / 111.69, 25, 1800}, {10, -8, 5}};
  Scene scene(folder.path(), image, 64, 40'000, pose.eye);
  const Difference d = difference(scene, pose);
  EXPECT_LT(d.classes, 1);
  EXPECT_LT(d.far, 2);
}

}  // namespace
}  // namespace ridgeline::test
