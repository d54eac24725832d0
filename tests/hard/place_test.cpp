// Hard places on the Earth: equator, Greenwich, antimeridian, poles.
#include <cmath>

#include "tests/hard/hard_case.hpp"

namespace ridgeline::test {
namespace {

class Place : public HardCase {};

double hills_m(double latitude_deg, double longitude_deg) {
  const double y = latitude_deg * 110, x = longitude_deg * 100;
  return 700 + 250 * std::sin(x / 1.3) * std::cos(y / 1.7) + 90 * std::sin((x + 2 * y) / 0.7);
}

PatchHeight hills_over(const PatchShape& shape) {
  return [shape](int row, int column) {
    const double east = shape.west_deg + column / shape.columns_a_degree;
    return hills_m(shape.south_deg + row / shape.rows_a_degree, east > 180 ? east - 360 : east);
  };
}

TEST_F(Place, equator_and_greenwich) {
  why("Latitude and longitude change sign under the eye; 0 is a place and not a missing value.");
  const PatchShape shape{-0.15, -0.15, 361, 361};
  const Patch& land = made(shape, hills_over(shape));
  for (const double bytes : {limits::terrain_gpu_bytes, few_bytes}) {
    Stage stage(land, {.gpu_bytes = bytes}, {0, 0, 1'500});
    for (int k = 0; k < 4; ++k) {
      shoot(stage, {land.over(180, 180, 300), {0, -5, 45.0 + 90 * k}}, Promise::bound_up_to(16));
    }
    const Shot at_zero = shoot(stage, {{0, 0, 2'000}, {0, -90, 0}}, Promise::bound_up_to(16));
    EXPECT_NEAR(at_zero.middle_m(), 2'000 - land.surface_m(180, 180), 0.1);
  }
  also("from 0 N 0 E straight down the post there is as far as its height says");
}

TEST_F(Place, antimeridian) {
  why("Longitude jumps by 360 degrees in the picture; two files meet there, neither may be left "
      "out.");
  const PatchShape shape{-17, 179.85, 361, 361};
  const Patch& land = made(shape, hills_over(shape), {{0, 0, 361, 181}, {0, 180, 361, 181}});
  for (const double longitude_deg : {180.0, -180.0, 179.9999, -179.9999}) {
    const bool several = std::abs(longitude_deg) < 180;
    const GeodeticPosition eye{-16.85, longitude_deg, land.surface_m(180, 180) + 400};
    Stage stage(land, {.gpu_bytes = several ? few_bytes : limits::terrain_gpu_bytes}, eye);
    for (const double heading : {90.0, 270.0}) {
      const Shot shot = shoot(stage, {eye, {0, -9, heading}}, Promise::bound_up_to(16));
      for (int u = 0; u < 129; ++u) EXPECT_TRUE(std::isfinite(shot.range_m(u, 90)));
    }
  }
  also("no pixel of a row below the horizon is unknown or sky on either side");
}

/// One raster all round a pole: a cap of one degree, 30" by 6'. `side`: 1 north, -1 south.
PatchShape ring(int side) {
  return {side > 0 ? 89.0 : -90.0, -180, 121, 3601, 120, 10};
}

constexpr ImageGeometry polar_image{65, 49, 60};
constexpr int polar_pixels = 80;  ///< of a frame; each crosses hundreds of needle-shaped cells
constexpr double km_deg = 1 / 111.69;

TEST_F(Place, eye_on_a_pole_over_flat_ground) {
  why("Every meridian starts under the eye, longitude means nothing, and cells are needles.");
  judge_only(polar_pixels);
  for (const int side : {1, -1}) {
    const Patch& land = made(ring(side), [](int, int) { return 2'800.0; });
    const double pole_deg = side * 90.0;
    Stage stage(land, {.image = polar_image, .range_m = 30'000}, {pole_deg, 0, 3'400});
    const Shot first = shoot(stage, {{pole_deg, 0, 3'400}, {0, -6, 0}}, Promise::plain());
    // Turned about the pole by longitude instead of heading: the same picture.
    const Pose by_longitude{{pole_deg, 77, 3'400}, {0, -6, side * 77.0}};
    const Shot turned = shoot(stage, by_longitude, Promise::plain());
    int differ = 0;
    for (int v = 0; v < polar_image.height_px; ++v) {
      const double p = first.range_m(32, v), q = turned.range_m(32, v);
      differ += p == q || std::abs(p - q) < 1e-3 * p ? 0 : 1;
    }
    EXPECT_LE(differ, 1);
    const Shot down = shoot(stage, {{pole_deg, -133, 3'000}, {0, -90, 90}}, Promise::plain());
    EXPECT_NEAR(down.middle_m(), 200, 0.02);
  }
  also("over a plateau the bound stays 1 px; longitude turns the picture as heading does");
}

TEST_F(Place, a_hill_on_a_pole) {
  why("The post of the pole is held once for every column of the raster: 3601 copies of one "
      "height.");
  judge_only(polar_pixels);
  for (const int side : {1, -1}) {
    const int pole_row = side > 0 ? 120 : 0;
    const Patch& land =
        made(ring(side), [=](int row, int) { return row == pole_row ? 200.0 : 100.0; });
    const GeodeticPosition eye{side * (90 - 20 * km_deg), -40, 300}, tip{side * 90.0, 0, 190};
    Stage stage(land, {.image = polar_image, .range_m = 40'000}, eye);
    const Shot shot = shoot(stage, {eye, aimed(eye, tip)}, Promise::bound_up_to(64));
    const double tip_m = shot.place(tip).distance_m;
    if (shot.picture.report.range_m > tip_m + 300) {
      EXPECT_NEAR(shot.middle_m(), tip_m, 300);
    } else {
      EXPECT_TRUE(std::isinf(shot.middle_m()) || shot.middle_m() < tip_m - 300);
    }
  }
  also("the hill stands in the middle of the picture that is aimed at it, if the range holds it");
}

}  // namespace
}  // namespace ridgeline::test
