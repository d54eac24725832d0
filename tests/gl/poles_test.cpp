// Frames at, near and across the poles: the real renderer in a polar chart against the oracle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/gl/scene.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr ImageGeometry small_image{200, 160, 60};
constexpr double km_deg = 1.0 / 111.69;  ///< a kilometre of latitude at a pole
constexpr int pixels = 200;

/// One ring of DTED level 0 tiles round a pole: a cap of one degree. `side`: 1 north, -1 south.
class Cap {
 public:
  Cap(int side, const sim::HeightFunction& height_m, int without_west_deg = 999) : side_(side) {
    const int south = side > 0 ? 89 : -90;
    const DtedShape shape = dted_shape(0, south);
    for (int west = -180; west < 180; ++west) {
      if (west == without_west_deg) continue;
      char name[32];
      std::snprintf(name, sizeof name, "%c%02d_%c%03d.dt0", south < 0 ? 's' : 'n', std::abs(south),
                    west < 0 ? 'w' : 'e', std::abs(west));
      write_dted(land.file(name), 0, south, west, [&](int row, int column) -> std::optional<int> {
        const double h =
            height_m(south + row / (shape.rows - 1.0), west + column / (shape.columns - 1.0));
        if (std::isnan(h)) return std::nullopt;
        return sim::stored_height_m(h);
      });
    }
  }

  /// An eye so many km from the pole along a meridian, beyond it where that is negative.
  [[nodiscard]] Pose pose(double before_km, double longitude_deg, double height_m,
                          const Attitude& attitude) const {
    const double beyond = before_km < 0 ? 180.0 : 0.0;
    const double longitude = std::remainder(longitude_deg + beyond, 360.0);
    return {{side_ * (90.0 - std::abs(before_km) * km_deg), longitude, height_m}, attitude};
  }

  TemporaryFolder land;

 private:
  int side_;
};

double plateau_m(double /*latitude_deg*/, double /*longitude_deg*/) {
  return 2800;
}

/// Ridges and hollows some kilometres wide, the same seen from any meridian: smooth at the pole.
double hills_m(double latitude_deg, double longitude_deg) {
  const double p = (90.0 - std::abs(latitude_deg)) / km_deg;
  const double x = p * std::sin(longitude_deg * deg), y = p * std::cos(longitude_deg * deg);
  return 600 + 220 * std::sin(x / 2.3) * std::cos(y / 3.1) + 120 * std::sin((x + 2 * y) / 5.7);
}

/// The same with posts that each stand for themselves: as rough as the steps allow.
double rough_cap_m(double latitude_deg, double longitude_deg) {
  const auto mixed = static_cast<std::uint32_t>(std::llround(latitude_deg * 3600) * 73'856'093 ^
                                                std::llround(longitude_deg * 3600) * 19'349'663);
  return hills_m(latitude_deg, longitude_deg) + (mixed >> 7U) % 60;
}

Scene scene_over(const Cap& cap, double range_m, const GeodeticPosition& first) {
  return {cap.land.path(), small_image, 1.0, range_m, first};
}

/// Draws and judges poses; tells mode and bound of each.
/// `rough`: frames may be removed for want of a bound.
void expect_sound_at(const char* what, const Cap& cap, double range_m,
                     const std::vector<Pose>& poses, bool rough = false) {
  std::vector<Pose> drawn;
  Scene s = scene_over(cap, range_m, poses.front().eye);
  for (const Pose& pose : poses) {
    const sim::Picture picture = s.draw(pose);
    const FrameReport& report = picture.report;
    std::string reasons;
    for (const Reason reason : report.availability.reasons) {
      reasons += ' ' + std::string(reason_word(reason));
    }
    std::printf("[  bound ] %s %.6f %.3f: %s %.2f px, range %.1f km%s\n", what,
                pose.eye.latitude_deg, pose.eye.longitude_deg,
                std::string(mode_word(report.availability.mode)).c_str(), report.bound_px,
                report.range_m / 1000, reasons.c_str());
    if (rough && report.availability.mode == Mode::removed) {
      EXPECT_EQ(report.availability.reasons[0], Reason::no_bound);
      continue;
    }
    EXPECT_EQ(report.range_m, range_m);
    drawn.push_back(pose);
  }
  if (!drawn.empty()) expect_sound(s, drawn, pixels);
}

std::vector<Pose> round_the_pole(const Cap& cap, double height_m) {
  return {cap.pose(0, 0, height_m, {0, -5, 0}),         cap.pose(0, 77, height_m, {15, -10, 200}),
          cap.pose(5, 30, height_m, {0, -6, 0}),        cap.pose(5, 30, height_m, {0, -6, 90}),
          cap.pose(-5, 30, height_m, {0, -6, 180}),     cap.pose(-5, 30, height_m, {-20, -12, 35}),
          cap.pose(0.02, 179.99, height_m, {0, -4, 60})};
}

class Poles : public testing::TestWithParam<int> {};

TEST_P(Poles, flat_plateau) {
  const Cap cap(GetParam(), plateau_m);
  std::vector<Pose> poses = round_the_pole(cap, 3'600);
  poses.push_back(cap.pose(0, -133, 3'000, {0, -90, 90}));
  poses.push_back(cap.pose(1, 10, 2'803, {0, 1, 20}));
  poses.push_back(cap.pose(30, -60, 20'000, {-100, -20, 300}));
  expect_sound_at("plateau", cap, 40'000, poses);
}

TEST_P(Poles, hills) {
  const Cap cap(GetParam(), hills_m);
  expect_sound_at("hills", cap, 30'000, round_the_pole(cap, 3'500));
}

TEST_P(Poles, rough_ground) {
  const Cap cap(GetParam(), rough_cap_m);
  expect_sound_at("rough", cap, 30'000, round_the_pole(cap, 4'000), true);
}

TEST_P(Poles, straight_down_on_ground_that_is_not_flat_has_no_bound) {
  const Cap cap(GetParam(), hills_m);
  const Pose down = cap.pose(1, 10, 3'500, {0, -80, 90});
  Scene s = scene_over(cap, 30'000, down.eye);
  const FrameReport report = s.draw(down).report;
  EXPECT_EQ(report.availability.mode, Mode::removed);
  EXPECT_EQ(report.availability.reasons[0], Reason::no_bound);
}

TEST_P(Poles, a_missing_tile_ends_the_range_and_is_never_seen_through) {
  const Cap cap(GetParam(), hills_m, 30);
  const std::vector<Pose> poses{cap.pose(12, -150, 3'500, {0, -4, 0}),
                                cap.pose(25, 100, 3'500, {0, -4, 330})};
  Scene s = scene_over(cap, 30'000, poses.front().eye);
  for (const Pose& pose : poses) EXPECT_LT(s.draw(pose).report.range_m, 26'000);
  expect_sound(s, poses, pixels);
}

TEST_P(Poles, flight_across_the_pole_loses_no_frame) {
  // Past the place where the chart changes, over the pole and out again on the other side.
  constexpr double range_m = 15'000, out_km = 88, step_km = 4;
  const Cap cap(GetParam(), hills_m);
  const double north = GetParam() > 0 ? 0.0 : 180.0;
  const Pose first = cap.pose(out_km, 25, 3'500, {0, -4, north});
  Scene s(cap.land.path(), small_image, 1.0, range_m, first.eye,
          sim::SceneOptions::Arrival::in_step);
  std::vector<Pose> poses;
  double worst_px = 0;
  bool in_geographic_chart = false;
  for (double km = out_km; km >= -out_km; km -= step_km) {
    poses.push_back(cap.pose(km, 25, 3'500, {0, -4, km < 0 ? 180.0 - north : north}));
    const sim::Picture picture = s.shoot(poses.back());
    const bool polar = s.session().terrain().lattice().polar();
    EXPECT_TRUE(polar || std::abs(km) >= 76) << km;
    in_geographic_chart = in_geographic_chart || !polar;
    EXPECT_NE(picture.report.availability.mode, Mode::removed) << km;
    EXPECT_GE(picture.report.range_m, 5'000) << km;
    worst_px = std::max(worst_px, picture.report.bound_px);
  }
  EXPECT_TRUE(in_geographic_chart);
  const oracle::VerifySummary summary = s.judged(60);
  std::string details;
  for (const std::string& line : summary.details) details += line + '\n';
  EXPECT_EQ(summary.violations(), 0U) << details;
  std::printf("[  bound ] flight: at most %.2f px in %zu frames\n", worst_px, poses.size());
}

TEST_P(Poles, a_peak_raised_in_flight_stands_in_the_next_frame) {
  const Cap cap(GetParam(), plateau_m);
  const TemporaryFolder files;
  const std::string edits = files.file("edits.txt"), dumps = files.file("dumps");
  std::filesystem::create_directory(dumps);
  // 5 x 41 posts from 14 km off the pole on, 30" by 3' apart, from 29 to 31 degrees east.
  std::ofstream(edits) << "1 " << (GetParam() > 0 ? "89.875" : "-89.9083333333")
                       << " 29 30 180 5 41"
                       << " fill 3000\n";
  sim::SceneOptions options;
  options.terrain_folder = cap.land.path();
  options.edit_file = edits;
  options.settings.image = small_image;
  options.settings.range_m = 30'000;
  const Pose pose = cap.pose(-6, 30, 4'200, {0, 12, GetParam() > 0 ? 0.0 : 180.0});
  sim::Session session;
  ASSERT_TRUE(session.open(options, pose.eye).ok());
  FrameInput input;
  input.eye = pose.eye;
  input.attitude = pose.attitude;
  std::array<sim::Picture, 2> pictures;
  for (int k = 0; k < 2; ++k) {
    input.time_ns = k * 1'000'000'000LL;
    sim::Picture& picture = pictures[static_cast<std::size_t>(k)];
    picture = session.draw(input, true);
    ASSERT_NE(picture.report.availability.mode, Mode::removed)
        << k << ' ' << reason_word(picture.report.availability.reasons[0]);
    ASSERT_TRUE(sim::write_dump(dumps, k, picture, "none").ok());
  }
  EXPECT_NE(pictures[0].range_m, pictures[1].range_m);
  oracle::VerifyOptions told;
  told.dump_folder = dumps;
  told.terrain_folder = cap.land.path();
  told.edit_file = edits;
  told.pixels_per_frame = 1'000;
  std::ostringstream progress;
  const oracle::VerifySummary summary = oracle::run_verify(told, progress);
  std::string details;
  for (const std::string& line : summary.details) details += line + '\n';
  EXPECT_EQ(summary.violations(), 0U) << details;
  EXPECT_EQ(summary.frames, 2U);
  std::printf("[  bound ] edit: %.2f px, then %.2f px\n", pictures[0].report.bound_px,
              pictures[1].report.bound_px);
}

INSTANTIATE_TEST_SUITE_P(Sides, Poles, testing::Values(1, -1),
                         [](const auto& side) { return side.param > 0 ? "north" : "south"; });

}  // namespace
}  // namespace ridgeline::test
