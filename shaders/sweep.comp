// Grid pass: one invocation marches one vertical plane outwards and answers all rows of its column.
//
// Rays of one plane with rising slopes meet the terrain at rising distances, so each row starts
// where the row below it ended. A node is skipped when its highest post, placed at its near edge
// for rays above the horizontal and at its far edge for rays below, stays under the row's ray.
layout(local_size_x = 32) in;
layout(r32f, binding = target_image) writeonly uniform highp image2D nodes_image;

// One vertical plane: x sin, y cos of the azimuth, z 1/R; then first row, last row.
struct Plane { vec4 direction; ivec4 rows; };
layout(std430, binding = planes_buffer) readonly buffer Planes { Plane plane_list[]; };
layout(std430, binding = slopes_buffer) readonly buffer Slopes { vec2 slope_list[]; };  // slope, 1/cos
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

const int step_limit = 200000;

void store(int row, int plane, float value) {
  imageStore(nodes_image, ivec2(plane, row), vec4(value));
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
  float half_inverse = 0.5 * inverse_radius;
  float range = ray_origin.w;
  float g_end = range * 1.003;
  float eye_height = earth.w;
  int top_level = int(heights.z);

  float g = 0.0;
  int level = top_level;
  vec2 slope = slope_list[row];
  int steps = 0;
  while (g < g_end && steps < step_limit) {
    ++steps;
    float u = g * tolerance.z;
    vec2 at = track_posts(track, u);
    vec2 rate = track_rate(track, u);
    ivec2 cell = ivec2(floor(at));
    float leave = exit_distance(cell, level, at, rate);
    float nudge = 3.0e-5 + 4.0e-7 * g;
    leave = min(leave, heights.w) + nudge;
    float g1 = g + leave;
    float theta2 = g * g * inverse_radius * inverse_radius;
    float drop = g * g * half_inverse * (1.0 - theta2 * (1.0 / 12.0));
    if (level > 0) {
      float k = node_highest(cell, level);
      float c = 1.0 + (k + eye_height) * inverse_radius;
      float reach = slope.x < 0.0 ? g1 : g * (1.0 - theta2 * (1.0 / 6.0));
      float under = c * (drop * (1.0 - 1.0e-5) + slope.x * reach);
      float slack = 1.0e-6 * (abs(k) + abs(slope.x) * g1) + 1.0e-6;
      if (k - under < -slack) {
        g = g1;
        level = min(level + 1, top_level);
      } else {
        level -= 1;
      }
      continue;
    }

    // One cell, exactly: profile and ray as quadratics in the distance t from here.
    Cell q = cell_at(cell);
    vec2 f = at - vec2(cell);
    float h0 = q.h00 + q.dx * f.x + q.dy * f.y + q.dxy * f.x * f.y;
    float h1 = q.dx * rate.x + q.dy * rate.y + q.dxy * (f.x * rate.y + f.y * rate.x);
    float h2 = q.dxy * rate.x * rate.y;
    float c = 1.0 + (h0 + eye_height) * inverse_radius;
    float y0 = h0 - c * drop;
    float y1 = h1 - c * g * inverse_radius - h1 * inverse_radius * drop;
    float y2 = h2 - c * half_inverse;
    float x0 = c * g * (1.0 - theta2 * (1.0 / 6.0));
    float x1 = c * (1.0 - 0.5 * theta2) + h1 * inverse_radius * g;
    float x2 = (h1 + h2 * g) * inverse_radius;
    bool open = true;
    while (open) {
      float qa = y2 - slope.x * x2;
      float qb = y1 - slope.x * x1;
      float qc = y0 - slope.x * x0;
      float t = 0.0;
      if (qc < 0.0) {
        float disc = qb * qb - 4.0 * qa * qc;
        float down = qb + sqrt(max(disc, 0.0));
        t = (disc < 0.0 || down <= 0.0) ? 2.0 * leave : -2.0 * qc / down;
      }
      if (t <= leave) {
        float r = (x0 + t * (x1 + t * x2)) * slope.y;
        store(row, plane, r > range ? sky : (q.unknown ? -r : r));
        ++row;
        if (row > last_row) return;
        slope = slope_list[row];
      } else {
        open = false;
      }
    }
    g = g1;
    level = 1;
  }
  if (steps >= step_limit) atomicAdd(counters[1], 1u);
  for (; row <= last_row; ++row) store(row, plane, sky);
}
