// Unknown is what lies over an unknown cell, however far apart the vertices stand, and every triangle
// with a corner in one: its height comes from a floor.
in vec2 at;
in float unknown;
in float carried;

void main() {
  float here = unknown;
  if (warp_asks.w > 0.5) here = max(here, bilinear_height(at).y);
  put_ground(here);
}
