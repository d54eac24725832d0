#include "sim/bench/bench_judge.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/coverage.hpp"
#include "tests/oracle/judge.hpp"
#include "tests/oracle/terrain.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::sim {
namespace {

constexpr double smallest_ring_px = 1.0 / 32;
constexpr double ring_growth = 1.5;
constexpr int ring_rays = 12;
constexpr double refine_share = 0.02, refine_px = 0.002;
constexpr float jump = 0.1F;  ///< of the distance between neighbours

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
  if (report.bound_px > 0) frame.bound_px = report.bound_px;
  frame.range = picture.range_m;
  return frame;
}

/// Whether what a pixel shows is of a class its own ray cannot have.
bool wrong_class(double shown, const oracle::FirstHit& truth) {
  if (std::isnan(shown)) return !truth.may_be_unknown;
  if (truth.must_be_unknown) return true;
  return std::isinf(shown) != truth.is_sky();
}

bool is_jump(const Picture& picture, int u, int v) {
  const Camera& camera = picture.report.camera;
  const auto at = [&](int x, int y) {
    return picture.range_m[static_cast<std::size_t>(y) * camera.width_px + x];
  };
  const float here = at(u, v);
  for (const auto& [x, y] : {std::pair{u + 1, v}, std::pair{u, v + 1}}) {
    if (x >= camera.width_px || y >= camera.height_px) continue;
    const float there = at(x, y);
    const bool same_class =
        std::isfinite(here) == std::isfinite(there) && std::isnan(here) == std::isnan(there);
    if (!same_class) return true;
    if (std::isfinite(here) && std::abs(there - here) > jump * std::min(here, there)) return true;
  }
  return false;
}

struct JudgedPixel {
  int u = 0, v = 0;
  bool even = true;  ///< of the even spread
  oracle::FirstHit truth;
};

struct PixelError {
  double px = 0;
  bool is_larger = false;
};

/// Runs work(k) for every k < count on all processors.
template <typename Work>
void share_out(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t k = next++; k < count; k = next++) work(k);
  };
  std::vector<std::thread> threads;
  for (unsigned k = 1; k < std::max(1U, std::thread::hardware_concurrency()); ++k) {
    threads.emplace_back(take);
  }
  take();
  for (std::thread& thread : threads) thread.join();
}

/// The radius of the smallest disc found that makes what a pixel shows sound.
PixelError error_of_pixel(const oracle::Tracer& tracer, const oracle::Camera& camera, double shown,
                          const JudgedPixel& pixel) {
  if (oracle::claims_of(shown, pixel.truth, oracle::eta).all()) return {};
  oracle::PixelSearch search(tracer, camera, {pixel.u + 0.5, pixel.v + 0.5}, shown, oracle::eta,
                             pixel.truth);
  search.search_linearly(0.05, BenchJudge::largest_px);
  bool between = false;
  for (double radius_px = smallest_ring_px; !search.done(); radius_px *= ring_growth) {
    if (radius_px > BenchJudge::largest_px) return {BenchJudge::largest_px, true};
    for (int ray = 0; ray < ring_rays && !search.done(); ++ray) {
      const double angle = 2 * oracle::pi * (ray + (between ? 0.5 : 0.0)) / ring_rays;
      search.add(radius_px * oracle::turned(search.down(), angle));
    }
    between = !between;
  }
  search.refine(refine_share, refine_px);
  return {search.radius_px(), false};
}

}  // namespace

struct BenchJudge::State {
  /// One view at one display range; a method may draw a shorter one than another.
  struct View {
    oracle::Tracer tracer, longer;
    double range_m;
    std::vector<JudgedPixel> pixels;
  };
  View& view_of(const oracle::Frame& frame) {
    for (const auto& view : views) {
      if (view->range_m == frame.range_m) return *view;
    }
    views.push_back(
        std::make_unique<View>(View{{terrain, frame.eye, frame.range_m},
                                    {terrain, frame.eye, frame.range_m * (1 + 2 * oracle::eta)},
                                    frame.range_m,
                                    pixels}));
    View& view = *views.back();
    const oracle::Camera camera(frame);
    share_out(pixels.size(), [&](std::size_t k) {
      JudgedPixel& pixel = view.pixels[k];
      pixel.truth = view.tracer.first_hit(camera.direction({pixel.u + 0.5, pixel.v + 0.5}));
    });
    return view;
  }

  oracle::Terrain terrain;
  std::vector<JudgedPixel> pixels;
  std::vector<std::unique_ptr<View>> views;
};

BenchJudge::BenchJudge(const SceneOptions& scene) {
  oracle::Geoid geoid = scene.geoid == "none" ? oracle::Geoid() : oracle::Geoid::read(scene.geoid);
  std::vector<oracle::DegreeCell> sea;
  if (!scene.coverage_file.empty()) sea = oracle::read_coverage(scene.coverage_file);
  state_.reset(
      new State{oracle::Terrain::load(scene.terrain_folder, std::move(geoid), {}, sea), {}, {}});
}

BenchJudge::~BenchJudge() = default;

void BenchJudge::begin_view(const Picture& reference, int pixels) {
  const Camera& camera = reference.report.camera;
  state_->views.clear();
  state_->pixels.clear();
  // An even lattice turned by the golden ratio: no two pixels share a row.
  for (int k = 0; k < pixels; ++k) {
    const double x = std::fmod((k + 0.5) * 0.6180339887498949, 1.0);
    state_->pixels.push_back({static_cast<int>(x * camera.width_px),
                              static_cast<int>((k + 0.5) / pixels * camera.height_px),
                              true,
                              {}});
  }
  std::vector<JudgedPixel> jumps;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (is_jump(reference, u, v)) jumps.push_back({u, v, false, {}});
    }
  }
  const std::size_t wanted = std::min(jumps.size(), static_cast<std::size_t>(pixels) / 4);
  for (std::size_t k = 0; k < wanted; ++k) {
    state_->pixels.push_back(jumps[k * jumps.size() / wanted]);
  }
}

BenchError BenchJudge::error_of(const Picture& picture) {
  const oracle::Frame frame = oracle_frame(picture);
  const State::View& view = state_->view_of(frame);
  const oracle::Camera camera(frame);
  std::optional<oracle::Judge> judge;
  if (frame.bound_px) judge.emplace(view.tracer, view.longer, frame);
  std::vector<PixelError> errors(view.pixels.size());
  share_out(errors.size(), [&](std::size_t k) {
    const JudgedPixel& pixel = view.pixels[k];
    errors[k] = error_of_pixel(view.tracer, camera, frame.z(pixel.u, pixel.v), pixel);
    if (!judge || errors[k].px <= *frame.bound_px) return;
    // More than was promised: the thorough search of `verify` decides.
    const oracle::Judgement judged = judge->judge({pixel.u, pixel.v, std::nullopt, false});
    if (judged.error_px < errors[k].px) errors[k] = {judged.error_px, judged.error_is_larger};
  });
  BenchError error;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const JudgedPixel& pixel = view.pixels[k];
    error.worst_px = std::max(error.worst_px, errors[k].px);
    error.worst_is_larger = error.worst_is_larger || errors[k].is_larger;
    if (!pixel.even) continue;
    error.errors_px.push_back(errors[k].px);
    error.wrong_class += wrong_class(frame.z(pixel.u, pixel.v), pixel.truth) ? 1 : 0;
  }
  return error;
}

}  // namespace ridgeline::sim
