#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/oracle/dump.hpp"

namespace ridgeline::oracle {
namespace {

void check_axes(const Frame& frame, std::vector<std::string>& faults) {
  constexpr double tolerance = 1e-9;  // double rounding, and no more
  const std::array<double, 9>& m = frame.ecef_from_camera;
  const Vec3 axes[3] = {{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}};
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      worst = std::max(worst, std::abs(dot(axes[i], axes[j]) - (i == j ? 1.0 : 0.0)));
    }
  }
  if (!(worst <= tolerance)) faults.emplace_back("ecef_from_camera is not orthonormal");
  const CameraAxes truth = camera_axes(level_frame(frame.eye.lat_deg, frame.eye.lon_deg),
                                       frame.roll_deg, frame.pitch_deg, frame.heading_deg);
  const char* const names[3] = {"right", "down", "forward"};
  const Vec3 expected[3] = {truth.right, truth.down, truth.forward};
  for (int i = 0; i < 3; ++i) {
    if (!(length(axes[i] - expected[i]) <= tolerance)) {
      faults.push_back(std::string("the ") + names[i] +
                       " axis of ecef_from_camera is not that of eye and attitude");
    }
  }
}

void check_distances(const Frame& frame, std::vector<std::string>& faults) {
  std::size_t impossible = 0;
  std::size_t too_far = 0;
  const auto limit = static_cast<float>(frame.range_m * (1 + 1e-4));
  for (const float z : frame.range) {
    if (std::isnan(z) || z == std::numeric_limits<float>::infinity()) continue;
    if (!(z >= 0)) ++impossible;
    if (z > limit) ++too_far;
  }
  if (impossible > 0) faults.push_back(std::to_string(impossible) + " distances are negative");
  if (too_far > 0) {
    faults.push_back(std::to_string(too_far) + " distances are beyond the display range");
  }
}

}  // namespace

std::vector<std::string> frame_faults(const Frame& frame) {
  std::vector<std::string> faults;
  if (frame.color_width != frame.width || frame.color_height != frame.height) {
    faults.emplace_back("the colour image has not the frame's size");
  }
  if (frame.color_crc32 != frame.crc32) {
    faults.emplace_back("crc32 is not that of the colour image");
  }
  if (frame.mode == Mode::removed) {
    if (frame.bound_px) faults.emplace_back("a removed frame carries a bound");
    if (frame.has_range_file) faults.emplace_back("a removed frame has a range file");
    if (frame.reasons.empty()) faults.emplace_back("a removed frame does not say why");
    return faults;
  }
  if (!frame.bound_px || !(*frame.bound_px > 0) || !std::isfinite(*frame.bound_px)) {
    const bool unproven =
        std::find(frame.reasons.begin(), frame.reasons.end(), "unproven") != frame.reasons.end();
    faults.emplace_back(unproven ? "a drawn frame carries no bound: the method that drew it "
                                   "promises none, so there is nothing to verify"
                                 : "a drawn frame carries no bound");
  }
  if (frame.bound_px && frame.proven_px && !(*frame.proven_px <= *frame.bound_px)) {
    faults.emplace_back("proven_px is above the bound");
  }
  if (frame.mode == Mode::degraded && frame.reasons.empty()) {
    faults.emplace_back("a degraded frame does not say why");
  }
  check_axes(frame, faults);
  check_distances(frame, faults);
  return faults;
}

}  // namespace ridgeline::oracle
