#include "tests/hard/hard_case.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

namespace ridgeline::test {
namespace {

int stages_alive = 0;

constexpr double degrees = 180.0 / std::numbers::pi;

sim::SceneOptions scene_options(const StageOptions& options) {
  sim::SceneOptions result;
  result.settings.image = options.image;
  result.settings.error_px = options.error_px;
  result.settings.range_m = options.range_m;
  result.terrain_gpu_bytes = options.gpu_bytes;
  result.arrival = options.arrival;
  return result;
}

std::string mode_and_reasons(const Availability& availability) {
  std::string text(mode_word(availability.mode));
  for (const Reason reason : availability.reasons) text += ' ' + std::string(reason_word(reason));
  return text;
}

std::string command_of(const Stage& stage, const Pose& pose, const sim::Picture& picture) {
  std::ostringstream text;
  text.precision(15);
  text << "pose " << pose.eye.latitude_deg << ' ' << pose.eye.longitude_deg << ' '
       << pose.eye.height_m << ' ' << pose.attitude.roll_deg << ' ' << pose.attitude.pitch_deg
       << ' ' << pose.attitude.heading_deg << " --size " << stage.image.width_px << 'x'
       << stage.image.height_px << " --hfov " << stage.image.horizontal_field_of_view_deg
       << " --error " << picture.wanted_px << " --range " << picture.wanted_range_m << ": "
       << mode_and_reasons(picture.report.availability) << ", bound " << picture.report.bound_px
       << " px";
  return text.str();
}

void add(const oracle::VerifySummary& part, oracle::VerifySummary& sum) {
  sum.frames += part.frames;
  sum.removed_frames += part.removed_frames;
  sum.frame_faults += part.frame_faults;
  sum.pixels += part.pixels;
  sum.soundness_violations += part.soundness_violations;
  sum.completeness_violations += part.completeness_violations;
  sum.undecided += part.undecided;
  sum.error_max_px = std::max(sum.error_max_px, part.error_max_px);
  sum.error_max_of_bound = std::max(sum.error_max_of_bound, part.error_max_of_bound);
  sum.details.insert(sum.details.end(), part.details.begin(), part.details.end());
}

std::string pixels_text(double px) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", px);
  return text;
}

}  // namespace

Stage::Stage(const Land& over, const StageOptions& options, const GeodeticPosition& first)
    : land(over), image(options.image), scene(over, scene_options(options), first) {
  EXPECT_EQ(++stages_alive, 1);
}

Stage::~Stage() {
  --stages_alive;
}

const Patch& rough_land() {
  static const PatchShape shape{46, 8, 361, 481};
  static const Patch made(
      shape, [](int row, int column) { return rough_m(46 + row / 1200.0, 8 + column / 1200.0); });
  return made;
}

const Patch& hilly_land() {
  static const PatchShape shape{-33, -70, 361, 481};
  static const Patch made(shape, [](int row, int column) {
    return 900 + 250 * std::sin(row * 0.093) * std::cos(column * 0.061) +
           4 * ((row * 7919 + column * 104729) % 7 - 3);
  });
  return made;
}

bool Shot::says(Reason reason) const {
  const auto& reasons = picture.report.availability.reasons;
  return std::find(reasons.begin(), reasons.end(), reason) != reasons.end();
}

double Shot::range_m(int u, int v) const {
  if (u < 0 || v < 0 || u >= image.width_px || v >= image.height_px || !drawn()) {
    ADD_FAILURE() << "pixel (" << u << ", " << v << ") is not in the picture";
    return -1;
  }
  return static_cast<double>(
      picture.range_m[static_cast<std::size_t>(v) * image.width_px + static_cast<std::size_t>(u)]);
}

double Shot::range_m(const GeodeticPosition& point) const {
  const ImagePlace seen = place(point);
  EXPECT_TRUE(seen.in_front);
  return range_m(static_cast<int>(std::floor(seen.u_px)), static_cast<int>(std::floor(seen.v_px)));
}

std::string Promise::text() const {
  const std::string word(reason ? reason_word(*reason) : "");
  const std::string px = pixels_text(most_px) + " px";
  if (worst == Mode::removed && reason) return "removed: " + word;
  if (worst == Mode::removed) return "at most " + px + ", or removed";
  if (worst == Mode::svs) return "svs, bound " + px;
  if (!reason) return "svs, or bound_exceeded or range_reduced and at most " + px;
  return "svs, or " + word + " and at most " + px;
}

Attitude aimed(const GeodeticPosition& eye, const GeodeticPosition& point) {
  const GeographicLib::LocalCartesian local(eye.latitude_deg, eye.longitude_deg, eye.height_m);
  double east = 0, north = 0, up = 0;
  local.Forward(point.latitude_deg, point.longitude_deg, point.height_m, east, north, up);
  return {0, std::atan2(up, std::hypot(east, north)) * degrees, std::atan2(east, north) * degrees};
}

const Patch& HardCase::made(const PatchShape& shape, PatchHeight height_m,
                            std::vector<PatchPart> parts) {
  lands_.push_back(std::make_unique<Patch>(shape, std::move(height_m), std::move(parts)));
  return *lands_.back();
}

Shot HardCase::shoot(Stage& stage, const Pose& pose, const Promise& promise) {
  Shot shot{pose, stage.image, stage.scene.draw(pose)};
  shot.image = stage.scene.settings().image;
  const FrameReport& report = shot.picture.report;
  const std::string command = command_of(stage, pose, shot.picture);
  poses_.push_back(command);
  promises_.insert(promise.text());
  ++modes_[mode_and_reasons(report.availability)];
  EXPECT_LE(report.availability.mode, promise.worst) << command;
  if (promise.worst == Mode::removed && promise.reason) {
    EXPECT_EQ(report.availability.mode, Mode::removed) << command;
    EXPECT_TRUE(shot.says(*promise.reason)) << command;
  }
  if (promise.worst == Mode::degraded && report.availability.mode == Mode::degraded) {
    EXPECT_TRUE(shot.says(Reason::bound_exceeded) || shot.says(Reason::range_reduced)) << command;
  }
  if (shot.drawn()) {
    const bool may_be_larger = promise.worst != Mode::svs;
    EXPECT_LE(report.bound_px, promise.most_px) << command;
    EXPECT_GE(report.bound_px, shot.picture.wanted_px) << command;
    if (!may_be_larger) {
      EXPECT_EQ(report.bound_px, promise.most_px) << command;
    } else if (report.availability.mode != Mode::svs && promise.reason) {
      EXPECT_TRUE(shot.says(*promise.reason)) << command;
    }
    pixels_ += std::min(shot.picture.range_m.size(), static_cast<std::size_t>(pixels_per_frame_));
    least_px_ = std::min(least_px_, report.bound_px);
    most_px_ = std::max(most_px_, report.bound_px);
  }
  auto& folder = dumps_[&stage.land];
  if (!folder) folder = std::make_unique<TemporaryFolder>();
  const sim::Outcome written = sim::write_dump(folder->path(), shots_[&stage.land]++, shot.picture,
                                               stage.scene.session().geoid_name());
  EXPECT_TRUE(written.ok()) << written.message;
  return shot;
}

void HardCase::TearDown() {
  oracle::VerifySummary summary;
  std::size_t shots = 0;
  for (const auto& [land, folder] : dumps_) {
    oracle::VerifyOptions options;
    options.dump_folder = folder->path();
    options.terrain_folder = land->path();
    options.pixels_per_frame = pixels_per_frame_;
    std::ostringstream progress;
    add(oracle::run_verify(options, progress), summary);
    shots += static_cast<std::size_t>(shots_[land]);
  }
  std::string details;
  for (const std::string& line : summary.details) details += line + '\n';
  for (const std::string& line : poses_) details += line + '\n';
  EXPECT_FALSE(why_.empty()) << "a case says why it is hard";
  EXPECT_EQ(summary.frames, shots);
  EXPECT_EQ(summary.pixels, pixels_) << "every pixel asked for is judged";
  EXPECT_EQ(summary.violations(), 0U) << details;
  EXPECT_LE(summary.undecided, most_undecided_) << details;
  write_row(summary);
}

void HardCase::write_row(const oracle::VerifySummary& summary) const {
  std::ostringstream row;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  row << "| " << test->test_suite_name() << '.' << test->name() << " | " << why_ << " | ";
  const char* comma = "";
  for (const std::string& promise : promises_) {
    row << comma << promise;
    comma = "; ";
  }
  row << " | ";
  comma = "";
  for (const auto& [mode, frames] : modes_) {
    row << comma << frames << " × " << mode;
    comma = ", ";
  }
  row << " | ";
  if (pixels_ > 0) {
    row << pixels_text(least_px_);
    if (most_px_ > least_px_) row << " … " << pixels_text(most_px_);
  } else {
    row << "–";
  }
  row << " | " << summary.pixels << " | " << summary.violations() << " | " << summary.undecided
      << " | " << pixels_text(summary.error_max_px) << " | " << also_ << " |";
  std::printf("[   hard ] %s\n", row.str().c_str());
  const char* file = std::getenv("RL_HARD_TABLE");
  if (file != nullptr) std::ofstream(file, std::ios::app) << row.str() << '\n';
}

}  // namespace ridgeline::test
