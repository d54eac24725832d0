#pragma once

namespace ridgeline::sim {

/// Arc tangent of y / x in degrees, in the quadrant of the point; -180..180, and 0 for (0, 0).
/// Error:  within 1e-13 degrees, and the same bits on every machine: libm does not promise that,
///         and the committed checksum of the demo log needs it.
/// Source: series of the arc tangent after one reduction by 30 degrees.
[[nodiscard]] double arc_tangent_deg(double y, double x);

}  // namespace ridgeline::sim
