// A fragment over an unknown cell is unknown, also in the triangle whose own three posts are known.
in float unknown;
in vec2 at;
flat in int level;
layout(location = 1) uniform bool any_unknown;

void main() {
  if (level > 0) {  // where a finer level is, that is drawn
    vec4 finer = vec4(level_rect[level - 1]);
    if (all(greaterThan(at, finer.xy)) && all(lessThan(at, finer.zw))) discard;
  }
  float here = unknown;
  if (any_unknown && here == 0.0) here = bilinear_height(at).y;
  put_ground(here);
  range_bits &= 0xfffffffeu;  // the last bit of a distance says whether a ray has found it
}
