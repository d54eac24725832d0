// Second pass: along each line of the first pass, the same for the importance along v that lies
// under the line. One invocation a line.
layout(local_size_x = 8) in;
layout(binding = 6) uniform highp sampler2D importance_texture;
layout(binding = 7) uniform highp sampler2D rows_texture;
layout(r32f, binding = 0) writeonly uniform highp image2D columns_image;  // v; vertices x vertices

// Linear between the middles of texels: neighbouring lines must not differ by a whole texel.
float asked(int line, int row) {
  float x = texelFetch(rows_texture, ivec2(line, row), 0).r * float(warp_sizes.x) - 0.5;
  int west = clamp(int(floor(x)), 0, warp_sizes.x - 2);
  return mix(texelFetch(importance_texture, ivec2(west, row), 0).y,
             texelFetch(importance_texture, ivec2(west + 1, row), 0).y,
             clamp(x - float(west), 0.0, 1.0));
}

void main() {
  int line = int(gl_GlobalInvocationID.x);
  if (line >= warp_sizes.y) return;
  float total = 0.0;
  for (int row = 0; row < warp_sizes.x; ++row) total += asked(line, row);
  float share = total / float(warp_sizes.y - 1);
  int vertex = 0;
  float sum = 0.0;
  for (int row = 0; row < warp_sizes.x; ++row) {
    float a = asked(line, row);
    for (; vertex < warp_sizes.y && float(vertex) * share <= sum + a; ++vertex) {
      float v = (float(row) + (float(vertex) * share - sum) / a) / float(warp_sizes.x);
      imageStore(columns_image, ivec2(line, vertex), vec4(v));
    }
    sum += a;
  }
  for (; vertex < warp_sizes.y; ++vertex) {
    imageStore(columns_image, ivec2(line, vertex), vec4(1.0));
  }
}
