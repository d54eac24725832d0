// Grid pass: one invocation marches one vertical plane outwards and finds, for every row of its
// column, how far the wedge round the plane is proven to be empty.
//
// Rays of one plane with rising slopes meet the terrain at rising distances, so each row goes on
// where the row below it ended. A node is passed when its highest post, placed where it would stand
// highest in the picture, stays under the row's ray. Nodes overlap by one cell, so what is proven
// on the plane holds for the whole wedge up to the next planes' middles, and for every slope above
// the row's: a pixel may start its own ray there (docs/error_bound.md, section 3).
layout(local_size_x = 32) in;
layout(binding = slopes_unit) uniform highp sampler2D slopes_texture;
layout(r32f, binding = target_image) writeonly uniform highp image2D nodes_image;

// x sin, y cos of the azimuth, z 1/R; then first and last row.
struct Plane { vec4 direction; ivec4 rows; };
layout(std430, binding = planes_buffer) readonly buffer Planes { Plane plane_list[]; };
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

void store(int row, int plane, float value) {
  imageStore(nodes_image, ivec2(plane, row), vec4(value));
}

float slope_of(int row) {
  return textureLod(slopes_texture, vec2((float(row) + 0.5) * ray_target.w, 0.5), 0.0).r;
}

// As level_of, two posts inside the drawable part: the whole wedge is drawn by that level or a finer
// one, so its nodes bound what the neighbouring rays see as well.
int wedge_level_of(ivec2 low, ivec2 high, int from) {
  int level = from;
  for (; level < level_count - 1; ++level) {
    ivec4 r = level_rect[level];
    int inside = 2 << level;
    if (all(greaterThanEqual(low, r.xy + inside)) && all(lessThanEqual(high, r.zw - inside))) break;
  }
  return level;
}

void main() {
  int plane = int(gl_GlobalInvocationID.x);
  if (plane >= grid.x) return;
  vec4 direction = plane_list[plane].direction;
  int row = plane_list[plane].rows.x;
  int last_row = plane_list[plane].rows.y;
  if (row > last_row) return;

  Track track = track_of(direction.x, direction.y);
  float inverse_radius = direction.z;
  float g_end = tolerance.x;  // the end of the range, or where wedges grow wider than the overlap
  int top_size = int(heights.z);
  Window w = window_here();
  float first_reach = level_reach[0].x;
  float swell = abs(tolerance.y) + abs(tolerance.w);
  // Beyond the end of the sweep the wedge is empty as well for rays that climb away from the sea
  // level circle there and pass over the highest post of the window.
  float far_drop = 0.5 * g_end * g_end * inverse_radius * (1.0 - 1.0e-4);
  float far_high = over_eye(heights.x) + 1.0;
  float far_rise = 1.0 + (far_high + earth.w) * inverse_radius;

  float g = 0.0;
  int size = top_size;
  float slope = slope_of(row);
  int steps = 0;
  while (g < g_end && steps < step_limit) {
    ++steps;
    // Wedges widen: farther out only coarser levels have nodes whose overlap covers them.
    int level = 0;
    while (level < level_count - 1 && g >= level_reach[level].x) ++level;
    float reach = level_count == 1 ? first_reach : level_reach[level].x;
    float u = g * tolerance.z;
    vec2 at = track_posts(track, u);
    vec2 rate = track_rate(track, u);
    ivec2 cell = ivec2(cell_ahead(at, rate));
    level = wedge_level_of(cell, cell + 1, level);
    size = clamp(size, level + 1, level + node_levels);
    ivec2 low = level_low(w, cell, size);
    int holder = wedge_level_of(low, low + (1 << size), level);
    if (size == holder) {  // two borders in one node: only while the window fills
      size -= 1;
      continue;
    }
    float leave = min(exit_distance(w, cell, size, at, pace_of(rate)), heights.w) + (3.0e-5 + 4.0e-7 * g);
    float g1 = g < reach ? min(g + leave, reach) : g + leave;
    float theta2 = g * g * inverse_radius * inverse_radius;
    float drop = 0.5 * g * g * inverse_radius * (1.0 - theta2 * (1.0 / 12.0)) * (1.0 - 3.0e-5);
    float near = g * (1.0 - theta2 * (1.0 / 6.0));
    float k = node_highest(w, cell, size, holder);
    float c = 1.0 + (k + earth.w) * inverse_radius;
    float slack = 1.0e-6 * abs(k) + 1.0e-6 * g1 + 1.0e-5 +
                  swell * u * u * u * 1.2;
    // k + slack over the row's ray: terrain of this node may reach it.
    float over = k + slack - c * (drop + slope * (slope < 0.0 ? g1 : near));
    if (over < 0.0) {
      g = g1;
      size = min(size + 1, top_size);
    } else if (size > level + 1) {
      size -= 1;
    } else {
      while (over >= 0.0) {
        store(row, plane, g);
        ++row;
        if (row > last_row) return;
        slope = slope_of(row);
        over = k + slack - c * (drop + slope * (slope < 0.0 ? g1 : near));
      }
    }
  }
  if (steps >= step_limit) atomicAdd(counters[1], 1u);
  // Past the last node the wedge is empty up to the end of the sweep.
  for (; row <= last_row; ++row) {
    slope = slope_of(row);
    bool climbs = slope + g_end * inverse_radius > 0.0;
    bool over = far_high < far_rise * (far_drop + slope * (slope < 0.0 ? g_end : g_end * (1.0 - 1.0e-4)));
    bool clear = g_end >= ray_origin.w || (climbs && over);
    store(row, plane, clear ? sky : min(g, g_end));
  }
}
