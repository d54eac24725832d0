#pragma once
#include "tests/oracle/dump.hpp"
#include "tests/oracle/wgs84.hpp"

namespace ridgeline::oracle {

/// A point of the image plane, or an offset in it. Units: pixels, x right, y down; the centre of
/// pixel (u, v) is (u + 1/2, v + 1/2).
struct ImagePoint {
  double x = 0;
  double y = 0;
};

[[nodiscard]] inline ImagePoint operator+(const ImagePoint& a, const ImagePoint& b) {
  return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] inline ImagePoint operator*(double s, const ImagePoint& a) {
  return {s * a.x, s * a.y};
}

/// The rays of a frame's image points.
class Camera {
 public:
  explicit Camera(const Frame& frame) : frame_(&frame) {
    const std::array<double, 9>& m = frame.ecef_from_camera;
    right_ = {m[0], m[3], m[6]};
    down_ = {m[1], m[4], m[7]};
    forward_ = {m[2], m[5], m[8]};
    earthward_ = level_frame(frame.eye.lat_deg, frame.eye.lon_deg).down;
  }

  /// The unit vector of a ray, ECEF.
  [[nodiscard]] Vec3 direction(const ImagePoint& p) const {
    return normalised(((p.x - frame_->cx) / frame_->fx) * right_ +
                      ((p.y - frame_->cy) / frame_->fy) * down_ + forward_);
  }

  /// The direction in the image, of length 1 px, in which a ray turns straight down to earth.
  [[nodiscard]] ImagePoint image_down(const ImagePoint& p) const {
    const double x = (p.x - frame_->cx) / frame_->fx;
    const double y = (p.y - frame_->cy) / frame_->fy;
    const double ahead = dot(earthward_, forward_);
    const ImagePoint turn{frame_->fx * (dot(earthward_, right_) - x * ahead),
                          frame_->fy * (dot(earthward_, down_) - y * ahead)};
    const double size = std::hypot(turn.x, turn.y);
    if (!(size > 1e-9)) return {0, 1};
    return (1 / size) * turn;
  }

  /// The sine of a ray's angle above the eye's horizontal.
  [[nodiscard]] double sine_above_level(const Vec3& direction) const {
    return -dot(earthward_, direction);
  }

 private:
  const Frame* frame_;
  Vec3 right_;
  Vec3 down_;
  Vec3 forward_;
  Vec3 earthward_;
};

}  // namespace ridgeline::oracle
