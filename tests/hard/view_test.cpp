// Hard directions and cameras: axes, verticals, rolls, fields of view, narrow pictures.
#include <cmath>

#include "tests/hard/hard_case.hpp"

namespace ridgeline::test {
namespace {

class View : public HardCase {};

Pose high(const Patch& land, double over_m, const Attitude& attitude) {
  return {land.over(180.3, 239.6, over_m), attitude};
}

/// How many of the pixels of `a` differ in class or by more than a thousandth from those that
/// `partner(u, v)` names in `b`.
template <typename Partner>
int different(const Shot& a, const Shot& b, const Partner& partner) {
  int count = 0;
  for (int v = 0; v < a.image.height_px; ++v) {
    for (int u = 0; u < a.image.width_px; ++u) {
      const auto [x, y] = partner(u, v);
      const double p = a.range_m(u, v), q = b.range_m(x, y);
      count += p == q || std::abs(p - q) < 1e-3 * p ? 0 : 1;
    }
  }
  return count;
}

TEST_F(View, azimuth_exactly_on_axes_and_diagonals) {
  why("Rates of zero across rows or columns, and rays through corners of cells one after another.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (int k = 0; k < 8; ++k) {
      shoot(stage, {land.over(180, 240, 250), {0, 0, 45.0 * k}}, promise);
    }
  });
}

TEST_F(View, nadir) {
  why("The planes of the grid meet in the picture; azimuth has no meaning in its middle.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (const Attitude& attitude : {Attitude{0, -90, 0}, Attitude{0, -90, 45},
                                     Attitude{90, -90, 90}, Attitude{-17, -90, 201}}) {
      EXPECT_NEAR(shoot(stage, high(land, 900, attitude), promise).middle_m(), 900, 0.01);
    }
  });
  also("the middle pixel shows the height over the ground to 1 cm");
}

TEST_F(View, zenith) {
  why("Straight up there is sky and nothing else, except from a pit, where walls ring the "
      "picture.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (const Attitude& attitude : {Attitude{0, 90, 0}, Attitude{33, 90, 270}}) {
      const Shot shot = shoot(stage, high(land, 600, attitude), promise);
      for (const float range : shot.picture.range_m) ASSERT_TRUE(std::isinf(range));
    }
  });
  const PatchShape shape{-33, -70, 361, 361};
  const Patch& pit = made(shape, [](int row, int column) {
    return row >= 180 && row <= 181 && column >= 180 && column <= 181 ? -500 : 8500;
  });
  const GeodeticPosition bottom = pit.over(180.5, 180.5, 3);
  Stage deep(pit, {}, bottom);
  const Shot up = shoot(deep, {bottom, {0, 90, 0}}, Promise::bound_up_to(8));
  EXPECT_TRUE(std::isinf(up.middle_m()));
  EXPECT_TRUE(std::isfinite(up.range_m(0, 48)));
  EXPECT_TRUE(std::isfinite(up.range_m(128, 48)));
  also("all pixels are sky; from the floor of a 9000 m pit only the mouth is");
}

TEST_F(View, pitch_89_999) {
  why("A thousandth of a degree from the vertical: forward has almost no horizontal part.");
  in_both_windows({}, [&](Stage& stage, const Patch& land, const Promise& promise) {
    for (const double heading : {0.0, 77.0, 180.0}) {
      const Shot down = shoot(stage, high(land, 700, {0, -89.999, heading}), promise);
      EXPECT_NEAR(down.middle_m(), 700, 0.1);
      const Shot up = shoot(stage, high(land, 700, {10, 89.999, heading}), promise);
      EXPECT_TRUE(std::isinf(up.middle_m()));
    }
  });
  also("the middle pixel shows the height over the ground to 10 cm");
}

TEST_F(View, roll_0_90_180) {
  why("Rows of the picture become planes of the grid; left for right or up for down would show.");
  const int last = 96, hundredth = 97 * 97 / 100;
  in_both_windows({.image = {97, 97, 60}}, [&](Stage& stage, const Patch& land,
                                               const Promise& promise) {
    const auto rolled = [&](double roll) {
      return shoot(stage, high(land, 400, {roll, -6, 30}), promise);
    };
    const Shot level = rolled(0), right = rolled(90), left = rolled(-90), over = rolled(180);
    // Right wing down: what was at the right is at the top.
    EXPECT_LE(different(level, right, [&](int u, int v) { return std::pair(v, last - u); }),
              hundredth);
    EXPECT_LE(different(level, left, [&](int u, int v) { return std::pair(last - v, u); }),
              hundredth);
    EXPECT_LE(different(level, over, [&](int u, int v) { return std::pair(last - u, last - v); }),
              hundredth);
    EXPECT_GT(different(level, over, [](int u, int v) { return std::pair(u, v); }), 50 * hundredth);
    rolled(45);
  });
  also("pictures at ±90 and 180 degrees are that at 0 turned, but for 1 % of the pixels");
}

TEST_F(View, field_of_view_10_and_120) {
  why("Narrow: a radian is 740 pixels, the smallest angle counts. Wide: the corner has four times "
      "the scale of the middle.");
  for (const double fov : {10.0, 120.0}) {
    in_both_windows(
        {.image = {129, 97, fov}}, [&](Stage& stage, const Patch& land, const Promise& promise) {
          for (const Attitude& attitude : {Attitude{0, -2, 15}, Attitude{40, -12, 190}}) {
            shoot(stage, high(land, 300, attitude), promise);
          }
        });
  }
}

TEST_F(View, pixels_are_square_in_pictures_of_any_shape) {
  why("fx and fy are separate in the contract; in a strip the diagonal is almost flat to the "
      "image.");
  struct Strip {
    ImageGeometry image;
    Promise promise;
  };
  const Strip strips[] = {
      {{641, 16, 60}, Promise::plain()},
      {{16, 641, 10}, Promise::plain()},
      {{641, 16, 120}, Promise::plain()},
      // 16 columns over 120 degrees: 641 rows reach to 89.2 degrees off the axis.
      {{16, 641, 120}, Promise::bound_up_to(limits::max_error_px)},
  };
  for (const Strip& strip : strips) {
    Stage stage(rough_land(), {.image = strip.image}, high(rough_land(), 300, {}).eye);
    const Shot shot = shoot(stage, high(rough_land(), 300, {4, -3, 100}), strip.promise);
    EXPECT_EQ(shot.picture.report.camera.fx, shot.picture.report.camera.fy);
  }
  also("no setting makes fx and fy differ; every frame says equal ones");
}

}  // namespace
}  // namespace ridgeline::test
