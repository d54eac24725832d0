// Shared by the passes of the warp method (warp_grid.hpp). The domain is the square round the foot of
// the eye: u east, v north, 0..1 over twice the display range. Densities are vertices a unit of u or v.
layout(location = 0) uniform highp ivec4 warp_sizes;  // x: texels of the map; y: vertices a side
// x: wanted edge, px; y: most vertices a post; z: 1 with detail; w: 1 where some post is unknown
layout(location = 1) uniform highp vec4 warp_asks;
