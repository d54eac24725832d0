// The pyramid of sim/methods/post_pyramid.hpp as vertex shaders read it. After ground.glsl.

layout(binding = 8) uniform highp sampler2DArray pyramid_texture;

// Stored value (as of a post) of a node of 2^size lattice posts a side; nodes count from the one that
// holds the eye's post. Of a tent the node is a vertex: its south-west post.
float node_stored(ivec2 node, int size, int level) {
  int up = size - level;
  ivec2 posts = ivec2(level_size.xy), count = posts >> up;
  ivec2 texel = (level_eye[level].xy >> up) + node;
  texel += ivec2(lessThan(texel, ivec2(0))) * count;
  texel -= ivec2(greaterThanEqual(texel, count)) * count;
  if (up == 0) return texelFetch(posts_texture, ivec3(texel, level), 0).r;
  return texelFetch(pyramid_texture, ivec3(texel + pyramid_corner(posts, up), level), 0).r;
}

// How far the eye's post is into its node, in posts.
ivec2 into_node(int size) { return window.xy & ((1 << size) - 1); }

// x: height over the eye, y: 0, of a weighted mean of stored heights; where one of them that has any
// weight is unknown x is the highest floor of those and y is 1.
vec2 mean_height(vec4 stored, vec4 weight) {
  bvec4 counts = greaterThan(weight, vec4(0.0));
  bvec4 unknown = lessThan(stored, vec4(void_threshold));
  float top = -1.0e9, sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (counts[k] && unknown[k]) top = max(top, stored[k] + void_offset);
    if (counts[k]) sum += weight[k] * over_eye(stored[k]);
  }
  return top > -1.0e9 ? vec2(over_eye(top), 1.0) : vec2(sum, 0.0);
}

// Two heights blended; what is unknown in one that counts is unknown.
vec2 blended(vec2 a, vec2 b, float share) {
  if (share <= 0.0) return a;
  if (share >= 1.0) return b;
  if (a.y > 0.0 && b.y > 0.0) return vec2(max(a.x, b.x), 1.0);
  if (a.y > 0.0) return a;
  if (b.y > 0.0) return b;
  return vec2(mix(a.x, b.x, share), 0.0);
}
