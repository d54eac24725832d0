#pragma once
#include "core/base/result.hpp"
#include "core/base/vec.hpp"

namespace ridgeline {

/// A point on or over the WGS 84 ellipsoid.
struct GeodeticPosition {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;  ///< above the ellipsoid (HAE)
};

/// The level frame at the eye and the two radii of curvature of the ellipsoid under it.
struct LocalFrame {
  GeodeticPosition eye;
  Vec3<Ecef> eye_ecef;
  Rotation<Ecef, Enu> ecef_from_enu;
  double meridian_radius_m = 0;        ///< M, radius of curvature northwards
  double prime_vertical_radius_m = 0;  ///< N, radius of curvature eastwards
};

/// The frame whose z axis is the ellipsoid normal through the eye.
/// Frame:  output ECEF (WGS 84) and ENU with its origin at the eye.
/// Domain: |latitude| <= 90, -180 <= longitude <= 360, height inside config/limits.hpp.
/// Error:  that of GeographicLib::Geocentric (below 1e-8 m).
/// Source: Karney, GeographicLib; radii from the standard formulas for M and N.
Result<LocalFrame> local_frame(const GeodeticPosition& eye);

/// Geodetic coordinates to ECEF. Same domain as local_frame, not checked.
Vec3<Ecef> ecef_from_geodetic(const GeodeticPosition& position);

/// ECEF to geodetic coordinates; longitude in -180..180.
GeodeticPosition geodetic_from_ecef(const Vec3<Ecef>& point);

}  // namespace ridgeline
