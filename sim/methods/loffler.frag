// A pixel of the grid's surface, and of the error buffer: the vertices' errors, interpolated (L6).
in vec2 at;
in float error;
in float unknown;
layout(location = 1) out highp uvec2 surface;  // error and distance, as float bits

// Unknown ground is told by its cell, for vertices may be many cells apart; and by the vertices, for a
// triangle that reaches up to the floor of an unknown one stands over no known ground.
float unknown_at(vec2 posts) {
  if (options.z == 0 || unknown > 0.0) return unknown;
  ivec2 cell = ivec2(floor(held_posts(posts)));
  int level = level_of(cell, cell + 1, 0);
  Window w = window_here();
  vec4 corners = four_posts(w, level_texel(w, cell, level), level);
  return any(lessThan(corners, vec4(void_threshold))) ? 1.0 : 0.0;
}

void main() {
  put_ground(unknown_at(at));
  surface = uvec2(floatBitsToUint(error), range_bits);
}
