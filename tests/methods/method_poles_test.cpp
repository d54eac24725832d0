// Methods that place vertices on the ground, in the polar chart: its lattice is turned against the
// eye's east and north, and the ground map with it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/methods/method_stand.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{96, 76, 60};
constexpr double deg = 0.017453292519943295;
constexpr double km_deg = 1.0 / 111.69;  ///< a kilometre of latitude at a pole

/// Ridges and hollows some kilometres wide, the same seen from any meridian: smooth at the pole.
double cap_m(double latitude_deg, double longitude_deg) {
  const double p = (90.0 - latitude_deg) / km_deg;
  const double x = p * std::sin(longitude_deg * deg), y = p * std::cos(longitude_deg * deg);
  return 600 + 320 * std::sin(x / 4.3) * std::cos(y / 5.1) + 120 * std::sin((x + 2 * y) / 9.7);
}

/// DTED level 0 tiles all round the north pole.
void add_cap(const Land& land) {
  const DtedShape shape = dted_shape(0, 89);
  for (int west = -180; west < 180; ++west) {
    char name[32];
    std::snprintf(name, sizeof name, "n89_%c%03d.dt0", west < 0 ? 'w' : 'e', std::abs(west));
    const auto post = [&](int row, int column) -> std::optional<int> {
      return sim::stored_height_m(
          cap_m(89 + row / (shape.rows - 1.0), west + column / (shape.columns - 1.0)));
    };
    write_dted(land.path() + "/" + name, 0, 89, west, post);
  }
}

TEST(MethodPoles, pgm_and_clipmap_draw_over_the_pole_as_elsewhere) {
  const Land land(cap_m);
  add_cap(land);
  MethodStand stand(land, image, 30'000, {89.95, 20, 2000});
  const Pose poses[] = {{{90, 0, 1800}, {0, -8, 77}},
                        {{89.95, 20, 2000}, {10, -10, 10}},
                        {{89.93, -120, 3000}, {0, -35, 200}}};
  for (const char* spec : {"pgm:grid=256x256", "clipmap:grid=127"}) {
    stand.use(spec);
    for (const Pose& pose : poses) {
      const sim::Picture picture = stand.draw(pose);
      const JudgedPicture judged = stand.judge(picture);
      std::printf("[ poles ] %s: mean %.4f, max %.3f px, %.2f %% over 1\n", spec, judged.mean_px(),
                  judged.max_px(), judged.percent_over(1));
      EXPECT_LT(judged.mean_px(), 0.1);
      EXPECT_LT(judged.percent_over(1), 1.0);
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
