// Next pyramid level: the maximum of four nodes; the overlap of one cell carries over by itself.
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f, binding = target_image) uniform highp image2D pyramid_image;
layout(location = 0) uniform ivec4 corners;  // xy of the level below, zw of this one
layout(location = 1) uniform ivec2 size;     // of this level

void main() {
  ivec2 node = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(node, size))) return;
  float highest = -1.0e9;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      highest = max(highest, imageLoad(pyramid_image, corners.xy + 2 * node + ivec2(x, y)).r);
    }
  }
  imageStore(pyramid_image, corners.zw + node, vec4(highest));
}
