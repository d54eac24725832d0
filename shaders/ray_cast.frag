// Ray cast pass: the first hit of every pixel's own ray, from where the grid proves it must start.
// Exact up to rounding: an error of the grid can cost time, never a pixel.
layout(binding = nodes_unit) uniform highp sampler2D nodes_texture;
layout(location = 0) out highp uint range_bits;  // the distance as float bits

const float unresolved = 2.0e30;  // such a ray proves nothing: the frame is void

// Ground distance up to which the wedge round this direction is empty at its slope and above.
float proven_empty(vec3 direction) {
  float horizontal = length(direction.xy);
  if (grid.z == 0 || direction.z <= slope.x * horizontal || direction.z >= slope.y * horizontal) {
    return 0.0;
  }
  float turn = 6.28318530718;
  float az = atan(direction.x, direction.y) - azimuth.x;
  az -= turn * floor(az / turn);
  int ka = clamp(int(az * azimuth.z), 0, segment_count - 1);
  float a = planes[ka].x + (az - float(ka) / azimuth.z) * planes[ka].y;
  float rise = direction.z / horizontal - slope.x;
  int kb = clamp(int(rise * slope.z), 0, segment_count - 1);
  float b = rows[kb].x + (rise - float(kb) / slope.z) * rows[kb].y;
  int plane = int(floor(a + 0.5));
  if (azimuth.w > 0.5) plane = plane >= grid.x ? plane - grid.x : plane;
  plane = clamp(plane, 0, grid.x - 1);
  int row = clamp(int(floor(b - 0.01)), 0, grid.y - 1);  // never a row above the pixel
  return texelFetch(nodes_texture, ivec2(plane, row), 0).r;
}

// Distance along the ray at which it has passed the ground distance g.
float distance_at(Ray r, float g) {
  float theta = g * r.inverse_radius;
  float theta2 = theta * theta;
  float s = theta * (1.0 - theta2 * (1.0 / 6.0));
  float c = 1.0 - 0.5 * theta2;
  return r.eye_radius * s / (c * r.along - r.up * s);
}

// Distance of the first known surface or, negative, of the first unknown floor; `sky` if none.
float first_hit(Ray r, float start, int level) {
  Track track = track_of(r.azimuth.x, r.azimuth.y);
  float range = ray_origin.w;
  float ceiling = over_eye(heights.x) + 1.0;
  int top_level = int(heights.z);
  float t = start;
  if (r.up < 0.0) t = max(t, ceiling / r.up);  // over the highest post until here
  ivec2 parent = ivec2(-1000000);
  for (int steps = 0; steps < step_limit; ++steps) {
    if (t > range) return sky;
    RayPoint p = ray_point(r, t);
    if (p.height > ceiling && p.height_rate >= 0.0) return sky;
    float u = p.g * tolerance.z;
    vec2 at = track_posts(track, u);
    vec2 rate = track_rate(track, u) * p.g_rate;
    vec2 whole = cell_ahead(at, rate);
    ivec2 cell = ivec2(whole);
    // Up a level when the step has left the parent node, so that long clear ways take few steps.
    ivec2 up = (window.xy + cell) >> (level + 1);
    if (parent.x > -1000000 && up != parent && level < top_level) level += 1;
    parent = ivec2(-1000000);
    float leave = min(exit_distance(cell, level, at, rate), heights.w) + (3.0e-5 + 4.0e-7 * t);
    if (level > 0) {
      // The height of a ray is convex in t: it stays above its tangent.
      float lowest = p.height + min(p.height_rate, 0.0) * leave;
      float k = node_highest(cell, level);
      if (lowest > k + 1.0e-6 * (abs(k) + abs(p.height)) + 1.0e-5) {
        parent = (window.xy + cell) >> (level + 1);
        t += leave;
      } else {
        level -= 1;
      }
      continue;
    }
    Cell q = cell_at(cell);
    vec3 gap = gap_along(q, at - whole, rate, r, p);
    float hit = 0.0;
    if (gap.x > 0.0) {
      float disc = gap.y * gap.y - 4.0 * gap.z * gap.x;
      float down = -gap.y + sqrt(max(disc, 0.0));
      hit = (disc < 0.0 || down <= 0.0) ? 2.0 * leave : 2.0 * gap.x / down;
    }
    if (hit <= leave) {
      t += hit;
      return t > range ? sky : (q.unknown ? -t : t);
    }
    parent = (window.xy + cell) >> 1;
    t += leave;
  }
  return unresolved;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);  // row 0 of the target is the top of the picture
  vec3 direction = pixel_ray(vec2(pixel));
  float empty = proven_empty(direction);
  float value = sky;
  if (empty < sky) {
    Ray r = make_ray(direction);
    float start = empty > 0.0 ? distance_at(r, empty) * (1.0 - 1.0e-6) - 1.0e-3 : 0.0;
    bool at_hit = empty > 0.0 && empty < tolerance.x;
    value = first_hit(r, max(start, 0.0), at_hit ? 0 : int(heights.z));
  }
  range_bits = floatBitsToUint(value);
}
