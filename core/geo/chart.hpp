#pragma once
#include <cstdint>

#include "core/geo/local_frame.hpp"

namespace ridgeline {

/// Which plane coordinates the terrain window is cut in. Latitude and longitude serve everywhere
/// but near the poles, where they are no short polynomials of the way over the ground. There the
/// plane is azimuthal: colatitude (90 degrees less the latitude from the pole's equator side) as
/// the distance from the pole, longitude as the direction. It is smooth across the pole.
enum class Chart : std::uint8_t { geographic, north_polar, south_polar };

/// A place on the ellipsoid. Units: degrees (WGS 84).
struct GroundPlace {
  double latitude_deg = 0, longitude_deg = 0;
};

/// A point or an offset in the plane of a chart. Units: degrees, of colatitude in a polar chart.
/// Frame: seen from above, `north` is a quarter turn to the left of `east`, in every chart.
struct ChartPoint {
  double east_deg = 0, north_deg = 0;
};

/// The point of a place in a polar chart, from the pole; the meridian of Greenwich points to
/// negative `north` in the north polar chart and to positive `north` in the other.
[[nodiscard]] ChartPoint polar_point(Chart chart, const GroundPlace& place);
/// Domain: points within 180 degrees of the pole; longitude in -180..180.
[[nodiscard]] GroundPlace polar_place(Chart chart, const ChartPoint& point);

/// Offset of a place from the eye in the chart, turned so that the eye's meridian is its north.
[[nodiscard]] ChartPoint chart_offset(Chart chart, const GeodeticPosition& eye,
                                      const GroundPlace& place);
/// The place at such an offset: the inverse of chart_offset().
[[nodiscard]] GroundPlace place_at(Chart chart, const GeodeticPosition& eye,
                                   const ChartPoint& offset);

/// Cosine and sine of the angle from the eye's east to the chart's `east`, counter-clockwise:
/// chart = (cosine e - sine n, sine e + cosine n).
struct Turn {
  double cosine = 1, sine = 0;
};
[[nodiscard]] Turn turn_of(Chart chart, const GeodeticPosition& eye);

/// The chart for an eye and the display range. It stays as it is for a while (hysteresis), so that
/// a flight along the border does not change it again and again.
[[nodiscard]] Chart chart_for(Chart now, double latitude_deg, double range_m);

/// Distance from the pole at which an eye is given a polar chart, and from which it keeps none.
/// Units: degrees of colatitude.
[[nodiscard]] double polar_enter_deg(double range_m);
[[nodiscard]] double polar_leave_deg(double range_m);

}  // namespace ridgeline
