#include "sim/bench/bench_judge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/coverage.hpp"
#include "tests/oracle/judge.hpp"
#include "tests/oracle/terrain.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::sim {
namespace {

oracle::Frame oracle_frame(const Picture& picture) {
  const FrameReport& report = picture.report;
  const Camera& camera = report.camera;
  oracle::Frame frame;
  frame.eye = {report.local.eye.latitude_deg, report.local.eye.longitude_deg,
               report.local.eye.height_m};
  const auto axes = (report.local.ecef_from_enu * camera.enu_from_camera).columns;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) frame.ecef_from_camera[3 * r + c] = axes[c][r];
  }
  frame.width = camera.width_px;
  frame.height = camera.height_px;
  frame.fx = camera.fx;
  frame.fy = camera.fy;
  frame.cx = camera.cx;
  frame.cy = camera.cy;
  frame.range_m = report.range_m;
  frame.bound_px = report.bound_px;
  frame.range = picture.range_m;
  return frame;
}

/// Whether what a pixel shows is of a class its own ray cannot have.
bool wrong_class(double shown, const oracle::FirstHit& truth) {
  if (std::isnan(shown)) return !truth.may_be_unknown;
  if (truth.must_be_unknown) return true;
  return std::isinf(shown) != truth.is_sky();
}

}  // namespace

struct BenchJudge::Truth {
  oracle::Terrain terrain;
};

BenchJudge::BenchJudge(const SceneOptions& scene) {
  oracle::Geoid geoid = scene.geoid == "none" ? oracle::Geoid() : oracle::Geoid::read(scene.geoid);
  std::vector<oracle::DegreeCell> sea;
  if (!scene.coverage_file.empty()) sea = oracle::read_coverage(scene.coverage_file);
  truth_.reset(new Truth{oracle::Terrain::load(scene.terrain_folder, std::move(geoid), {}, sea)});
}

BenchJudge::~BenchJudge() = default;

BenchError BenchJudge::error_of(const Picture& picture, int pixels) const {
  const oracle::Frame frame = oracle_frame(picture);
  const oracle::Tracer tracer(truth_->terrain, frame.eye, frame.range_m);
  const oracle::Tracer longer(truth_->terrain, frame.eye, frame.range_m * (1 + 2 * oracle::eta));
  const oracle::Judge judge(tracer, longer, frame);
  BenchError error;
  std::vector<double> errors_px;
  // An even lattice turned by the golden ratio: no two pixels share a row.
  for (int k = 0; k < pixels; ++k) {
    const double x = std::fmod((k + 0.5) * 0.6180339887498949, 1.0);
    const int u = static_cast<int>(x * frame.width);
    const int v = static_cast<int>((k + 0.5) / pixels * frame.height);
    const oracle::Judgement judged = judge.judge({u, v, std::nullopt, false});
    errors_px.push_back(judged.error_px);
    error.wrong_class_pixels += wrong_class(frame.z(u, v), judged.centre) ? 1 : 0;
  }
  if (errors_px.empty()) return error;
  std::sort(errors_px.begin(), errors_px.end());
  error.judged = static_cast<int>(errors_px.size());
  int over = 0;
  for (const double e : errors_px) {
    error.mean_px += e / error.judged;
    over += e > 1.0 ? 1 : 0;
  }
  error.percent_over_1px = 100.0 * over / error.judged;
  error.max_px = errors_px.back();
  error.p99_px = errors_px[static_cast<std::size_t>(0.99 * (error.judged - 1) + 0.5)];
  return error;
}

}  // namespace ridgeline::sim
