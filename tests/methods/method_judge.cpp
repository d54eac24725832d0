#include "tests/methods/method_judge.hpp"

#include <algorithm>

#include "tests/oracle/judge.hpp"

namespace ridgeline::test {
namespace {

constexpr double judge_reach = 4;  ///< bounds up to which oracle::Judge measures an error

oracle::Frame frame_of(const sim::Picture& picture, double claim_px) {
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
  frame.bound_px = claim_px;
  frame.range = picture.range_m;
  return frame;
}

}  // namespace

int JudgedPicture::unsound() const {
  return static_cast<int>(
      std::count_if(pixels.begin(), pixels.end(), [](const JudgedPixel& p) { return p.unsound; }));
}

int JudgedPicture::incomplete() const {
  return static_cast<int>(std::count_if(pixels.begin(), pixels.end(),
                                        [](const JudgedPixel& p) { return p.incomplete; }));
}

double JudgedPicture::percent_over(double error_px) const {
  const auto over = std::count_if(pixels.begin(), pixels.end(),
                                  [&](const JudgedPixel& p) { return p.error_px > error_px; });
  return 100.0 * static_cast<double>(over) / static_cast<double>(pixels.size());
}

double JudgedPicture::mean_px() const {
  double sum = 0;
  for (const JudgedPixel& p : pixels) sum += p.error_px;
  return sum / static_cast<double>(pixels.size());
}

double JudgedPicture::max_px() const {
  double most = 0;
  for (const JudgedPixel& p : pixels) most = std::max(most, p.error_px);
  return most;
}

struct MethodJudge::Truth {
  oracle::Terrain terrain;
};

MethodJudge::MethodJudge(const std::string& terrain_folder)
    : truth_(new Truth{oracle::Terrain::load(terrain_folder, oracle::Geoid(), {})}) {}

MethodJudge::~MethodJudge() = default;

JudgedPicture MethodJudge::judge(const sim::Picture& picture, const PixelSet& set, double claim_px,
                                 double most_px) const {
  const oracle::Frame frame = frame_of(picture, claim_px);
  const oracle::Frame wide_frame = frame_of(picture, most_px / judge_reach);
  const oracle::Tracer tracer(truth_->terrain, frame.eye, frame.range_m);
  const oracle::Tracer longer(truth_->terrain, frame.eye, frame.range_m * (1 + 2 * oracle::eta));
  const oracle::Judge judge(tracer, longer, frame), wide(tracer, longer, wide_frame);
  JudgedPicture result;
  result.claim_px = claim_px;
  for (int v = set.top; v < set.bottom; v += set.step) {
    for (int u = set.left; u < set.right; u += set.step) {
      oracle::Judgement judged = judge.judge({u, v, std::nullopt, false});
      JudgedPixel pixel{u, v, judged.soundness == oracle::Verdict::violated,
                        judged.completeness == oracle::Verdict::violated, judged.error_px};
      if (judged.error_is_larger) {
        judged = wide.judge({u, v, std::nullopt, false});
        pixel.error_px = judged.error_px;
      }
      result.pixels.push_back(pixel);
    }
  }
  return result;
}

}  // namespace ridgeline::test
