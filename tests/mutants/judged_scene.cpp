#include "tests/mutants/judged_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>

#include "tests/oracle/verify.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {
namespace {

/// The options of a scene over its land, which is written once for all.
sim::SceneOptions options_over_land(const DesignedScene& scene) {
  static std::map<std::string_view, std::unique_ptr<TemporaryFolder>> lands;
  std::unique_ptr<TemporaryFolder>& land = lands[scene.land.name];
  if (land == nullptr) {
    land = std::make_unique<TemporaryFolder>();
    scene.land.write(land->path());
  }
  sim::SceneOptions options = scene.options;
  options.terrain_folder = land->path();
  if (options.geoid != "none") options.geoid = land->file(options.geoid);
  if (!options.edit_file.empty()) options.edit_file = land->file(options.edit_file);
  return options;
}

void require(const sim::Outcome& outcome) {
  if (outcome.ok()) return;
  std::fprintf(stderr, "%s\n", outcome.message.c_str());
  std::abort();
}

/// One dumped frame before the oracle.
void judge(const sim::SceneOptions& scene, const std::string& dump, int pixels,
           SceneVerdict& verdict) {
  oracle::VerifyOptions options;
  options.dump_folder = dump;
  options.terrain_folder = scene.terrain_folder;
  options.geoid = scene.geoid;
  if (!scene.edit_file.empty()) options.edit_file = scene.edit_file;
  options.pixels_per_frame = pixels;
  std::ostringstream progress;
  const oracle::VerifySummary summary = oracle::run_verify(options, progress);
  verdict.pixels += summary.pixels;
  verdict.violations += summary.violations();
  verdict.undecided += summary.undecided;
  verdict.largest_of_bound = std::max(verdict.largest_of_bound, summary.error_max_of_bound);
  for (const std::string& line : summary.details) {
    const bool undecided = line.find("leaves undecided") != std::string::npos;
    if (verdict.first.empty() && !undecided) verdict.first = line;
  }
}

}  // namespace

SceneVerdict judged(const DesignedScene& scene, Thoroughness thoroughness) {
  const sim::SceneOptions options = options_over_land(scene);
  const bool hurry = thoroughness == Thoroughness::first_violation;
  const ImageGeometry& image = options.settings.image;
  const int all = std::min(scene.pixels, image.width_px * image.height_px);
  SceneVerdict verdict;
  sim::Session session;
  require(session.open(options, scene.poses.front().eye));
  int index = 0;
  for (const ScenePose& pose : scene.poses) {
    FrameInput input;
    input.time_ns = std::llround(pose.time_s * 1e9);
    input.eye = pose.eye;
    input.attitude = pose.attitude;
    const sim::Picture picture = session.draw(input, true);
    if (picture.report.availability.mode == Mode::removed) {
      ++verdict.removed;
      continue;
    }
    ++verdict.frames;
    verdict.largest_bound_px = std::max(verdict.largest_bound_px, picture.report.bound_px);
    const TemporaryFolder dump;
    require(sim::write_dump(dump.path(), index++, picture, session.geoid_name()));
    if (!hurry) {
      judge(options, dump.path(), all, verdict);
      continue;
    }
    // Violations take long to be sure of: few pixels first, since a broken frame has many.
    for (int pixels = 32; verdict.violations == 0; pixels = pixels > all / 8 ? all : 16 * pixels) {
      judge(options, dump.path(), pixels, verdict);
      if (pixels >= all) break;
    }
    if (verdict.violations > 0) break;
  }
  return verdict;
}

}  // namespace ridgeline::test
