// One vertex of the warped geometry image; gl_VertexID counts them row by row, in rows of
// warp_sizes.z.
layout(binding = 6) uniform highp sampler2D positions_texture;
out vec2 at;         // post coordinates below the vertex
out float unknown;
out float carried;   // octave of detail

// Post coordinates below a position: as ray_point() of ray.glsl.
vec2 posts_below(vec3 p) {
  float across = max(length(p.xy), 1.0e-3);
  vec2 azimuth = p.xy / across;
  float inverse_radius = earth.x * azimuth.y * azimuth.y + earth.y * azimuth.x * azimuth.x;
  float v = across / (1.0 / inverse_radius + earth.w + p.z);
  float w = v * v;
  return posts_of_ground(azimuth * v * (1.0 - w * (1.0 / 3.0 - w * 0.2)) / inverse_radius);
}

void main() {
  ivec2 vertex = ivec2(gl_VertexID % warp_sizes.z, gl_VertexID / warp_sizes.z);
  vec4 p = texelFetch(positions_texture, vertex, 0);
  at = warp_asks.z + warp_asks.w > 0.5 ? posts_below(p.xyz) : vec2(0.0);  // else nobody asks
  unknown = p.w > 32.0 ? 1.0 : 0.0;
  carried = p.w - 64.0 * unknown;
  gl_Position = clip_of(p.xyz);
  gl_Position.y *= warp_upward;
}
