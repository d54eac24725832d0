// First pyramid level: a node is 2 x 2 cells and its bounds take one more cell on every side, so
// that a ray that leaves the node by rounding, or runs up to one post beside it, is still covered.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = posts_unit) uniform highp sampler2D posts_texture;
layout(r32f, binding = target_image) writeonly uniform highp image2D highest_image;

const float void_threshold = -50000.0;
const float void_offset = 100000.0;

void main() {
  ivec2 node = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(posts_texture, 0);
  if (any(greaterThanEqual(node, size / 2))) return;
  float highest = -1.0e9;
  for (int y = -1; y <= 3; ++y) {
    for (int x = -1; x <= 3; ++x) {
      ivec2 p = clamp(2 * node + ivec2(x, y), ivec2(0), size - 1);
      float h = texelFetch(posts_texture, p, 0).r;
      highest = max(highest, h < void_threshold ? h + void_offset : h);
    }
  }
  imageStore(highest_image, node, vec4(highest));
}
