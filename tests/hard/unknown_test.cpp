// Unknown ground: islands, under the eye, everywhere.
#include <cmath>

#include "tests/hard/hard_case.hpp"

namespace ridgeline::test {
namespace {

class Unknown : public HardCase {};

const PatchShape shape{46, 8, 361, 481};

double ground_m(int row, int column) {
  return 700 + 120 * std::sin(row * 0.11) * std::cos(column * 0.07);
}

TEST_F(Unknown, void_islands) {
  why("Unknown is neither ground nor sky nor sea: single posts, lines and islands must all show.");
  const Patch& land = made(shape, [](int r, int c) {
    const bool island = std::hypot(r - 230, c - 240) < 14, speck = (r * 31 + c * 57) % 997 == 0;
    const bool line = r == 260 || c == 330;
    return island || speck || line ? std::nan("") : ground_m(r, c);
  });
  const GeodeticPosition eye = land.at(180.3, 240.2, 2'200);
  {
    Stage one(land, {}, eye);
    for (const Attitude& attitude :
         {Attitude{0, -15, 0}, Attitude{20, -30, 70}, Attitude{0, -90, 0}}) {
      const Shot shot = shoot(one, {eye, attitude}, Promise::plain());
      if (attitude.heading_deg == 0 && attitude.pitch_deg == -15) {
        EXPECT_TRUE(std::isnan(shot.range_m(land.at(230, 240, 700))));
        EXPECT_FALSE(std::isnan(shot.range_m(land.at(205, 240, ground_m(205, 240)))));
      }
    }
  }
  Stage several(land, {.gpu_bytes = few_bytes}, eye);
  const Shot cut = shoot(several, {eye, {0, -15, 0}}, Promise::shorter_range());
  EXPECT_LT(cut.picture.report.range_m, 12'000);
  also(
      "the island's middle is unknown, ground before it is not; coarse levels end the range before "
      "voids");
}

TEST_F(Unknown, void_under_the_eye) {
  why("No clearance is known: the eye may be anywhere over, or in, ground that nobody measured.");
  const Patch& land = made(shape, [](int r, int c) {
    return std::hypot(r - 180, c - 240) < 20 ? std::nan("") : ground_m(r, c);
  });
  const GeodeticPosition eye = land.at(180.3, 240.2, 1'500);
  Stage stage(land, {}, eye);
  const Shot down = shoot(stage, {eye, {0, -90, 0}}, Promise::plain());
  EXPECT_TRUE(std::isnan(down.middle_m()));
  const Shot ahead = shoot(stage, {eye, {0, -10, 200}}, Promise::plain());
  EXPECT_TRUE(std::isfinite(ahead.range_m(land.at(120, 210, ground_m(120, 210)))));
  // Inside the floor up to which unknown ground is opaque: nothing is promised but unknown.
  const Shot inside =
      shoot(stage, {land.at(180.3, 240.2, 300), {0, -4, 30}}, Promise::bound_up_to(64));
  for (const float range : inside.picture.range_m) ASSERT_TRUE(std::isnan(range));
  also(
      "straight down is unknown, known ground beyond is drawn; an eye inside the floor sees "
      "unknown only");
}

TEST_F(Unknown, a_single_known_cell) {
  why("Four known posts among voids: one cell is ground, and every cell round it is not.");
  const Patch& land = made(shape, [](int r, int c) {
    return r >= 200 && r <= 201 && c >= 240 && c <= 241 ? 500.0 : std::nan("");
  });
  const GeodeticPosition eye = land.at(198.5, 240.5, 1'400);
  const GeodeticPosition cell = land.at(200.5, 240.5, 500);
  Stage stage(land, {}, eye);
  const Shot shot = shoot(stage, {eye, aimed(eye, cell)}, Promise::bound_up_to(64));
  EXPECT_NEAR(shot.middle_m(), shot.place(cell).distance_m, 1);
  also("that cell shows its distance to 1 m");
}

TEST_F(Unknown, all_void) {
  why("A tile without one height is no terrain: nothing may be drawn, not even a horizon of "
      "unknown.");
  const Patch& land = made(shape, [](int, int) { return std::nan(""); });
  for (const double bytes : {limits::terrain_gpu_bytes, few_bytes}) {
    const GeodeticPosition eye = land.at(180.3, 240.2, 1'500);
    Stage stage(land, {.gpu_bytes = bytes}, eye);
    shoot(stage, {eye, {0, -10, 0}}, Promise::removed(Reason::terrain_missing));
    shoot(stage, {eye, {0, -90, 0}}, Promise::removed(Reason::terrain_missing));
  }
}

}  // namespace
}  // namespace ridgeline::test
