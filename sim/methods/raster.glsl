// Fragments of methods that draw geometry: the distance along the pixel's own ray, from w of clip_of().
// After frame_block.h. Depth is written by the fragment, linear in the distance: the [-1, 1] depth of
// OpenGL ES leaves 1/w no digits 100 km away.
layout(location = 0) out highp uint range_bits;  // the distance as float bits

// `unknown`: any share of an unknown post makes the fragment unknown.
void put_ground(float unknown) {
  vec2 pixel = floor(gl_FragCoord.xy);
  float t = length(ray_origin.xyz + pixel.x * ray_dx.xyz + pixel.y * ray_dy.xyz) / gl_FragCoord.w;
  if (!(t <= ray_origin.w)) discard;  // the cleared target says sky
  range_bits = floatBitsToUint(unknown > 0.0 ? -t : t);
  gl_FragDepth = t / ray_origin.w;
}
