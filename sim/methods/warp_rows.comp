// First pass: in each row of the map, the vertices of a line where equal shares of the row's
// importance end. One invocation a row.
layout(local_size_x = 8) in;
layout(binding = 6) uniform highp sampler2D importance_texture;
layout(r32f, binding = 0) writeonly uniform highp image2D rows_image;  // u; vertices x map rows

float asked(int x, int row) { return texelFetch(importance_texture, ivec2(x, row), 0).x; }

void main() {
  int row = int(gl_GlobalInvocationID.x);
  if (row >= warp_sizes.x) return;
  float total = 0.0;
  for (int x = 0; x < warp_sizes.x; ++x) total += asked(x, row);
  float share = total / float(warp_sizes.y - 1);
  int vertex = 0;
  float sum = 0.0;
  for (int x = 0; x < warp_sizes.x; ++x) {
    float a = asked(x, row);
    for (; vertex < warp_sizes.y && float(vertex) * share <= sum + a; ++vertex) {
      float u = (float(x) + (float(vertex) * share - sum) / a) / float(warp_sizes.x);
      imageStore(rows_image, ivec2(vertex, row), vec4(u));
    }
    sum += a;
  }
  for (; vertex < warp_sizes.y; ++vertex) imageStore(rows_image, ivec2(vertex, row), vec4(1.0));
}
