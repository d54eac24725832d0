#pragma once
#include <cmath>

/// The oracle's own WGS 84 geodesy. It shares nothing with the renderer on purpose.
namespace ridgeline::oracle {

/// A vector or point. Frame: ECEF (WGS 84) unless a name says otherwise. Units: m, or none.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

[[nodiscard]] inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}
[[nodiscard]] inline Vec3 normalised(const Vec3& a) {
  return (1.0 / length(a)) * a;
}

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degree_rad = pi / 180.0;

/// WGS 84 defining constants. Source: NIMA TR8350.2.
inline constexpr double semi_major_m = 6378137.0;
inline constexpr double flattening = 1.0 / 298.257223563;
inline constexpr double semi_minor_m = semi_major_m * (1.0 - flattening);
inline constexpr double eccentricity_squared = flattening * (2.0 - flattening);

/// A geodetic position. Units: degrees; m above the ellipsoid.
struct Geodetic {
  double lat_deg = 0;
  double lon_deg = 0;  ///< (-180, 180]; 0 on the axis
  double height_m = 0;
};

/// The ECEF point of a geodetic position.
[[nodiscard]] Vec3 ecef_from_geodetic(const Geodetic& position);

/// The geodetic position of an ECEF point, by iteration to the precision of double.
/// Domain: farther than 100 km from the Earth's centre.
/// Error:  <= 1e-8 m within 100 km of the surface (test Wgs84.round_trip_is_exact_to_10_nm).
[[nodiscard]] Geodetic geodetic_from_ecef(const Vec3& point);

/// Unit vectors of the local level frame at a geodetic position, in ECEF.
struct LevelFrame {
  Vec3 north;
  Vec3 east;
  Vec3 down;
};
[[nodiscard]] LevelFrame level_frame(double lat_deg, double lon_deg);

/// Camera axes in ECEF.
struct CameraAxes {
  Vec3 right;
  Vec3 down;
  Vec3 forward;
};

/// The camera axes of an attitude: heading (true), then pitch (nose up), then roll (right wing
/// down), the camera looking along the aircraft's nose.
/// Units: degrees.
[[nodiscard]] CameraAxes camera_axes(const LevelFrame& level, double roll_deg, double pitch_deg,
                                     double heading_deg);

}  // namespace ridgeline::oracle
