#pragma once
#include "core/base/result.hpp"
#include "core/geo/local_frame.hpp"

namespace ridgeline {

/// Attitude of the aircraft, which is that of the camera.
struct Attitude {
  double roll_deg = 0;     ///< right wing down positive
  double pitch_deg = 0;    ///< nose up positive
  double heading_deg = 0;  ///< true, clockwise from north
};

/// What the picture looks like, apart from the pose.
struct ImageGeometry {
  int width_px = 1024;
  int height_px = 800;
  double horizontal_field_of_view_deg = 60;
};

/// A pinhole camera at the eye.
/// The ray of pixel (u, v) is enu_from_camera * normalise((u + 1/2 - cx)/fx, (v + 1/2 - cy)/fy, 1).
struct Camera {
  Attitude attitude;
  Rotation<Enu, CameraAxes> enu_from_camera;
  int width_px = 0;
  int height_px = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels

  /// Direction (not normalised) of the image point (u, v) in pixels; pixel centres at +1/2.
  [[nodiscard]] Vec3<Enu> ray(double u_px, double v_px) const {
    return enu_from_camera * Vec3<CameraAxes>{{(u_px - cx) / fx, (v_px - cy) / fy, 1.0}};
  }
  /// Largest angle between the axis and any ray of the picture grown by `margin_px`, rad.
  [[nodiscard]] double half_diagonal_rad(double margin_px) const;
};

/// Camera from attitude and image geometry.
/// Domain: finite attitude, |roll| <= 360, |pitch| <= 90, |heading| <= 720; field of view and size
///         inside config/limits.hpp, else the fault that names the item.
Result<Camera> camera(const Attitude& attitude, const ImageGeometry& image);

}  // namespace ridgeline
