// Importance map: for every texel of the square, how many vertices a unit of length the surface in it
// deserves along u and along v.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 6) uniform highp sampler2D heights_texture;  // of blocks: lowest, highest, mean slope
layout(binding = 7) uniform highp sampler2D slopes_texture;   // mean xx, yy, xy of slopes; their spread
layout(rgba32f, binding = 0) writeonly uniform highp image2D importance_image;

const float block_side = 16.0;    // posts, as in warp_bounds.hpp
const float unseen_share = 0.02;  // of the vertices of a line: for what nobody sees

struct Surface {
  float low, high;     // over the eye
  vec2 slope;          // mean, m/m eastwards and northwards
  vec3 squares;        // mean of their squares and product
  float spread;        // no slope is farther from the mean
};

// Where only coarser levels are: moderately steep land.
Surface coarse_surface(vec2 posts) {
  float height = bilinear_height(posts).x;
  return Surface(height - 300.0, height + 300.0, vec2(0.0), vec3(0.03, 0.03, 0.0), 1.0);
}

Surface surface_at(vec2 posts) {
  ivec2 cell = ivec2(floor(held_posts(posts)));
  if (level_of(cell, cell + 1, 0) > 0) return coarse_surface(posts);
  ivec2 blocks = textureSize(heights_texture, 0);
  vec2 texel = vec2(level_texel(window_here(), cell, 0)) / block_side;
  ivec2 block = ivec2(floor(texel));
  block -= blocks * ivec2(floor(vec2(block) / vec2(blocks)));
  vec4 heights = texelFetch(heights_texture, block, 0);
  vec4 slopes = texelFetch(slopes_texture, block, 0);
  vec2 per_m = vec2(longitude[0].x, latitude[0].x) * tolerance.z;  // posts a metre
  float c = turn.x, s = turn.y;
  Surface r;
  r.low = over_eye(heights.x);
  r.high = over_eye(heights.y);
  r.slope = turned_back(heights.zw) * per_m;
  r.squares = vec3(c * c * slopes.x + 2.0 * c * s * slopes.z + s * s * slopes.y,
                   c * c * slopes.y - 2.0 * c * s * slopes.z + s * s * slopes.x,
                   (c * c - s * s) * slopes.z + c * s * (slopes.y - slopes.x)) *
              vec3(per_m.x * per_m.x, per_m.y * per_m.y, per_m.x * per_m.y);
  r.spread = slopes.w * max(per_m.x, per_m.y);
  return r;
}

// Whether a ball reaches into the pyramid of sight.
bool in_sight(vec3 centre, float radius) {
  vec3 corner = ray_origin.xyz - 0.5 * (ray_dx.xyz + ray_dy.xyz);
  vec3 right = ray_dx.w * ray_dx.xyz, down = ray_dy.w * ray_dy.xyz;
  vec3 ahead = cross(ray_dx.xyz, ray_dy.xyz);
  bool seen = dot(centre, normalize(ahead)) > -radius;
  seen = seen && dot(centre, normalize(cross(ray_dy.xyz, corner))) > -radius;
  seen = seen && dot(centre, normalize(cross(corner + right, ray_dy.xyz))) > -radius;
  seen = seen && dot(centre, normalize(cross(corner, ray_dx.xyz))) > -radius;
  return seen && dot(centre, normalize(cross(ray_dx.xyz, corner + down))) > -radius;
}

// Whether some slope within the spread of the mean one may face the eye. `sight`: from the eye.
bool may_face(Surface s, vec3 sight) {
  return dot(s.slope, sight.xy) - sight.z + s.spread * length(sight.xy) > 0.0;
}

// Root mean square of the part across the sight of a step over the ground that is 1 m along `way` and
// rises with the slope; of all of the step where every direction may be the sight.
float across_of(Surface s, vec2 way, vec3 sight, bool near) {
  float slope = dot(s.slope, way);
  float square = way.x * way.x * s.squares.x + way.y * way.y * s.squares.y +
                 2.0 * way.x * way.y * s.squares.z;
  if (near) return sqrt(1.0 + square);
  float ahead = dot(sight.xy, way);
  return sqrt(max(1.0 + square - ahead * ahead - 2.0 * ahead * sight.z * slope -
                  sight.z * sight.z * square, 0.0));
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, warp_sizes.xx))) return;
  float range = ray_origin.w;
  float side = 2.0 * range / float(warp_sizes.x);  // m
  vec2 en = from_square((vec2(texel) + 0.5) * side - range);
  float unseen = unseen_share * float(warp_sizes.y);
  vec2 asked = vec2(unseen);
  float inside = min(1.0, 1.05 * range / max(length(en), 1.0));
  vec2 posts = posts_of_ground(en * inside);
  Surface s = surface_at(posts);
  vec3 centre = ground_position(en * inside, 0.5 * (s.low + s.high));
  float radius = length(vec3(0.5 * side, 0.5 * side, 0.5 * (s.high - s.low)));
  float distance = length(centre);
  vec3 sight = centre / max(distance, 1.0);
  bool near = distance < radius + side;  // every direction is in such a ball
  // One texel wider than the ball: the warp blends neighbouring rows.
  bool seen = length(en) < range + 2.0 * side && in_sight(centre, radius + side);
  if (seen && (near || may_face(s, sight))) {
    vec2 along_u = from_square(vec2(1.0, 0.0)), along_v = warp_ahead;
    vec2 across = vec2(across_of(s, along_u, sight, near), across_of(s, along_v, sight, near));
    float px_per_m = 1.0 / (length(ray_dx.xyz) * max(distance - radius, 0.5 * side));
    vec2 density = px_per_m * across / warp_asks.x;  // vertices a metre
    vec2 per_m = vec2(longitude[0].x, latitude[0].x) * tolerance.z;
    density = min(density, warp_asks.y * vec2(length(along_u * per_m), length(along_v * per_m)));
    asked = max(asked, density * 2.0 * range);
  }
  imageStore(importance_image, texel, vec4(asked, seen ? 1.0 : 0.0, 0.0));
}
