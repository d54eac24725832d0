// Next pyramid level: the maximum of four nodes; overlap of one cell carries over by itself.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = highest_unit) uniform highp sampler2D highest_texture;
layout(r32f, binding = target_image) writeonly uniform highp image2D highest_image;
layout(location = 0) uniform int source_level;

void main() {
  ivec2 node = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(highest_texture, source_level);
  if (any(greaterThanEqual(node, size / 2))) return;
  float highest = -1.0e9;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      highest = max(highest, texelFetch(highest_texture, 2 * node + ivec2(x, y), source_level).r);
    }
  }
  imageStore(highest_image, node, vec4(highest));
}
