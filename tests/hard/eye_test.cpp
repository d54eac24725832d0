// Hard places for the eye: on the lattice of posts, at its borders, at the ground, at the limits.
#include <cmath>

#include "tests/hard/hard_case.hpp"

namespace ridgeline::test {
namespace {

class Eye : public HardCase {};

TEST_F(Eye, on_a_post) {
  why("Every ray starts in the corner of four cells: the cell ahead is chosen by the way alone.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (int k = 0; k < 8; ++k) {
      shoot(stage, {land.over(180, 240, 30), {0, -4, 45.0 * k}}, promise);
    }
    const Shot down = shoot(stage, {land.over(180, 240, 30), {0, -90, 0}}, promise);
    EXPECT_NEAR(down.middle_m(), 30, 1e-3);
    const Pose inside{land.over(180, 240, 0), {0, -4, 0}};
    shoot(stage, inside, Promise::removed(Reason::below_terrain));
  });
  also("straight down the post is 30 m away to a millimetre; an eye in the post is below_terrain");
}

TEST_F(Eye, on_a_cell_edge) {
  why("The eye belongs to two cells; rounding must not lose the one that a ray enters.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (const auto& [row, column] : {std::pair(180.0, 240.5), std::pair(180.5, 240.0)}) {
      for (const double heading : {0.0, 90.0, 180.0, 270.0, 33.0}) {
        shoot(stage, {land.over(row, column, 12), {0, -3, heading}}, promise);
      }
    }
  });
}

TEST_F(Eye, on_a_lattice_line_looking_along_it) {
  why("The middle column of rays runs along a line of posts and never leaves the edge of its "
      "cells.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (const double heading : {0.0, 180.0}) {
      const Pose on{land.over(180.37, 240, 60), {0, -2, heading}};
      Pose beside = on;
      beside.eye.longitude_deg += 1e-8;  // under a millimetre
      const Shot a = shoot(stage, on, promise), b = shoot(stage, beside, promise);
      int differ = 0;
      for (int v = 0; v < hard_image.height_px; ++v) {
        const double p = a.range_m(64, v), q = b.range_m(64, v);
        differ += p == q || std::abs(p - q) < 2e-3 * p ? 0 : 1;
      }
      EXPECT_LE(differ, 2) << heading;
    }
    for (const double heading : {90.0, 270.0}) {
      shoot(stage, {land.over(180, 240.61, 60), {0, -2, heading}}, promise);
    }
  });
  also("the middle column is that of an eye a millimetre beside the line");
}

TEST_F(Eye, on_a_border_of_levels) {
  why("The eye stands where the finest level ends: rays of one picture start in different levels.");
  // Smooth, so that even coarse cells under the eye leave a bound.
  const Patch& land = made({-33, -70, 481, 601}, [](int row, int column) {
    return 900 + 250 * std::sin(row * 0.03) * std::cos(column * 0.02);
  });
  const StageOptions options{.gpu_bytes = few_bytes,
                             .arrival = sim::SceneOptions::Arrival::in_step};
  const GeodeticPosition start = land.over(180, 240, 400);
  int on_border = 0;
  for (const double heading : {0.0, 90.0, 225.0}) {
    Stage stage(land, options, start);
    shoot(stage, {start, {0, -5, heading}}, Promise::bound_up_to(limits::max_error_px));
    // A jump to the corner of what the finest level draws: the blocks beyond come a frame later.
    const TerrainView before = stage.scene.session().terrain().view();
    const double row = (before.lattice.latitude_deg(before.drawable[0].north) + 33) * 1200;
    const double column = (before.lattice.longitude_deg(before.drawable[0].east) + 70) * 1200;
    const Pose jump{land.over(std::round(row), std::round(column), 400), {0, -8, heading}};
    for (int frame = 0; frame < 3; ++frame) {
      const Shot shot = shoot(stage, jump, Promise::while_loading());
      const TerrainView now = stage.scene.session().terrain().view();
      const PostRect& finest = now.drawable[0];
      const bool inside = now.eye_column > finest.west + 1 && now.eye_column < finest.east - 1 &&
                          now.eye_row > finest.south + 1 && now.eye_row < finest.north - 1;
      on_border += shot.drawn() && !inside ? 1 : 0;
    }
  }
  EXPECT_GE(on_border, 3);
  also("drawn three times with the eye on or outside the border of the finest level");
}

TEST_F(Eye, on_a_border_of_blocks) {
  why("Blocks of 64 posts meet under the eye, and every level of the window is about to move on.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    const PostLattice& lattice = stage.scene.session().lattice();
    const GeodeticPosition middle = land.over(180, 240, 0);
    const double row = std::round(lattice.row_of(middle.latitude_deg) / 64) * 64;
    const double column = std::round(lattice.column_of(middle.longitude_deg) / 64) * 64;
    for (const double shift : {0.0, -1e-9, 1e-9}) {
      Pose pose{land.over(row, column, 100), {0, -6, 45}};
      pose.eye.latitude_deg += shift;
      pose.eye.longitude_deg += shift;
      shoot(stage, pose, promise);
    }
  });
}

TEST_F(Eye, on_a_corner_of_four_tiles_one_missing) {
  why("Four files meet under the eye: cells of three are ground, those of the fourth are unknown.");
  const PatchShape shape{46, 8, 241, 241};
  const auto height = [](int row, int column) { return 300 + 40 * std::sin(row * 0.3) + column; };
  const Patch& whole =
      made(shape, height,
           {{0, 0, 121, 121}, {0, 120, 121, 121}, {120, 0, 121, 121}, {120, 120, 121, 121}});
  const Patch& three =
      made(shape, height, {{0, 0, 121, 121}, {0, 120, 121, 121}, {120, 0, 121, 121}});
  const Pose ahead{whole.over(120, 120, 100), {0, -12, 45}};
  const Pose back{ahead.eye, {0, -12, 200}};
  const GeodeticPosition in_fourth = whole.over(128, 128, 0);
  double middle_m = 0;
  for (const Patch* land : {&whole, &three}) {
    Stage stage(*land, {.range_m = 6'000}, ahead.eye);
    // A ray for every pixel: beside unknown ground there is no other way, and both are compared.
    stage.scene.settings().cast_every_pixel = true;
    EXPECT_EQ(std::isnan(shoot(stage, ahead, Promise::plain()).range_m(in_fourth)), land == &three);
    const Shot other_way = shoot(stage, back, Promise::plain());
    if (land == &whole) middle_m = other_way.middle_m();
    EXPECT_EQ(other_way.middle_m(), middle_m);
    for (const double heading : {0.0, 90.0}) {
      shoot(stage, {ahead.eye, {0, -12, heading}}, Promise::plain());
    }
  }
  also("ground of the missing tile shows unknown, the other way is unchanged");
}

TEST_F(Eye, two_metres_above_the_ground) {
  why("The first cell fills most of the picture; a centimetre of height is a third of a degree.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (const double heading : {10.0, 130.0, 250.0}) {
      for (const auto& [row, column] : {std::pair(171.3, 233.7), std::pair(200.0, 250.0)}) {
        shoot(stage, {land.over(row, column, 2), {0, 0, heading}}, promise);
      }
    }
  });
}

TEST_F(Eye, below_sea_level) {
  why("Heights and the eye are negative; unknown and sea must not be taken for them.");
  const PatchShape shape{31.4, 35.4, 361, 361};
  const Patch& land = made(shape, [](int row, int column) {
    return -590 + 40 * std::sin(row * 0.21) * std::cos(column * 0.17) + (row * column) % 3;
  });
  Stage stage(land, {}, land.over(180, 180, 30));
  for (const double heading : {20.0, 140.0, 260.0}) {
    const Shot shot =
        shoot(stage, {land.over(180.2, 179.7, 12), {0, -3, heading}}, Promise::plain());
    EXPECT_LT(shot.pose.eye.height_m, -500);
  }
  const GeodeticPosition lowest = land.at(168.3, 185.1, limits::min_eye_height_m);
  shoot(stage, {lowest, {0, -5, 90}}, Promise::plain());
}

TEST_F(Eye, below_the_terrain) {
  why("No ray has a first hit from inside the ground: a picture would show the underside.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise&) {
    for (const double depth_m : {1e-3, 1.0, 400.0}) {
      for (const auto& [row, column] : {std::pair(171.3, 233.7), std::pair(180.0, 240.0)}) {
        shoot(stage, {land.over(row, column, -depth_m), {0, -4, 70}},
              Promise::removed(Reason::below_terrain));
      }
    }
    const GeodeticPosition on_a_post = land.over(180, 240, 0);
    shoot(stage, {on_a_post, {0, -4, 70}}, Promise::removed(Reason::below_terrain));
    shoot(stage, {land.over(171.3, 233.7, 0.04), {0, -4, 70}},
          Promise::removed(Reason::below_terrain));
    shoot(stage, {land.over(171.3, 233.7, 0.06), {0, -4, 70}},
          Promise::bound_up_to(limits::max_error_px));
  });
  also("up to 5 cm above the ground counts as below it, 6 cm is drawn");
}

TEST_F(Eye, twenty_kilometres_up) {
  why("Steep looks, long empty ways and the Earth's curve: 500 m of drop at 80 km.");
  const PatchShape shape{46, 8, 241, 361, 120, 120};  // 30" posts, 2 x 3 degrees
  const Patch& land = made(shape, [](int row, int column) {
    return 1500 + 900 * std::sin(row * 0.9) * std::cos(column * 0.7);
  });
  for (const double height_m : {20'000.0, limits::max_eye_height_m}) {
    const GeodeticPosition eye = land.at(120.3, 180.6, height_m);
    Stage stage(land, {.range_m = 100'000}, eye);
    for (const Attitude& attitude :
         {Attitude{5, -25, 120}, Attitude{0, -90, 0}, Attitude{0, -10, 315}, Attitude{0, -4, 45}}) {
      shoot(stage, {eye, attitude}, Promise::plain());
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
