// Shared by the passes of the warp method (warp_grid.hpp). The domain is a square round the foot of the
// eye, 0..1 over twice the display range: v runs along the view, u to the right of it. Densities are
// vertices a unit of u or v.
layout(location = 0) uniform highp ivec4 warp_sizes;  // x: texels of the map; y: vertices a side; z: as in warp_stride()
// x: wanted edge, px; y: most vertices a post; z: 1 with detail; w: 1 where some post is unknown
layout(location = 1) uniform highp vec4 warp_asks;
layout(location = 2) uniform highp vec2 warp_ahead;  // east and north of the direction of v
layout(location = 3) uniform highp float warp_upward;  // 1: row 0 of the target is the top; -1: the bottom

// From the square's axes to east and north.
vec2 from_square(vec2 p) {
  return vec2(warp_ahead.y * p.x + warp_ahead.x * p.y, -warp_ahead.x * p.x + warp_ahead.y * p.y);
}
