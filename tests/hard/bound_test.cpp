// Extreme bounds, and inputs that are no pose at all.
#include <cmath>
#include <limits>

#include "tests/cli/program.hpp"
#include "tests/hard/hard_case.hpp"

namespace ridgeline::test {
namespace {

class Bound : public HardCase {};

TEST_F(Bound, of_64_px) {
  why("A disc larger than half the picture allows almost anything; the picture must still be "
      "whole.");
  in_both_windows({.image = {49, 37, 60}, .error_px = 64},
                  [&](Stage& stage, const Patch& land, const Promise&) {
                    const GeodeticPosition eye = land.over(180.3, 240.2, 300);
                    for (const Attitude& attitude : {Attitude{0, -3, 20}, Attitude{50, -3, 200}}) {
                      const Shot shot = shoot(stage, {eye, attitude}, Promise::plain(64));
                      EXPECT_TRUE(std::isfinite(shot.range_m(24, 36)));
                    }
                  });
}

TEST_F(Bound, of_a_thousandth_of_a_pixel) {
  why("Float32 cannot keep it: the frame must say the smallest bound it has, and keep that one.");
  const GeodeticPosition eye = rough_land().over(180.3, 240.2, 300);
  Stage stage(rough_land(), {}, eye);
  stage.scene.settings().error_px = 0.001;
  for (const Attitude& attitude : {Attitude{0, -3, 20}, Attitude{50, -60, 200}}) {
    const Shot shot = shoot(stage, {eye, attitude}, Promise::bound_up_to(0.1));
    EXPECT_TRUE(shot.says(Reason::bound_exceeded));
    const ErrorBudget& budget = shot.picture.report.budget;
    EXPECT_EQ(shot.picture.report.bound_px, budget.smallest_px());
    EXPECT_GT(budget.geometry_px, 1e-4);
  }
  also("the bound is twice what the geometry of the pose costs, and says bound_exceeded");
}

TEST_F(Bound, poses_that_are_none) {
  why("NaN, infinities and absurd numbers pass every comparison the wrong way round.");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const GeodeticPosition eye = rough_land().over(180.3, 240.2, 300);
  Stage stage(rough_land(), {}, eye);
  const auto removed = [&](const GeodeticPosition& place, const Attitude& attitude, Reason reason) {
    const Shot shot = shoot(stage, {place, attitude}, Promise::removed(reason));
    EXPECT_TRUE(shot.picture.range_m.empty());
    EXPECT_EQ(shot.picture.report.bound_px, 0);
    EXPECT_EQ(shot.picture.rgb.size(), std::size_t{3} * 129 * 97);
  };
  for (const double wrong : {nan, inf, -inf, 1e300, -1e300}) {
    removed({wrong, eye.longitude_deg, eye.height_m}, {}, Reason::position_invalid);
    removed({eye.latitude_deg, wrong, eye.height_m}, {}, Reason::position_invalid);
    removed({eye.latitude_deg, eye.longitude_deg, wrong}, {}, Reason::position_invalid);
    removed(eye, {wrong, 0, 0}, Reason::attitude_invalid);
    removed(eye, {0, wrong, 0}, Reason::attitude_invalid);
    removed(eye, {0, 0, wrong}, Reason::attitude_invalid);
  }
  for (const GeodeticPosition& place :
       {GeodeticPosition{90.0000001, 8.2, 900}, GeodeticPosition{46.1, 360.5, 900},
        GeodeticPosition{46.1, -180.5, 900}, GeodeticPosition{46.1, 8.2, -600.1},
        GeodeticPosition{46.1, 8.2, 20'500.1}}) {
    removed(place, {}, Reason::position_invalid);
  }
  for (const Attitude& attitude : {Attitude{360.1, 0, 0}, Attitude{0, 90.0001, 0},
                                   Attitude{0, -90.0001, 0}, Attitude{0, 0, 720.5}}) {
    removed(eye, attitude, Reason::attitude_invalid);
  }
  // And after all that the next good pose is drawn.
  shoot(stage, {eye, {0, -3, 20}}, Promise::plain());
  also("each is removed with its reason and still a picture; the next good pose is drawn");
}

TEST_F(Bound, refused_on_the_command_line) {
  why("The same numbers typed by a person must be refused before anything is opened.");
  const FlatScene scene;
  for (int place = 1; place <= 6; ++place) {
    for (const char* word : {"nan", "-inf", "1e300", "1,5"}) {
      std::vector<std::string> arguments = scene.pose();
      arguments[static_cast<std::size_t>(place)] = word;
      const Ended ended = ridgeline(arguments);
      EXPECT_EQ(ended.status, 2) << place << " '" << word << "': " << ended.out << ended.err;
      EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    }
  }
  also("every one ends with exit status 2 and one line");
}

}  // namespace
}  // namespace ridgeline::test
