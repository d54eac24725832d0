// Posts, cells, nodes and the ground map: shared by every pass that looks at terrain.

layout(binding = posts_unit) uniform highp sampler2D posts_texture;
layout(binding = highest_unit) uniform highp sampler2D highest_texture;

const float void_threshold = -50000.0;
const float void_offset = 100000.0;
const float sky = 1.0e30;

// Post coordinates of the ground point E, N (both over the display range), relative to the eye's post.
vec2 ground_posts(float e, float n) {
  float e2 = e * e;
  float north = n * (latitude[0].x + n * (latitude[0].y + n * (latitude[0].z +
                n * (latitude[0].w + n * latitude[1].x)))) +
                e2 * (latitude[1].y + n * (latitude[1].z + n * (latitude[1].w +
                n * latitude[2].x)) + e2 * (latitude[2].y + n * latitude[2].z));
  float east = e * (longitude[0].x + n * (longitude[0].y + n * (longitude[0].z +
               n * (longitude[0].w + n * longitude[1].x))) +
               e2 * (longitude[1].y + n * (longitude[1].z + n * longitude[1].w) +
               e2 * longitude[2].x));
  return eye.xy + vec2(east, north);
}

// The ground map along one azimuth: posts(u) = eye.xy + u*(c[0] + u*(c[1] + ...)), u = g/range.
struct Track { vec2 c1, c2, c3, c4, c5; };

Track track_of(float s, float c) {
  float s2 = s * s;
  Track t;
  t.c1 = vec2(longitude[0].x * s, latitude[0].x * c);
  t.c2 = vec2(longitude[0].y * s * c, latitude[0].y * c * c + latitude[1].y * s2);
  t.c3 = vec2(s * (longitude[0].z * c * c + longitude[1].y * s2),
              c * (latitude[0].z * c * c + latitude[1].z * s2));
  t.c4 = vec2(s * c * (longitude[0].w * c * c + longitude[1].z * s2),
              c * c * (latitude[0].w * c * c + latitude[1].w * s2) + latitude[2].y * s2 * s2);
  t.c5 = vec2(s * (c * c * (longitude[1].x * c * c + longitude[1].w * s2) +
                   longitude[2].x * s2 * s2),
              c * (c * c * (latitude[1].x * c * c + latitude[2].x * s2) +
                   latitude[2].z * s2 * s2));
  return t;
}

vec2 track_posts(Track t, float u) {
  return eye.xy + u * (t.c1 + u * (t.c2 + u * (t.c3 + u * (t.c4 + u * t.c5))));
}

// Posts per metre of g.
vec2 track_rate(Track t, float u) {
  return tolerance.z * (t.c1 + u * (2.0 * t.c2 + u * (3.0 * t.c3 + u * (4.0 * t.c4 + u * 5.0 * t.c5))));
}

// Height over the eye. Two parts, because a low eye over high ground needs the last centimetre.
float over_eye(float height) { return (height - eye.z) - eye.w; }

// One cell of the bilinear surface: height over the eye = h00 + dx fx + dy fy + dxy fx fy.
struct Cell {
  float h00, dx, dy, dxy;
  bool unknown;  // then flat: the floor up to which it is drawn as unknown
};

Cell cell_at(ivec2 cell) {
  ivec2 p = clamp(window.xy + cell, ivec2(0), window.zw - 2);
  // One gather for the four posts: the point where they meet is half a texel from any other choice.
  vec4 corners = textureGather(posts_texture, (vec2(p) + 1.0) / vec2(window.zw));
  float a = corners.w, b = corners.z, c = corners.x, d = corners.y;
  Cell r;
  float low = min(min(a, b), min(c, d));
  if (low < void_threshold) {
    float top = -1.0e9;
    if (a < void_threshold) top = max(top, a + void_offset);
    if (b < void_threshold) top = max(top, b + void_offset);
    if (c < void_threshold) top = max(top, c + void_offset);
    if (d < void_threshold) top = max(top, d + void_offset);
    r.h00 = over_eye(top);
    r.dx = 0.0;
    r.dy = 0.0;
    r.dxy = 0.0;
    r.unknown = true;
  } else {
    r.h00 = over_eye(a);
    r.dx = b - a;
    r.dy = c - a;
    r.dxy = (d - c) - (b - a);
    r.unknown = false;
  }
  return r;
}

// South-west texel of a pyramid level in the one texture that holds them all: level 1 stands at the
// left, the others above each other to its right.
ivec2 pyramid_corner(ivec2 posts, int level) {
  return level < 2 ? ivec2(0) : ivec2(posts.x >> 1, (posts.y >> 1) - (posts.y >> (level - 1)));
}

// Highest height over the eye in the node of `level` that holds `cell`, its overlap included.
float node_highest(ivec2 cell, int level) {
  ivec2 node = clamp((window.xy + cell) >> level, ivec2(0), (window.zw >> level) - 1);
  return over_eye(texelFetch(highest_texture, node + pyramid_corner(window.zw, level), 0).r);
}

// The cell a point is in, or about to enter: on an edge (within rounding) the way decides. A point
// that stands on an edge and hardly moves across it would else be stuck there.
vec2 cell_ahead(vec2 at, vec2 rate) {
  return floor(at + sign(rate) * (1.0e-6 + 2.4e-7 * abs(at)));
}

// Loops end themselves before llvmpipe does it for them (after 65535 turns, silently, and whoever
// is still in the loop stores nothing); ten times the steps of the longest ray.
const int step_limit = 30000;

// Distance along the track (in the unit of 1/rate) until the point leaves the node.
float exit_distance(ivec2 cell, int level, vec2 at, vec2 rate) {
  ivec2 absolute = ((window.xy + cell) >> level) << level;
  vec2 low = vec2(absolute - window.xy);
  vec2 edge = low + vec2(greaterThan(rate, vec2(0.0))) * float(1 << level);
  vec2 safe_rate = mix(rate, vec2(1.0e-20), lessThan(abs(rate), vec2(1.0e-20)));
  vec2 steps = (edge - at) / safe_rate;
  steps = mix(steps, vec2(1.0e20), lessThan(abs(rate), vec2(1.0e-20)));
  return max(min(steps.x, steps.y), 0.0);
}
