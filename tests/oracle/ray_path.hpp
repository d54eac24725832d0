#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "tests/oracle/geoid.hpp"
#include "tests/oracle/wgs84.hpp"

namespace ridgeline::oracle {

/// A polynomial of degree four on s in [-1, 1].
struct Quartic {
  std::array<double, 5> c{};

  [[nodiscard]] double at(double s) const {
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4])));
  }
  [[nodiscard]] double slope(double s) const {
    return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * 4 * c[4]));
  }
  /// A bound of the second derivative's magnitude over [-1, 1].
  [[nodiscard]] double bend() const {
    return 2 * std::abs(c[2]) + 6 * std::abs(c[3]) + 12 * std::abs(c[4]);
  }
  /// (this - shift) * scale.
  [[nodiscard]] Quartic mapped(double shift, double scale) const {
    Quartic result;
    for (std::size_t i = 0; i < c.size(); ++i) result.c[i] = c[i] * scale;
    result.c[0] = (c[0] - shift) * scale;
    return result;
  }
};

/// A straight stretch of a ray in geodetic coordinates, as polynomials through five exact points.
/// The distance along the ray is t = middle_m + s * half_m.
/// Error:  <= 1e-6 m against exact conversion (test RayPath.stretches_follow_the_exact_ray).
struct Stretch {
  double middle_m = 0;
  double half_m = 0;
  Quartic lat_deg;
  Quartic lon_deg;   ///< continuous, so it may leave [-180, 180]
  Quartic height_m;  ///< above the ellipsoid

  [[nodiscard]] double distance_m(double s) const { return middle_m + s * half_m; }
};

/// How a ray passes the Earth's axis. Longitude and latitude have their only singularity there; the
/// closer it is, the shorter a stretch must be.
class AxisPassage {
 public:
  AxisPassage(const Vec3& eye, const Vec3& direction);

  /// The longest stretch, in m, that starts at a distance along the ray and keeps the stated error.
  [[nodiscard]] double stretch_length_m(double from_m) const;

  /// The same distance, or where the ray goes through the axis itself and the distance is within a
  /// millimetre of it, the distance a millimetre behind it: between them all longitudes meet.
  [[nodiscard]] double past_axis_m(double from_m) const;

 private:
  double nearest_m_ = 0;   ///< the distance along the ray at which it is nearest to the axis
  double singular_m_ = 0;  ///< the singularity's distance from there, along the imaginary axis
};

/// The stretch of the ray `eye + t direction` for t in [from_m, to_m]. Its longitudes are
/// continuous and begin on the turn of `near_lon_deg`.
[[nodiscard]] Stretch stretch(const Vec3& eye, const Vec3& direction, double from_m, double to_m,
                              double near_lon_deg);

/// The ray's height above the datum of the posts, h - N, along a stretch inside one geoid patch.
[[nodiscard]] Quartic datum_height_m(const Stretch& stretch, const GeoidPatch& patch);

/// Appends every s in (from, to) at which a polynomial takes a value.
/// Domain: at most one turning point inside, which every stretch keeps.
void append_crossings(const Quartic& polynomial, double value, double from, double to,
                      std::vector<double>& crossings);

}  // namespace ridgeline::oracle
