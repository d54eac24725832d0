// Posts, cells, nodes and the ground map: shared by every pass that looks at terrain.

layout(binding = posts_unit) uniform highp sampler2DArray posts_texture;
layout(binding = highest_unit) uniform highp sampler2DArray highest_texture;

// Variants of the marches that the benchmark compiles count their steps (sim/methods/step_counter.hpp);
// in what flies these names are nothing. count_steps: first of the program's two counters.
#ifdef count_steps
layout(std430, binding = steps_buffer) buffer Steps { uint steps_taken[]; };
#define count_node atomicAdd(steps_taken[count_steps], 1u);
#define count_cell atomicAdd(steps_taken[count_steps + 1], 1u);
#else
#define count_node
#define count_cell
#endif

const float void_threshold = -50000.0;
const float void_offset = 100000.0;
const float sky = 1.0e30;

// From the eye's east and north to columns and rows, and back.
vec2 turned(vec2 v) { return vec2(turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y); }
vec2 turned_back(vec2 v) { return vec2(turn.x * v.x + turn.y * v.y, turn.x * v.y - turn.y * v.x); }

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
  return eye.xy + turned(vec2(east, north));
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
  t.c1 = turned(t.c1);
  t.c2 = turned(t.c2);
  t.c3 = turned(t.c3);
  t.c4 = turned(t.c4);
  t.c5 = turned(t.c5);
  return t;
}

vec2 track_posts(Track t, float u) {
  return eye.xy + u * (t.c1 + u * (t.c2 + u * (t.c3 + u * (t.c4 + u * t.c5))));
}

// Posts per metre of g.
vec2 track_rate(Track t, float u) {
  return tolerance.z * (t.c1 + u * (2.0 * t.c2 + u * (3.0 * t.c3 + u * (4.0 * t.c4 + u * 5.0 * t.c5))));
}

// Height over the eye. Two parts: a low eye needs the last centimetre.
float over_eye(float height) { return (height - eye.z) - eye.w; }

// The finest level, from `from` on, whose drawable part holds the cells low..high (excluded).
// level_count is a constant of the module's own passes, set when they are compiled.
int level_of(ivec2 low, ivec2 high, int from) {
  int level = from;
  for (; level < level_count - 1; ++level) {
    ivec4 r = level_rect[level];
    if (all(greaterThanEqual(low, r.xy)) && all(lessThanEqual(high, r.zw))) break;
  }
  return level;
}

// What a march asks of the window at every step. Held by the caller: inside a loop a software GPU
// would fetch a uniform anew at every turn.
struct Window {
  ivec2 eye;        // low bits of the eye's post
  ivec2 place;      // where level 0 keeps a post, from those bits on
  ivec2 posts;      // columns and rows of a level
  vec2 node_texel;  // one over the size of the nodes' texture
};

Window window_here() {
  return Window(window.xy, level_eye[0].xy - window.xy, ivec2(level_size.xy), turn.zw);
}

// South-west lattice post of the cell of `level` that holds `cell`, relative to the eye's.
ivec2 level_low(Window w, ivec2 cell, int level) {
  return (((w.eye + cell) >> level) << level) - w.eye;
}

// A place of a level's toroidal memory, which may lie one turn outside.
ivec2 wrapped(ivec2 texel, ivec2 count) {
  texel += ivec2(lessThan(texel, ivec2(0))) * count;
  return texel - ivec2(greaterThanEqual(texel, count)) * count;
}

// Where a level keeps the post with the low bits 0; a multiple of the posts of a block.
ivec2 level_place(Window w, int level) {
  return level_count == 1 ? w.place : level_eye[level].xy - (w.eye >> level);
}

// Where a level keeps the south-west post of that cell; one turn round at most.
ivec2 level_texel(Window w, ivec2 cell, int level) {
  return level_place(w, level) + ((w.eye + cell) >> level);
}

// The four posts round the point where they meet, half a texel from any other choice. x north-west,
// y north-east, z south-east, w south-west. Behind its last column and row the texture has the first
// once more, so that it need not repeat.
vec4 four_posts(Window w, ivec2 texel, int level) {
  vec2 corner = vec2(wrapped(texel, w.posts)) + 1.0;
  return textureGather(posts_texture, vec3(corner * level_size.zw, float(level)));
}

// One cell of the bilinear surface: height over the eye = h00 + dx fx + dy fy + dxy fx fy.
struct Cell {
  float h00, dx, dy, dxy;
  bool unknown;  // then flat: the floor up to which it is drawn as unknown
};

Cell cell_at(Window w, ivec2 cell, int level) {
  vec4 corners = four_posts(w, level_texel(w, cell, level), level);
  bvec4 voids = lessThan(corners, vec4(void_threshold));
  vec4 floors = mix(vec4(-1.0e9), corners, voids);
  float top = max(max(floors.x, floors.y), max(floors.z, floors.w)) + void_offset;
  float a = corners.w, b = corners.z, c = corners.x, d = corners.y;
  Cell r;
  r.unknown = any(voids);
  r.h00 = over_eye(r.unknown ? top : a);
  r.dx = r.unknown ? 0.0 : b - a;
  r.dy = r.unknown ? 0.0 : c - a;
  r.dxy = r.unknown ? 0.0 : (d - c) - (b - a);
  return r;
}

// South-west texel of a pyramid level in the one layer that holds them all: level 1 stands at the
// left, the others above each other to its right.
ivec2 pyramid_corner(ivec2 posts, int level) {
  return level < 2 ? ivec2(0) : ivec2(posts.x >> 1, (posts.y >> 1) - (posts.y >> (level - 1)));
}

// Highest height over the eye in the node of 2^size cells that holds `cell`, by a level of the
// window (0 < size - level <= node_levels); the node's overlap included.
float node_highest(Window w, ivec2 cell, int size, int level) {
  count_node
  int up = size - level;
  ivec2 node = (level_place(w, level) >> up) + ((w.eye + cell) >> size);
  node = wrapped(node, w.posts >> up) + pyramid_corner(w.posts, up);
  vec3 at = vec3((vec2(node) + 0.5) * w.node_texel, float(level));
  return over_eye(textureLod(highest_texture, at, 0.0).r);
}

// The cell a point is in, or about to enter: on an edge (within rounding) the way decides. A point
// that stands on an edge and hardly moves across it would else be stuck there.
vec2 cell_ahead(vec2 at, vec2 rate) {
  return floor(at + sign(rate) * (1.0e-6 + 2.4e-7 * abs(at)));
}

// Loops end themselves before llvmpipe does it for them (after 65535 turns, silently, and whoever
// is still in the loop stores nothing); ten times the steps of the longest ray.
const int step_limit = 30000;

// Distance a post of way across takes, in the unit of 1/rate. Who hardly moves takes 1e20, never less
// than nothing.
vec2 pace_of(vec2 rate) {
  const vec2 least = vec2(1.0e-20);
  return 1.0 / mix(max(rate, least), min(rate, -least), lessThan(rate, vec2(0.0)));
}

// Distance along the track until the point leaves the node.
float exit_distance(Window w, ivec2 cell, int level, vec2 at, vec2 pace) {
  vec2 low = vec2(level_low(w, cell, level));
  vec2 edge = low + vec2(greaterThan(pace, vec2(0.0))) * float(1 << level);
  vec2 ways = (edge - at) * pace;
  return max(min(ways.x, ways.y), 0.0);
}
