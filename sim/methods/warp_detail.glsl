// Procedural detail of the warp method: octaves of value noise below the step of the posts, as steep as
// the land around. After terrain.glsl and warp.glsl.
layout(binding = 8) uniform highp sampler2D detail_texture;  // of blocks: mean xx, yy, xy of slopes

const int first_octave = 1, octave_count = 6;  // noise cells of 1/2 to 1/64 of a post
const float detail_share = 0.35;               // of the mean slope, at the first octave
const float detail_fall = 0.555;               // from octave to octave: 2^-0.85, a rough land's

float hashed(ivec2 p) {
  uint h = uint(p.x) * 0x9e3779b1u ^ uint(p.y) * 0x85ebca77u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return float((h ^ (h >> 15)) >> 8) * (2.0 / 16777216.0) - 1.0;
}

// x: value noise, -1..1; yz: its slope per post.
vec3 noise_octave(vec2 posts, int octave) {
  vec2 whole = floor(posts);
  float cells = float(1 << octave);
  vec2 at = (posts - whole) * cells;
  ivec2 cell = ((window.xy + ivec2(whole)) << octave) + ivec2(floor(at));
  vec2 f = fract(at);
  vec2 s = f * f * (3.0 - 2.0 * f), rate = 6.0 * f * (1.0 - f) * cells;
  float a = hashed(cell), b = hashed(cell + ivec2(1, 0));
  float c = hashed(cell + ivec2(0, 1)), d = hashed(cell + ivec2(1, 1));
  return vec3(a + (b - a) * s.x + (c - a) * s.y + (d - c - b + a) * s.x * s.y,
              rate * vec2(b - a + (d - c - b + a) * s.y, c - a + (d - c - b + a) * s.x));
}

float block_slope(ivec2 block) {
  ivec2 blocks = textureSize(detail_texture, 0);
  block -= blocks * ivec2(floor(vec2(block) / vec2(blocks)));
  vec4 squares = texelFetch(detail_texture, block, 0);
  return sqrt(squares.x + squares.y);
}

// Height of the first octave, m: continuous over the borders of blocks, none on flat land.
float detail_height(vec2 posts) {
  vec2 at = (vec2(level_eye[0].xy) + posts) * (1.0 / 16.0) - 0.5;
  ivec2 block = ivec2(floor(at));
  vec2 f = at - vec2(block);
  float south = mix(block_slope(block), block_slope(block + ivec2(1, 0)), f.x);
  float north = mix(block_slope(block + ivec2(0, 1)), block_slope(block + ivec2(1, 1)), f.x);
  return detail_share * exp2(-float(first_octave)) * mix(south, north, f.y);
}

// How much of an octave a mesh carries whose vertices stand 2^-carried posts apart: all of it where
// four stand in a noise cell, none where two do.
float carried_share(float carried, int octave) {
  return clamp(carried - float(octave) - 1.0, 0.0, 1.0);
}

// The part of the detail that such a mesh carries.
float carried_height(vec2 posts, float carried) {
  float height = detail_height(posts), sum = 0.0;
  for (int k = first_octave; k < first_octave + octave_count; ++k) {
    float share = carried_share(carried, k);
    if (share <= 0.0) break;
    sum += share * height * noise_octave(posts, k).x;
    height *= detail_fall;
  }
  return sum;
}
