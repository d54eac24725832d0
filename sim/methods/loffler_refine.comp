// Refines the warped coarse grid into the full grid: ground point, height and error of one vertex.
// Heights come from the relief pyramid at the level that fits the distance to the farther neighbour.
layout(local_size_x = 64) in;
layout(binding = 2) uniform highp sampler2D relief_texture;  // average, lowest, highest, known
// Two a vertex: clip coordinates; then post coordinates, the normalised error, and 1 where unknown.
layout(std430, binding = planes_buffer) writeonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Coarse { vec2 coarse[]; };

const int coarse_cells = 32;  // a side; CoarseGrid::cells

vec2 view_point(ivec2 vertex) {
  vec2 at = vec2(vertex) * (float(coarse_cells) / vec2(grid_size.xy - 1));
  ivec2 cell = min(ivec2(at), ivec2(coarse_cells - 1));
  vec2 f = at - vec2(cell);
  int sw = cell.y * (coarse_cells + 1) + cell.x, nw = sw + coarse_cells + 1;
  return mix(mix(coarse[sw], coarse[sw + 1], f.x), mix(coarse[nw], coarse[nw + 1], f.x), f.y);
}

// Where the vertex's view ray meets the base plane, E and N in m; as Projector::ground_m.
vec2 ground_point(ivec2 vertex) {
  vec2 view = view_point(vertex);
  vec3 ray = view_ahead.xyz + view.x * view_right.xyz + view.y * view_upward.xyz;
  float across = length(ray.xy), range = ray_origin.w;
  float scale = -ray.z * range > view_right.w * across ? view_right.w / -ray.z
                                                       : range / max(across, 1.0e-9);
  return scale * ray.xy;
}

// Posts to the farther of the two neighbours.
float spacing_posts(ivec2 vertex, vec2 ground) {
  ivec2 side = mix(ivec2(-1), ivec2(1), lessThan(vertex + 1, grid_size.xy));
  vec2 posts_per_m = vec2(longitude[0].x, latitude[0].x) * tolerance.z;
  vec2 across = ground_point(vertex + ivec2(side.x, 0)) - ground;
  vec2 along = ground_point(vertex + ivec2(0, side.y)) - ground;
  return max(length(across * posts_per_m), length(along * posts_per_m));
}

vec4 relief_texel(ivec2 texel, int level) {
  ivec2 last = max(relief_place.zw >> level, ivec2(1)) - 1;
  return texelFetch(relief_texture, clamp(texel, ivec2(0), last), level - 1);
}

// x: average, filtered between four texels; y: highest and z: delta, of the one aligned texel (L3);
// w: 1 where a texel has no known post, so that its floor is in the average. Heights over the eye.
vec4 relief_height(vec2 posts, int level) {
  vec2 from = posts - vec2(relief_place.xy);
  vec2 at = (from + 0.5) / float(1 << level) - 0.5;
  ivec2 low = ivec2(floor(at));
  vec2 f = at - vec2(low);
  vec4 sw = relief_texel(low, level), se = relief_texel(low + ivec2(1, 0), level);
  vec4 nw = relief_texel(low + ivec2(0, 1), level), ne = relief_texel(low + 1, level);
  float average = mix(mix(sw.x, se.x, f.x), mix(nw.x, ne.x, f.x), f.y);
  float unknown = min(min(sw.w, se.w), min(nw.w, ne.w)) > 0.0 ? 0.0 : 1.0;
  vec4 block = relief_texel(ivec2(floor(from + 0.5)) >> level, level);
  float delta = max(block.z - average, average - block.y);
  return vec4(over_eye(average), over_eye(block.z), delta, unknown);
}

vec4 height_at(vec2 posts, float spacing) {
  ivec2 cell = ivec2(floor(posts));
  ivec4 finest = level_rect[0];
  bool held = all(greaterThanEqual(cell, finest.xy)) && all(lessThan(cell, finest.zw));
  int level = int(floor(log2(max(spacing, 1.0)) + 0.5));  // rounded, not up (L3)
  level = min(level, grid_size.z);
  if (!held || level < 1) {
    vec2 height = bilinear_height(posts);
    return vec4(height.x, height.x, 0.0, height.y);
  }
  return relief_height(posts, level);
}

vec3 position_of(vec2 ground, float height) {
  return options.x == 1 ? vec3(ground, height) : ground_position(ground, height);
}

void main() {
  int index = int(gl_GlobalInvocationID.x);
  if (index >= grid_size.x * grid_size.y) return;
  ivec2 vertex = ivec2(index % grid_size.x, index / grid_size.x);
  vec2 ground = ground_point(vertex);
  vec2 posts = held_posts(posts_of_ground(ground));
  vec4 height = height_at(posts, spacing_posts(vertex, ground));
  vec3 position = position_of(ground, height.x);
  float rho = view_ahead.w * height.z / length(position);  // lambda is a mean (L5)
  float error = rho > view_upward.w ? 1.0 - view_upward.w / rho : 0.0;
  // The vertex moves by up to delta and keeps its delta (L4).
  if (error > 0.0 && grid_size.w == 1) position = position_of(ground, height.y);
  vertices[2 * index] = clip_of(position);
  vertices[2 * index + 1] = vec4(posts, error, height.w);
}
