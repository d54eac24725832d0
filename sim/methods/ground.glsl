// Ground points for methods that draw geometry: from posts to the plane of the eye and back, heights
// with the unknown, positions on the curved Earth, and the projection. After terrain.glsl.
//
// E, N: the frame's ground map (core/geo/ground_map.hpp), m from the foot of the eye. Heights are over
// the eye. Positions are m from the eye: x east, y north, z up.

// Post coordinates (relative to the eye's post) of a ground point.
vec2 posts_of_ground(vec2 en) { return ground_posts(en.x * tolerance.z, en.y * tolerance.z); }

// The ground point of post coordinates: the inverse, by three turns of Gauss and Seidel. Each divides
// the error by more than 5000 (range over Earth radius times tan latitude, squared) at latitude 45.
vec2 ground_of_posts(vec2 posts) {
  vec2 way = turned_back(posts - eye.xy);
  float n = way.y / latitude[0].x;
  float e = way.x / (longitude[0].x + n * longitude[0].y);
  for (int turn = 0; turn < 3; ++turn) {
    float e2 = e * e;
    float north = n * (latitude[0].x + n * (latitude[0].y + n * (latitude[0].z +
                  n * (latitude[0].w + n * latitude[1].x)))) +
                  e2 * (latitude[1].y + n * (latitude[1].z + n * (latitude[1].w +
                  n * latitude[2].x)) + e2 * (latitude[2].y + n * latitude[2].z));
    n -= (north - way.y) / (latitude[0].x + 2.0 * n * latitude[0].y);
    float per_e = longitude[0].x + n * (longitude[0].y + n * (longitude[0].z +
                  n * (longitude[0].w + n * longitude[1].x)));
    float east = e * (per_e + e2 * (longitude[1].y + n * (longitude[1].z + n * longitude[1].w) +
                 e2 * longitude[2].x));
    e -= (east - way.x) / per_e;
  }
  return vec2(e, n) * ray_origin.w;
}

// A post's place in the texture of its level; posts relative to the eye's, in lattice posts.
ivec2 post_texel(ivec2 post, int level) {
  ivec2 size = ivec2(level_size.xy);
  ivec2 texel = level_texel(window_here(), post, level);
  texel += ivec2(lessThan(texel, ivec2(0))) * size;
  return texel - ivec2(greaterThanEqual(texel, size)) * size;
}

// x: height over the eye; y: 1 where the post is unknown, then x is the floor it is drawn at.
vec2 stored_height(float stored) {
  bool unknown = stored < void_threshold;
  return vec2(over_eye(unknown ? stored + void_offset : stored), unknown ? 1.0 : 0.0);
}

vec2 post_height(ivec2 post, int level) {
  return stored_height(texelFetch(posts_texture, ivec3(post_texel(post, level), level), 0).r);
}

// Post coordinates moved into what the window holds; nothing outside it is within the range.
vec2 held_posts(vec2 posts) {
  ivec4 r = level_rect[window.z - 1];
  return clamp(posts, vec2(r.xy), vec2(r.zw) - 1.0);
}

// Height of the surface at any post coordinates, bilinear in the finest level that holds the cell.
// x: over the eye; y: 1 where unknown.
vec2 bilinear_height(vec2 posts) {
  vec2 at = held_posts(posts);
  ivec2 cell = ivec2(floor(at));
  int level = level_of(cell, cell + 1, 0);
  Window w = window_here();
  Cell c = cell_at(w, cell, level);
  vec2 f = (at - vec2(level_low(w, cell, level))) / float(1 << level);
  float height = c.h00 + c.dx * f.x + c.dy * f.y + c.dxy * f.x * f.y;
  return vec2(height, c.unknown ? 1.0 : 0.0);
}

// The same of the nearest post.
vec2 nearest_height(vec2 posts) {
  ivec2 cell = ivec2(floor(held_posts(posts)));
  int level = level_of(cell, cell + 1, 0);
  float step = float(1 << level);
  vec2 low = vec2(level_low(window_here(), cell, level));
  return post_height(ivec2(low + step * floor((held_posts(posts) - low) / step + 0.5)), level);
}

// Position of the point `height` over the ground point (E, N); height over the eye.
vec3 ground_position(vec2 en, float height) {
  float g2 = dot(en, en);
  vec2 z = en * tolerance.z;
  float swell = z.y * (tolerance.y * z.y * z.y + tolerance.w * z.x * z.x);
  float inverse_radius = g2 > 0.0 ? (earth.x * en.y * en.y + earth.y * en.x * en.x) / g2 : earth.x;
  float up = height + swell;                   // over the osculating circle through the eye's height
  float radius = 1.0 / inverse_radius + earth.w + up;
  float a2 = g2 * inverse_radius * inverse_radius;  // squared angle at the centre of the Earth
  float along = radius * inverse_radius * (1.0 - a2 * (1.0 / 6.0 - a2 * (1.0 / 120.0)));
  float drop = radius * a2 * (0.5 - a2 * (1.0 / 24.0 - a2 * (1.0 / 720.0)));
  return vec3(en * along, up - drop);
}

const float near_m = 0.1;  // nothing nearer is drawn

// Clip coordinates of a position; row 0 of the target is the top of the picture. w is the depth along
// the camera's axis. z only cuts what is nearer than near_m: depth is the fragment's business, see
// raster.glsl.
vec4 clip_of(vec3 p) {
  vec3 ahead = normalize(cross(ray_dx.xyz, ray_dy.xyz));
  float w = dot(p, ahead);
  vec3 aside = p - w * ray_origin.xyz;
  float u = dot(aside, ray_dx.xyz) / dot(ray_dx.xyz, ray_dx.xyz);
  float v = dot(aside, ray_dy.xyz) / dot(ray_dy.xyz, ray_dy.xyz);
  return vec4(2.0 * (u + 0.5 * w) / ray_dx.w - w, 2.0 * (v + 0.5 * w) / ray_dy.w - w,
              w - 2.0 * near_m, w);
}
