// A low eye over high ground: what rounding takes from a height, half a millimetre there, would be
// a part in ten thousand of the distance. Cells round the eye are drawn about the eye.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/session/session.hpp"
#include "tests/gl/scene.hpp"
#include "tests/support/geoid_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr double ground_m = 8925.30029;  ///< as far from any float as a height can be
constexpr GeodeticPosition place{46.513, 9.527, 0};

double plain_m(double, double) {
  return 8900;
}

/// A scene over a land of one tile, 46 N 9 E, and a geoid.
class LowEye : public testing::Test {
 protected:
  void stage(sim::HeightFunction height_m, double least_m, double more_m) {
    land_.emplace(std::move(height_m));
    land_->add_tile(46, 9);
    const std::string geoid = geoid_.path() + "/geoid.gtx";
    write_geoid(geoid, {40, 52, 0, 20}, least_m, more_m);
    sim::SceneOptions options;
    options.geoid = geoid;
    options.settings.image = {161, 121, 60};
    options.settings.range_m = 10'000;
    scene_.emplace(*land_, options, place);
  }
  [[nodiscard]] Scene& scene() { return *scene_; }
  [[nodiscard]] double ground_under_m(double latitude_deg, double longitude_deg) {
    return land_->ground_m(latitude_deg, longitude_deg) +
           scene_->session().geoid_undulation_m(latitude_deg, longitude_deg);
  }
  /// Every pixel of what was shot, at the slack of the contract and without any.
  void expect_exact(int frames) {
    const oracle::VerifySummary summary = scene_->judged(1 << 20);
    EXPECT_EQ(summary.frames - summary.removed_frames, static_cast<std::size_t>(frames));
    EXPECT_EQ(summary.violations(), 0U);
    EXPECT_EQ(summary.undecided, 0U);
  }

 private:
  TemporaryFolder geoid_;
  std::optional<Land> land_;
  std::optional<Scene> scene_;
};

TEST_F(LowEye, straight_down_over_high_ground_is_exact_to_micrometres) {
  stage(plain_m, ground_m - 8900, 0);
  for (const double over_m : {0.07, 0.5, 2.5, 12.0}) {
    const GeodeticPosition eye{place.latitude_deg, place.longitude_deg, ground_m + over_m};
    const sim::Picture picture = scene().shoot({eye, {0, -90, 20}});
    ASSERT_EQ(picture.report.availability.mode, Mode::svs) << over_m;
    const double middle_m = static_cast<double>(picture.range_m[60 * 161 + 80]);
    EXPECT_NEAR(middle_m, over_m, 1e-5 * over_m + 4e-6);
    scene().shoot({eye, {0, -40, 130}});
  }
  expect_exact(8);
}

TEST_F(LowEye, from_nadir_to_zenith_over_high_ground_is_sound) {
  stage(plain_m, ground_m - 8900, 0);
  for (int pitch = -90; pitch <= 60; pitch += 30) {
    const GeodeticPosition eye{place.latitude_deg, place.longitude_deg, ground_m + 2.5};
    const sim::Picture picture = scene().shoot({eye, {90, 1.0 * pitch, 20}});
    EXPECT_NE(picture.report.availability.mode, Mode::removed) << pitch;
  }
  expect_exact(6);
}

TEST_F(LowEye, over_slopes_edges_and_posts_is_sound) {
  stage([](double a, double b) { return 7000 + 0.5 * rough_m(a, b); }, 25, 10);
  int shot = 0;
  for (int k = 0; k < 12; ++k) {
    // Inside cells, on their edges and on posts.
    const double row = 600 + 7 * k + (k % 3 == 0 ? 0.0 : 0.37);
    const double column = 640 + 5 * k + (k % 2 == 0 ? 0.0 : 0.83);
    const double latitude_deg = 46 + row / 1200, longitude_deg = 9 + column / 1200;
    const double over_m = 1.5 + 0.9 * k;
    const GeodeticPosition eye{latitude_deg, longitude_deg,
                               ground_under_m(latitude_deg, longitude_deg) + over_m};
    const sim::Picture picture = scene().shoot({eye, {10.0 * k, -75 + 11.0 * k, 31.0 * k}});
    const bool drawn = picture.report.availability.mode != Mode::removed;
    shot += drawn ? 1 : 0;
  }
  EXPECT_GE(shot, 10);
  expect_exact(shot);
}

TEST_F(LowEye, beside_unknown_ground_sees_it) {
  const auto half = [](double a, double b) {
    return b > 9.5301 ? std::nan("") : 7000 + 0.1 * rough_m(a, b);
  };
  stage(half, 25, 10);
  const double longitude_deg = 9 + 635.4 / 1200;  // the void begins at post 637
  const GeodeticPosition eye{place.latitude_deg, longitude_deg,
                             ground_under_m(place.latitude_deg, longitude_deg) + 3};
  const sim::Picture east = scene().shoot({eye, {0, -10, 90}});
  ASSERT_NE(east.report.availability.mode, Mode::removed)
      << reason_word(*east.report.availability.reasons.begin());
  EXPECT_GT(std::count_if(east.range_m.begin(), east.range_m.end(),
                          [](float z) { return std::isnan(z); }),
            1000);
  scene().shoot({eye, {0, -40, 200}});
  expect_exact(2);
}

}  // namespace
}  // namespace ridgeline::test
