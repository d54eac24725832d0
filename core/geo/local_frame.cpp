#include "core/geo/local_frame.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <cmath>
#include <numbers>

#include "config/limits.hpp"

namespace ridgeline {

Vec3<Ecef> ecef_from_geodetic(const GeodeticPosition& position) {
  Vec3<Ecef> point;
  GeographicLib::Geocentric::WGS84().Forward(position.latitude_deg, position.longitude_deg,
                                             position.height_m, point.xyz.x, point.xyz.y,
                                             point.xyz.z);
  return point;
}

GeodeticPosition geodetic_from_ecef(const Vec3<Ecef>& point) {
  GeodeticPosition position;
  GeographicLib::Geocentric::WGS84().Reverse(point.xyz.x, point.xyz.y, point.xyz.z,
                                             position.latitude_deg, position.longitude_deg,
                                             position.height_m);
  return position;
}

Result<LocalFrame> local_frame(const GeodeticPosition& eye) {
  if (!(std::abs(eye.latitude_deg) <= 90.0)) return Fault::latitude_out_of_range;
  if (!(eye.longitude_deg >= -180.0 && eye.longitude_deg <= 360.0)) {
    return Fault::longitude_out_of_range;
  }
  if (!(eye.height_m >= limits::min_eye_height_m && eye.height_m <= limits::max_eye_height_m)) {
    return Fault::height_out_of_range;
  }
  constexpr double deg = std::numbers::pi / 180.0;
  const double phi = eye.latitude_deg * deg;
  const double lambda = eye.longitude_deg * deg;
  LocalFrame frame;
  frame.eye = eye;
  if (frame.eye.longitude_deg >= 180.0) frame.eye.longitude_deg -= 360.0;
  frame.eye_ecef = ecef_from_geodetic(eye);
  const double sp = std::sin(phi), cp = std::cos(phi);
  const double sl = std::sin(lambda), cl = std::cos(lambda);
  frame.ecef_from_enu.columns =
      glm::dmat3(glm::dvec3(-sl, cl, 0.0), glm::dvec3(-sp * cl, -sp * sl, cp),
                 glm::dvec3(cp * cl, cp * sl, sp));
  const auto& earth = GeographicLib::Geocentric::WGS84();
  const double a = earth.EquatorialRadius();
  const double e2 = earth.Flattening() * (2.0 - earth.Flattening());
  const double w2 = 1.0 - e2 * sp * sp;
  frame.prime_vertical_radius_m = a / std::sqrt(w2);
  frame.meridian_radius_m = a * (1.0 - e2) / (w2 * std::sqrt(w2));
  return frame;
}

}  // namespace ridgeline
