// One ray for several pixels: within the promise and complete at every pixel, and only where the
// promise and the ground leave room for it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{160, 120, 60};
constexpr GeodeticPosition place{46.5, 8.5, 0};
constexpr int pixel_count = image.width_px * image.height_px;

double hills_m(double latitude_deg, double longitude_deg) {
  return 400 + 60 * std::sin(150 * latitude_deg) * std::cos(110 * longitude_deg);
}

/// Teeth of one post, about as steep as still lets pixels share rays.
double teeth_m(double latitude_deg, double longitude_deg) {
  const auto row = std::llround(latitude_deg * 1200), column = std::llround(longitude_deg * 1200);
  return 400 + ((row + column) % 2 == 0 ? 45.0 : 0.0);
}

double spires_m(double latitude_deg, double longitude_deg) {
  const auto row = std::llround(latitude_deg * 1200), column = std::llround(longitude_deg * 1200);
  return hills_m(latitude_deg, longitude_deg) + (row % 17 == 3 && column % 13 == 5 ? 500.0 : 0.0);
}

double half_void_m(double latitude_deg, double longitude_deg) {
  return longitude_deg > 8.53 ? std::nan("") : hills_m(latitude_deg, longitude_deg);
}

/// As fine a view as any ground is drawn from, level, rolled and from above.
const std::vector<Pose> poses{{{46.5, 8.5, 900}, {0, -4, 30}},
                              {{46.51, 8.47, 1100}, {37, -12, 160}},
                              {{46.48, 8.52, 700}, {-90, -6, 275}},
                              {{46.5, 8.5, 1800}, {180, -35, 80}}};

struct Shared {
  double error_px = 1;
  double gpu_mebibytes = 96;
  bool cast_every_pixel = false;
};

sim::SceneOptions options_of(const Shared& wanted) {
  sim::SceneOptions options;
  options.settings.image = image;
  options.settings.error_px = wanted.error_px;
  options.settings.range_m = 12'000;
  options.settings.cast_every_pixel = wanted.cast_every_pixel;
  options.terrain_gpu_bytes = wanted.gpu_mebibytes * 1024 * 1024;
  return options;
}

/// Shoots all poses and has every pixel judged; rays of all pictures.
int rays_of_sound(const Land& land, const Shared& wanted) {
  Scene scene(land, options_of(wanted), place);
  int rays = 0;
  std::size_t drawn = 0;
  for (const Pose& pose : poses) {
    const sim::Picture picture = scene.shoot(pose);
    if (picture.report.availability.mode == Mode::removed) continue;
    ++drawn;
    rays += picture.report.rays;
    EXPECT_LE(picture.report.shared_px + picture.report.budget.smallest_px(),
              picture.report.bound_px);
  }
  const oracle::VerifySummary summary = scene.judged(pixel_count);
  EXPECT_EQ(summary.frames - summary.removed_frames, drawn);
  EXPECT_EQ(summary.violations(), 0U) << (summary.details.empty() ? "" : summary.details.front());
  EXPECT_LE(summary.undecided, summary.pixels / 1000);
  EXPECT_LE(summary.errors.max_of_proven(), 1.0);
  EXPECT_GE(drawn, 2U);
  return rays;
}

class SharedRays : public testing::TestWithParam<double> {};

TEST_P(SharedRays, are_sound_over_hills) {
  const Land land = [] { return Land(hills_m); }();
  land.add_tile(46, 8);
  const int rays = rays_of_sound(land, {.error_px = GetParam()});
  EXPECT_LT(rays, (GetParam() < 2 ? 0.9 : 0.5) * pixel_count * static_cast<double>(poses.size()));
}

TEST_P(SharedRays, are_sound_over_teeth_and_spires) {
  for (const auto& height_m : {teeth_m, spires_m}) {
    const Land land(height_m);
    land.add_tile(46, 8);
    rays_of_sound(land, {.error_px = GetParam()});
  }
}

TEST_P(SharedRays, are_sound_over_rough_land_with_voids) {
  const Land land(rough_with_voids_m);
  land.add_tile(46, 8);
  rays_of_sound(land, {.error_px = GetParam()});
}

TEST_P(SharedRays, are_sound_beside_unknown_ground) {
  const Land land(half_void_m);
  land.add_tile(46, 8);
  rays_of_sound(land, {.error_px = GetParam()});
}

TEST_P(SharedRays, are_sound_where_a_coarser_level_begins) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  rays_of_sound(land, {.error_px = GetParam(), .gpu_mebibytes = 1});
}

INSTANTIATE_TEST_SUITE_P(Bounds, SharedRays, testing::Values(1.0, 2.0, 4.0, 8.0));

TEST(RayCount, falls_as_the_bound_grows_over_gentle_land) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  int before = pixel_count + 1;
  for (const double error_px :
       {0.4, 1.0, 2.0, 4.0}) {  // beyond, the border of single rays is most of it
    Scene scene(land, options_of({.error_px = error_px}), place);
    const int rays = scene.draw(poses.front()).report.rays;
    EXPECT_LT(rays, before) << error_px;
    before = rays;
  }
}

TEST(RayCount, is_a_ray_a_pixel_where_the_bound_leaves_no_room) {
  const Land land(hills_m);
  land.add_tile(46, 8);
  Scene scene(land, options_of({.error_px = 0.4}), place);
  Scene cast(land, options_of({.error_px = 8, .cast_every_pixel = true}), place);
  for (const Pose& pose : poses) {
    const sim::Picture swept = scene.draw(pose), every = cast.draw(pose);
    EXPECT_LE(swept.report.rays, pixel_count);  // but for tiles of plain sky
    EXPECT_EQ(swept.report.shared_px, 0);
    EXPECT_EQ(every.report.rays, pixel_count);
    ASSERT_EQ(swept.range_m.size(), every.range_m.size());
    for (std::size_t k = 0; k < swept.range_m.size(); ++k) {
      if (std::isinf(every.range_m[k])) {
        EXPECT_TRUE(std::isinf(swept.range_m[k])) << k;
      } else {
        EXPECT_NEAR(swept.range_m[k] / every.range_m[k], 1, 1e-5) << k;
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
