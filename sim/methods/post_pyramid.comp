// One step of a pyramid of posts: nodes of 2^up posts of a level a side from those half as large, or,
// for the first step, from the posts. Each invocation makes one node.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = posts_unit) uniform highp sampler2DArray posts_texture;
layout(binding = target_image, r32f) uniform highp image2DArray pyramid;

// Posts count from a multiple of 64 at or south-west of the first one that is held.
layout(location = 0) uniform ivec4 held;     // first and last post of the level that is held
layout(location = 1) uniform ivec4 place;    // xy: texel of post 0; zw: posts of the level
layout(location = 2) uniform ivec4 step_of;  // x: level; y: up; z: 1 for a tent, 0 for a box

const float void_threshold = -50000.0;
const float void_offset = 100000.0;

// As in shaders/terrain.glsl.
ivec2 corner_of(int up) {
  return up < 2 ? ivec2(0) : ivec2(place.z >> 1, (place.w >> 1) - (place.w >> (up - 1)));
}

ivec2 texel_of(ivec2 node, int up) {
  ivec2 count = place.zw >> up;
  ivec2 texel = (place.xy >> up) + node;
  texel += ivec2(lessThan(texel, ivec2(0))) * count;
  return texel - ivec2(greaterThanEqual(texel, count)) * count;
}

float child_at(ivec2 child, int up) {
  if (up == 0) return texelFetch(posts_texture, ivec3(texel_of(child, 0), step_of.x), 0).r;
  return imageLoad(pyramid, ivec3(texel_of(child, up) + corner_of(up), step_of.x)).r;
}

// Whether a child of 2^up posts stands for a post that is held; of a tent, for its own.
bool child_held(ivec2 child, int up) {
  ivec2 first = child << up;
  ivec2 last = step_of.z == 1 ? first : first + (1 << up) - 1;
  return all(greaterThanEqual(last, held.xy)) && all(lessThanEqual(first, held.zw));
}

void main() {
  int up = step_of.y;
  ivec2 node = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThan(node << up, held.zw))) return;
  int from = step_of.z == 1 ? -1 : 0;
  float sum = 0.0, weights = 0.0, floor_height = -1.0e9;
  for (int y = from; y <= 1; ++y) {
    for (int x = from; x <= 1; ++x) {
      ivec2 child = 2 * node + ivec2(x, y);
      if (!child_held(child, up - 1)) continue;
      float stored = child_at(child, up - 1);
      float weight = step_of.z == 1 ? float((2 - abs(x)) * (2 - abs(y))) : 1.0;
      if (stored < void_threshold) floor_height = max(floor_height, stored + void_offset);
      sum += weight * stored;
      weights += weight;
    }
  }
  float value = floor_height > -1.0e9 ? floor_height - void_offset : sum / max(weights, 1.0);
  if (weights == 0.0) value = -void_offset;  // stands for nothing that is held
  imageStore(pyramid, ivec3(texel_of(node, up) + corner_of(up), step_of.x), vec4(value));
}
