#include "tests/gl/scene.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <sstream>

#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

void require(const sim::Outcome& outcome) {
  if (outcome.ok()) return;
  std::fprintf(stderr, "%s\n", outcome.message.c_str());
  std::abort();
}

/// A number in 0..1 that depends on the post alone.
double lottery(double latitude_deg, double longitude_deg) {
  auto bits = static_cast<std::uint64_t>(std::llround(latitude_deg * 3600) + 400'000) * 2'000'003U +
              static_cast<std::uint64_t>(std::llround(longitude_deg * 3600) + 2'000'000);
  bits ^= bits >> 33U;
  bits *= 0xff51afd7ed558ccdULL;
  bits ^= bits >> 33U;
  bits *= 0xc4ceb9fe1a85ec53ULL;
  bits ^= bits >> 33U;
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

double east_of_greenwich(double longitude_deg) {
  return longitude_deg < 0 ? longitude_deg + 360 : longitude_deg;
}

}  // namespace

void Land::add_tile(int south_deg, int west_deg, int posts) const {
  require(sim::write_tile_with(folder_.path(), south_deg, west_deg, posts, height_m_));
}

void Land::add_dted(int south_deg, int west_deg) const {
  const DtedShape shape = dted_shape(1, south_deg);
  char name[32];
  std::snprintf(name, sizeof name, "%c%02d_%c%03d.dt1", south_deg < 0 ? 's' : 'n',
                std::abs(south_deg), west_deg < 0 ? 'w' : 'e', std::abs(west_deg));
  const PostHeight post = [&](int row, int column) -> std::optional<int> {
    const double h =
        height_m_(south_deg + row / (shape.rows - 1.0), west_deg + column / (shape.columns - 1.0));
    if (std::isnan(h)) return std::nullopt;
    return sim::stored_height_m(h);
  };
  write_dted(folder_.file(name), 1, south_deg, west_deg, post);
}

double Land::ground_m(double latitude_deg, double longitude_deg, double latitude_step_deg,
                      double longitude_step_deg) const {
  const double y = latitude_deg / latitude_step_deg, x = longitude_deg / longitude_step_deg;
  const double row = std::floor(y), column = std::floor(x);
  const auto at = [&](double r, double c) {
    const double h = height_m_(r * latitude_step_deg, c * longitude_step_deg);
    return std::isnan(h) ? h : static_cast<double>(sim::stored_height_m(h));
  };
  const double fy = y - row, fx = x - column;
  return (1 - fy) * ((1 - fx) * at(row, column) + fx * at(row, column + 1)) +
         fy * ((1 - fx) * at(row + 1, column) + fx * at(row + 1, column + 1));
}

double rough_m(double latitude_deg, double longitude_deg) {
  const double lon = east_of_greenwich(longitude_deg);
  const double spire = lottery(latitude_deg, lon) > 0.999 ? 400 : 0;
  return 900 + 500 * std::sin(latitude_deg * 41) * std::cos(lon * 37) +
         220 * std::sin(latitude_deg * 173 + lon * 211) + 60 * lottery(latitude_deg, lon) + spire;
}

double rough_with_voids_m(double latitude_deg, double longitude_deg) {
  const double lon = east_of_greenwich(longitude_deg);
  const bool island = std::sin(latitude_deg * 90) * std::sin(lon * 70) > 0.96;
  const bool speck = lottery(lon, latitude_deg) > 0.9995;
  return island || speck ? std::nan("") : rough_m(latitude_deg, longitude_deg);
}

namespace {

sim::SceneOptions scene_options(const ImageGeometry& image, double error_px, double range_m) {
  sim::SceneOptions options;
  options.settings.image = image;
  options.settings.error_px = error_px;
  options.settings.range_m = range_m;
  return options;
}

}  // namespace

Scene::Scene(const Land& land, const ImageGeometry& image, double error_px, double range_m,
             const GeodeticPosition& first)
    : Scene(land, scene_options(image, error_px, range_m), first) {}

Scene::Scene(const Land& land, sim::SceneOptions options, const GeodeticPosition& first)
    : options_(std::move(options)) {
  options_.terrain_folder = land.path();
  require(session_.open(options_, first));
}

Scene::Scene(const std::string& land_path, const ImageGeometry& image, double error_px,
             double range_m, const GeodeticPosition& first, sim::SceneOptions::Arrival arrival)
    : options_(scene_options(image, error_px, range_m)) {
  options_.terrain_folder = land_path;
  options_.arrival = arrival;
  require(session_.open(options_, first));
}

sim::Picture Scene::draw(const Pose& pose, double time_s) {
  FrameInput input;
  input.time_ns = std::llround(time_s * 1e9);
  input.eye = pose.eye;
  input.attitude = pose.attitude;
  return session_.draw(input, true);
}

sim::Picture Scene::shoot(const Pose& pose, double time_s) {
  sim::Picture picture = draw(pose, time_s);
  require(sim::write_dump(dumps_.path(), shots_++, picture, session_.geoid_name()));
  return picture;
}

oracle::VerifySummary Scene::judged(int pixels_per_frame) const {
  oracle::VerifyOptions options;
  options.dump_folder = dumps_.path();
  options.terrain_folder = options_.terrain_folder;
  if (!options_.coverage_file.empty()) options.coverage_file = options_.coverage_file;
  if (!options_.edit_file.empty()) options.edit_file = options_.edit_file;
  if (options_.geoid != "none") options.geoid = options_.geoid;
  options.pixels_per_frame = pixels_per_frame;
  std::ostringstream progress;
  return oracle::run_verify(options, progress);
}

void expect_sound(Scene& scene, const std::vector<Pose>& poses, int pixels_per_frame,
                  int may_lack_bound) {
  std::ostringstream commands;
  const FrameSettings& s = scene.settings();
  for (const Pose& pose : poses) {
    const sim::Picture picture = scene.shoot(pose);
    commands.precision(12);
    commands << "pose " << pose.eye.latitude_deg << ' ' << pose.eye.longitude_deg << ' '
             << pose.eye.height_m << ' ' << pose.attitude.roll_deg << ' ' << pose.attitude.pitch_deg
             << ' ' << pose.attitude.heading_deg << " --size " << s.image.width_px << 'x'
             << s.image.height_px << " --hfov " << s.image.horizontal_field_of_view_deg
             << " --error " << s.error_px << " --range " << s.range_m << '\n';
    const Availability& availability = picture.report.availability;
    if (may_lack_bound > 0 && availability.mode == Mode::removed) {
      EXPECT_EQ(availability.reasons[0], Reason::no_bound) << commands.str();
      --may_lack_bound;
      continue;
    }
    EXPECT_NE(availability.mode, Mode::removed) << commands.str();
    EXPECT_GT(picture.report.bound_px, 0.0);
  }
  const oracle::VerifySummary summary = scene.judged(pixels_per_frame);
  std::string details;
  for (const std::string& line : summary.details) details += line + '\n';
  EXPECT_EQ(summary.violations(), 0U) << details << commands.str();
  EXPECT_EQ(summary.frames, poses.size());
  EXPECT_GE(summary.pixels, poses.size());
  std::printf("[ oracle ] %zu pixels, %zu undecided, largest error %.3f px, %.3f of the bound\n",
              summary.pixels, summary.undecided, summary.error_max_px, summary.error_max_of_bound);
}

ImagePlace image_place(const Pose& pose, const ImageGeometry& image,
                       const GeodeticPosition& point) {
  const GeographicLib::LocalCartesian local(pose.eye.latitude_deg, pose.eye.longitude_deg,
                                            pose.eye.height_m);
  double east = 0, north = 0, up = 0;
  local.Forward(point.latitude_deg, point.longitude_deg, point.height_m, east, north, up);
  // Undo heading, then pitch, then roll: forward, right, down of the aircraft.
  const double psi = pose.attitude.heading_deg * deg, theta = pose.attitude.pitch_deg * deg;
  const double phi = pose.attitude.roll_deg * deg;
  const double ahead = north * std::cos(psi) + east * std::sin(psi);
  const double right = east * std::cos(psi) - north * std::sin(psi);
  const double forward = ahead * std::cos(theta) + up * std::sin(theta);
  const double below = ahead * std::sin(theta) - up * std::cos(theta);
  const double x = right * std::cos(phi) + below * std::sin(phi);
  const double y = below * std::cos(phi) - right * std::sin(phi);
  const double focal =
      0.5 * image.width_px / std::tan(0.5 * image.horizontal_field_of_view_deg * deg);
  return {0.5 * image.width_px + focal * x / forward, 0.5 * image.height_px + focal * y / forward,
          std::sqrt(east * east + north * north + up * up), forward > 0};
}

}  // namespace ridgeline::test
