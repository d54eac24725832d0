// Things of one post: spires, pits, walls, canyons, crests. None may be lost, none may grow.
#include <cmath>

#include "tests/hard/hard_case.hpp"

namespace ridgeline::test {
namespace {

class Thin : public HardCase {};

constexpr double plain_m = 100;
const PatchShape fine{46, 8, 301, 301, 3600, 3600};  ///< 1" posts: 31 m by 21 m
constexpr double fine_range_m = 6'000;

TEST_F(Thin, spire_of_one_post_under_a_pixel_wide) {
  why("Half way up the spire is 0.6 pixels wide: grids and filters lose it, thickened ones widen "
      "it.");
  constexpr int row = 150, column = 150;
  constexpr double top_m = 1'500;
  const Patch& land =
      made(fine, [](int r, int c) { return r == row && c == column ? top_m : plain_m; });
  const GeodeticPosition eye = land.at(20.4, 149.7, 500);
  const GeodeticPosition middle = land.at(row, column, 800);
  Stage stage(land, {.range_m = fine_range_m}, eye);
  const Shot shot = shoot(stage, {eye, aimed(eye, middle)}, Promise::plain());
  const double distance_m = shot.place(middle).distance_m;
  const double px_per_rad = shot.picture.report.camera.fx;
  ASSERT_LT(21.5 / distance_m * px_per_rad, 0.7);  // its width half way up
  const int tip = static_cast<int>(std::ceil(shot.place(land.at(row, column, top_m)).v_px));
  ASSERT_LT(tip, 45);
  for (int v = tip + 1; v <= 48; ++v) {
    EXPECT_NEAR(shot.range_m(64, v), distance_m, 200) << v;
    EXPECT_TRUE(std::isinf(shot.range_m(62, v)) && std::isinf(shot.range_m(66, v))) << v;
  }
  EXPECT_TRUE(std::isinf(shot.range_m(64, tip - 2)));
  // The same from everywhere: the oracle looks.
  for (const double turn : {0.3, -0.3, 11.7}) {
    Attitude attitude = aimed(eye, middle);
    attitude.heading_deg += turn;
    attitude.roll_deg = 20 * turn;
    shoot(stage, {eye, attitude}, Promise::plain());
  }
  also("every pixel of its column shows it, up to the tip, and no column two beside it");
}

TEST_F(Thin, spire_of_one_post_in_a_coarse_level) {
  why("A coarse level has no post for the spire; the bound must grow until its absence is "
      "covered.");
  const Patch& land =
      made(fine, [](int r, int c) { return r == 201 && c == 151 ? 250.0 : plain_m; });
  const GeodeticPosition eye = land.at(20.4, 149.7, 300);
  const GeodeticPosition tip = land.at(201, 151, 180);
  {
    Stage stage(land, {.range_m = fine_range_m, .gpu_bytes = few_bytes}, eye);
    ASSERT_GE(stage.levels(), 2);
    const Shot shot = shoot(stage, {eye, aimed(eye, tip)}, Promise::bound_up_to(8));
    const FrameReport& report = shot.picture.report;
    EXPECT_TRUE(report.bound_px > 1.5 || report.range_m < shot.place(tip).distance_m);
    Attitude rolled = aimed(eye, tip);
    rolled.roll_deg = 33;
    shoot(stage, {eye, rolled}, Promise::bound_up_to(16));
  }
  Stage one(land, {.range_m = fine_range_m}, eye);
  const Shot exact = shoot(one, {eye, aimed(eye, tip)}, Promise::plain());
  EXPECT_NEAR(exact.middle_m(), exact.place(tip).distance_m, 60);
  also(
      "with levels the bound is above 1.5 px or the range ends before it; with one level it is "
      "there");
}

TEST_F(Thin, forest_of_spires) {
  why("Spires hide behind spires: maxima of blocks say little, so every ray looks at single "
      "cells.");
  const Patch& land = made(fine, [](int r, int c) {
    return (r * 7 + c * 13) % 29 == 0 ? 250.0 + (r * 31 + c * 17) % 200 : plain_m;
  });
  for (const double height_m : {170.0, 420.0}) {
    const GeodeticPosition eye = land.at(30.4, 149.3, height_m);
    Stage stage(land, {.range_m = fine_range_m}, eye);
    shoot(stage, {eye, {0, 0, 0}}, Promise::plain());
    shoot(stage, {eye, {25, -6, 20}}, Promise::plain());
  }
}

TEST_F(Thin, pit_of_one_post) {
  why("From above only the rays through one cell corner reach the bottom; a coarse minimum fills "
      "it.");
  constexpr int row = 150, column = 150;
  constexpr double bottom_m = -900;
  const Patch& land =
      made(fine, [](int r, int c) { return r == row && c == column ? bottom_m : plain_m; });
  const GeodeticPosition bottom = land.at(row, column, bottom_m);
  const GeodeticPosition over = land.at(row, column, 2'000);
  Stage stage(land, {.range_m = fine_range_m}, over);
  const Shot down = shoot(stage, {over, {0, -90, 0}}, Promise::plain());
  EXPECT_NEAR(down.middle_m(), 2'900, 0.5);
  EXPECT_NEAR(down.range_m(64 + 4, 48), 1'900, 3);
  // Slantwise, still within the slope of its walls (1000 m over 21 m and 31 m).
  for (const double rows : {-0.6, 0.6}) {
    const GeodeticPosition eye = land.at(row + rows, column + rows, 2'000);
    const Shot slant = shoot(stage, {eye, aimed(eye, bottom)}, Promise::plain());
    EXPECT_NEAR(slant.middle_m(), slant.place(bottom).distance_m, 60);
  }
  shoot(stage, {land.over(40.3, 150.1, 60), {0, -3, 0}}, Promise::plain());
  also("straight down the bottom is 2900 m away, four pixels beside it the plain 1900 m");
}

/// The middle of a wall and points along it: what stands there is the wall.
void expect_wall(const Shot& shot, const std::vector<GeodeticPosition>& points) {
  for (const GeodeticPosition& point : points) {
    const ImagePlace place = shot.place(point);
    const double shown = shot.range_m(point);
    EXPECT_NEAR(shown, place.distance_m, 45) << place.u_px << ' ' << place.v_px;
  }
}

TEST_F(Thin, wall_of_one_post_along_the_axes) {
  why("A wall along a line of posts fills one row of cells: a node without its neighbour's posts "
      "lacks it.");
  const Patch& land =
      made(fine, [](int r, int c) { return r == 150 || c == 150 ? 400.0 : plain_m; });
  std::vector<GeodeticPosition> north_wall, east_wall;
  for (const int k : {20, 50, 80, 110}) {
    north_wall.push_back(land.at(150, k, 300));
    east_wall.push_back(land.at(k, 150, 300));
  }
  const GeodeticPosition eye = land.at(60.4, 60.7, 220);
  Stage stage(land, {.range_m = fine_range_m}, eye);
  const Shot north = shoot(stage, {eye, {0, 0, 0}}, Promise::plain());
  expect_wall(north, {north_wall[1], north_wall[2]});
  const Shot east = shoot(stage, {eye, {0, 0, 90}}, Promise::plain());
  expect_wall(east, {east_wall[1], east_wall[2]});
  shoot(stage, {land.at(150, 20, 400.5), {0, 0, 90}}, Promise::bound_up_to(64));  // along its top
  shoot(stage, {land.at(150.6, 20, 250), {0, 0, 90}}, Promise::plain());          // along its face
  also("points half way up the wall show it");
}

TEST_F(Thin, wall_of_one_post_along_a_diagonal) {
  why("Between diagonal posts the bilinear surface sags to half: a saw of saddles, each one a "
      "cell.");
  const Patch& land = made(fine, [](int r, int c) { return r == c ? 400.0 : plain_m; });
  const GeodeticPosition eye = land.at(80.4, 160.7, 180);
  Stage stage(land, {.range_m = fine_range_m}, eye);
  for (const double heading : {310.0, 0.0, 270.0}) {
    const Shot shot = shoot(stage, {eye, {0, 0, heading}}, Promise::plain());
    if (heading == 310.0) {
      // At 160 m the wall is closed: even between its posts it stands 250 m high.
      std::vector<GeodeticPosition> wall;
      for (const int k : {110, 115, 120, 130}) wall.push_back(land.at(k, k, 190));
      expect_wall(shot, wall);
    }
  }
  shoot(stage, {land.at(60, 60, 401), {0, -1, 34.8}}, Promise::bound_up_to(64));
  also("points on its posts show it");
}

TEST_F(Thin, canyon_narrower_than_a_pixel_far_away) {
  why("The eye in a slot of one post sees sky through a slit that narrows to under a pixel.");
  const Patch& land = made(fine, [](int r, int c) {
    static_cast<void>(r);
    return c == 150 ? plain_m : 700.0;
  });
  // Two half cells wide: 43 m at the rim, narrower below.
  const GeodeticPosition eye = land.at(60.5, 150, plain_m + 200);
  {
    Stage stage(land, {.range_m = fine_range_m}, eye);
    const GeodeticPosition far = land.at(250, 150, plain_m + 201);
    const Shot shot = shoot(stage, {eye, aimed(eye, far)}, Promise::plain());
    ASSERT_LT(14.4 / 5'900 * shot.picture.report.camera.fx, 0.3);  // the slit's width at the end
    EXPECT_TRUE(std::isinf(shot.middle_m()));
    EXPECT_LT(shot.range_m(62, 48), 1'000);
    EXPECT_LT(shot.range_m(66, 48), 1'000);
    shoot(stage, {eye, {30, 3, 1}}, Promise::plain());
  }
  // From outside, across the mouth of such slots in a cliff.
  const Patch& cliff =
      made(fine, [](int r, int c) { return r < 150 || c % 20 == 0 ? plain_m : 600.0 + c % 3; });
  const GeodeticPosition before = cliff.at(40.2, 150.4, 350);
  Stage outside(cliff, {.range_m = fine_range_m}, before);
  shoot(outside, {before, {0, 0, 0}}, Promise::plain());
  shoot(outside, {before, {0, -4, 25}}, Promise::plain());
  also(
      "the middle pixel looks 6 km down the slit, its second neighbours hit the walls within 1 km");
}

TEST_F(Thin, grazing_a_ridge) {
  why("Rays along a crest or over it by centimetres: whether they hit is decided by the last "
      "bits.");
  const Patch& land = made(fine, [](int r, int c) {
    static_cast<void>(c);
    return 500 - 6.0 * std::abs(r - 150) + (r == 220 ? 300 : 0);
  });
  const GeodeticPosition crest = land.over(150, 60.3, 0.5);
  Stage stage(land, {.range_m = fine_range_m}, crest);
  shoot(stage, {crest, {0, 0, 90}}, Promise::bound_up_to(4));  // along the crest
  shoot(stage, {crest, {0, -0.5, 91}}, Promise::bound_up_to(4));
  // Over the crest by 10 cm, towards a second one behind it, and exactly level with it.
  for (const double over_m : {0.1, 0.0, -0.1}) {
    const GeodeticPosition eye = land.at(100.4, 150.2, 500 + over_m);
    Attitude level{0, 0, 0};
    shoot(stage, {eye, level}, Promise::plain());
    level.roll_deg = 90;
    shoot(stage, {eye, level}, Promise::plain());
  }
}

}  // namespace
}  // namespace ridgeline::test
