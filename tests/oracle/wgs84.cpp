#include "tests/oracle/wgs84.hpp"

namespace ridgeline::oracle {

Vec3 ecef_from_geodetic(const Geodetic& position) {
  const double lat = position.lat_deg * degree_rad;
  const double lon = position.lon_deg * degree_rad;
  const double s = std::sin(lat);
  const double c = std::cos(lat);
  const double n = semi_major_m / std::sqrt(1.0 - eccentricity_squared * s * s);
  return {(n + position.height_m) * c * std::cos(lon), (n + position.height_m) * c * std::sin(lon),
          (n * (1.0 - eccentricity_squared) + position.height_m) * s};
}

Geodetic geodetic_from_ecef(const Vec3& point) {
  constexpr double second_eccentricity_squared =
      eccentricity_squared / (1.0 - eccentricity_squared);
  const double p = std::sqrt(point.x * point.x + point.y * point.y);
  // The reduced latitude is iterated as a tangent (Bowring). From the first guess one round leaves
  // 0.1 mm along the ground and the second less than rounding does.
  double sin_beta = point.z * semi_major_m;
  double cos_beta = p * semi_minor_m;
  double sin_lat = 0;
  double cos_lat = 1;
  for (int round = 0; round < 2; ++round) {
    const double scale = 1.0 / std::sqrt(sin_beta * sin_beta + cos_beta * cos_beta);
    sin_beta *= scale;
    cos_beta *= scale;
    sin_lat = point.z + second_eccentricity_squared * semi_minor_m * sin_beta * sin_beta * sin_beta;
    cos_lat = p - eccentricity_squared * semi_major_m * cos_beta * cos_beta * cos_beta;
    sin_beta = (1.0 - flattening) * sin_lat;
    cos_beta = cos_lat;
  }
  const double scale = 1.0 / std::sqrt(sin_lat * sin_lat + cos_lat * cos_lat);
  sin_lat *= scale;
  cos_lat *= scale;
  // This form of the height has no cancellation at any latitude, and an error of the latitude
  // enters it only squared.
  const double height = p * cos_lat + point.z * sin_lat -
                        semi_major_m * std::sqrt(1.0 - eccentricity_squared * sin_lat * sin_lat);
  return {std::atan2(sin_lat, cos_lat) / degree_rad, std::atan2(point.y, point.x) / degree_rad,
          height};
}

LevelFrame level_frame(double lat_deg, double lon_deg) {
  const double lat = lat_deg * degree_rad;
  const double lon = lon_deg * degree_rad;
  const double sp = std::sin(lat);
  const double cp = std::cos(lat);
  const double sl = std::sin(lon);
  const double cl = std::cos(lon);
  return {{-sp * cl, -sp * sl, cp}, {-sl, cl, 0}, {-cp * cl, -cp * sl, -sp}};
}

CameraAxes camera_axes(const LevelFrame& level, double roll_deg, double pitch_deg,
                       double heading_deg) {
  const double heading = heading_deg * degree_rad;
  const double pitch = pitch_deg * degree_rad;
  const double roll = roll_deg * degree_rad;
  const Vec3 ahead = std::cos(heading) * level.north + std::sin(heading) * level.east;
  const Vec3 level_right = std::cos(heading) * level.east - std::sin(heading) * level.north;
  const Vec3 forward = std::cos(pitch) * ahead - std::sin(pitch) * level.down;
  const Vec3 belly = std::sin(pitch) * ahead + std::cos(pitch) * level.down;
  return {std::cos(roll) * level_right + std::sin(roll) * belly,
          std::cos(roll) * belly - std::sin(roll) * level_right, forward};
}

}  // namespace ridgeline::oracle
