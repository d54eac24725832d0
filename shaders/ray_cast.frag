// Ray cast pass: the first hit of every ray, one a block of pixels, from where the grid proves it
// must start. Exact up to rounding: an error of the grid can cost time, never a pixel.
layout(binding = nodes_unit) uniform highp sampler2D nodes_texture;
layout(location = 0) out highp uint range_bits;  // the distance as float bits

// Whether the frame may have ground round a low eye. Without it no pass through its loop is made: a
// software GPU goes through every loop once.
#ifndef near_ground
#define near_ground 1
#endif

const float proven_sky = 1.5e30;  // no ray was cast: the grid proves the wedge empty
const int near_step_limit = 1000;
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
  return textureLod(nodes_texture, (vec2(plane, row) + 0.5) * ray_target.zw, 0.0).r;
}

// Distance along the ray at which it has passed the ground distance g.
float distance_at(Ray r, float g) {
  float theta = g * r.inverse_radius;
  float theta2 = theta * theta;
  float s = theta * (1.0 - theta2 * (1.0 / 6.0));
  float c = 1.0 - 0.5 * theta2;
  return r.eye_radius * s / (c * r.along - r.up * s);
}

// A ray as polynomials in s = distance / range: one step costs a dozen products, no division.
// posts = eye + s p1 + ... + s^5 p5; height over the eye = s h.x + ... + s^4 h.w.
struct Course { vec2 p1, p2, p3, p4, p5; vec4 h; };

// With tau = t / eye_radius and a, u the ray's horizontal and upward part (a a + u u = 1):
//   g / R           = a (tau - u tau^2 + (4uu - 1)/3 tau^3 - (2uu - 1) u tau^4 ...)
//   height / radius = u tau + a a/2 tau^2 - u a a/2 tau^3 + (5uu - 1) a a/8 tau^4 ...
// composed with the ground map; docs/error_bound.md, section 4, bounds what is left out.
Course course_of(Ray r) {
  Track c = track_of(r.azimuth.x, r.azimuth.y);
  float e = 1.0 / (tolerance.z * r.eye_radius);  // range / eye radius
  float a = r.along, u = r.up, uu = u * u, aa = a * a;
  float k = a * tolerance.z / r.inverse_radius;  // g in ranges per tau
  float k1 = k * e;
  float k2 = -k * u * e * e;
  float k3 = k * (4.0 * uu - 1.0) * (1.0 / 3.0) * e * e * e;
  float k4 = -k * (2.0 * uu - 1.0) * u * e * e * e * e;
  Course q;
  q.p1 = c.c1 * k1;
  q.p2 = c.c1 * k2 + c.c2 * (k1 * k1);
  q.p3 = c.c1 * k3 + c.c2 * (2.0 * k1 * k2) + c.c3 * (k1 * k1 * k1);
  q.p4 = c.c1 * k4 + c.c2 * (k2 * k2 + 2.0 * k1 * k3) + c.c3 * (3.0 * k1 * k1 * k2) +
         c.c4 * (k1 * k1 * k1 * k1);
  q.p5 = c.c2 * (2.0 * (k1 * k4 + k2 * k3)) + c.c3 * (3.0 * k1 * (k1 * k3 + k2 * k2)) +
         c.c4 * (4.0 * k1 * k1 * k1 * k2) + c.c5 * (k1 * k1 * k1 * k1 * k1);
  float length_scale = r.eye_radius * e;  // the range
  q.h = length_scale * vec4(u, 0.5 * aa * e, -0.5 * u * aa * e * e,
                            0.125 * (5.0 * uu - 1.0) * aa * e * e * e);
  // The ellipsoid swells away from its circle, so the ray is that much lower over it.
  vec2 z = r.azimuth;
  q.h.z -= a * aa * z.y * (tolerance.y * z.y * z.y + tolerance.w * z.x * z.x);
  return q;
}

// The first zero of x + y t + z t t for t > 0, where x > 0; `sky` if there is none. Of the two ways
// to write the root, the one whose sum does not cancel.
float first_zero(vec3 gap) {
  float disc = gap.y * gap.y - 4.0 * gap.z * gap.x;
  float root = sqrt(max(disc, 0.0));
  bool climbs = gap.y > 0.0;
  float down = root - gap.y;
  bool none = climbs ? gap.z >= 0.0 : disc < 0.0 || down <= 0.0;
  float zero = (climbs ? gap.y + root : 2.0 * gap.x) / (climbs ? -2.0 * gap.z : down);
  return none ? sky : zero;
}

// The same from a point that may stand below the surface already: there it hits at once.
float meeting(vec3 gap) { return gap.x > 0.0 ? first_zero(gap) : 0.0; }

// What a ray shows that hits at t: negative where it hits a floor of unknown ground. Never -0, which
// is no sign at all: the eye may stand inside such a floor.
float shown(float t, bool unknown) {
  return t > ray_origin.w ? sky : (unknown ? -max(t, 1.0e-3) : t);
}

// The nine cells round a low eye, in posts from the eye: here a rounded height would count
// (docs/error_bound.md, section 4). What the ray shows, or `sky` where it leaves them, at t.
float near_hit(Course q, float bend, float ceiling, inout float t) {
  for (int steps = 0; steps < near_step_limit; ++steps) {
    float s = t * tolerance.z;
    float height = s * (q.h.x + s * (q.h.y + s * (q.h.z + s * q.h.w)));
    float climb = tolerance.z * (q.h.x + s * (2.0 * q.h.y + s * (3.0 * q.h.z)));
    if (t > ray_origin.w || (height > ceiling && climb >= 0.0)) return sky;
    vec2 off = s * (q.p1 + s * (q.p2 + s * (q.p3 + s * (q.p4 + s * q.p5))));
    vec2 rate = tolerance.z * (q.p1 + s * (2.0 * q.p2 + s * (3.0 * q.p3 + s * (4.0 * q.p4))));
    vec2 ahead = off + sign(rate) * (5.0e-7 * abs(off) + 1.0e-12);  // from an edge, too
    vec2 low = near_edges.xz, high = near_edges.yw;
    if (any(lessThan(ahead, low - 1.0)) || any(greaterThanEqual(ahead, high + 1.0))) return sky;
    ivec2 cell = ivec2(greaterThanEqual(ahead, high)) - ivec2(lessThan(ahead, low));
    vec2 after = mix(high + vec2(max(cell, 0)), low, lessThan(cell, ivec2(0)));
    vec2 before = mix(low + vec2(min(cell, 0)), high, greaterThan(cell, ivec2(0)));
    vec2 edge = mix(before, after, greaterThan(rate, vec2(0.0)));
    vec2 moving = step(vec2(1.0e-20), abs(rate));
    vec2 ways = mix(vec2(1.0e20), (edge - off) / mix(vec2(1.0), rate, moving), moving);
    float exit = max(min(ways.x, ways.y), 0.0);
    int k = 4 + cell.x + 3 * cell.y;
    Cell c = Cell(near_cells[k].x, near_cells[k].y, near_cells[k].z, near_cells[k].w,
                  (near.y >> k & 1) == 1);
    vec3 gap = gap_along(c, off, rate, height, climb, bend);
    float straight = 0.5 * heights.y + sqrt(heights.y * t);
    float hit = meeting(gap);
    if (hit <= min(exit, straight)) return shown(t + hit, c.unknown);
    t += straight < exit ? straight : exit + 1.0e-6 + 1.0e-6 * t;
  }
  return unresolved;
}

// Distance of the first known surface or, negative, of the first unknown floor; `sky` if none.
// `size`: nodes of 2^size cells are looked at first.
float first_hit(Ray r, float start, int size) {
  Course q = course_of(r);
  float range = ray_origin.w;
  float ceiling = over_eye(heights.x) + 1.0;
  float bend = 0.5 * r.along * r.along * r.inverse_radius;
  float t = start;
  if (r.up < 0.0) t = max(t, ceiling / r.up);  // over the highest post until here
#if near_ground == 1
  if (near.x != 0) {
    float value = near_hit(q, bend, ceiling, t);
    if (value != sky) return value;
  }
#endif
  Window w = window_here();
  for (int steps = 0; steps < step_limit; ++steps) {
    float s = t * tolerance.z;
    float height = s * (q.h.x + s * (q.h.y + s * (q.h.z + s * q.h.w)));
    float climb = tolerance.z * (q.h.x + s * (2.0 * q.h.y + s * (3.0 * q.h.z)));
    if (t > range || (height > ceiling && climb >= 0.0)) return sky;
    vec2 at = eye.xy + s * (q.p1 + s * (q.p2 + s * (q.p3 + s * (q.p4 + s * q.p5))));
    vec2 rate = tolerance.z * (q.p1 + s * (2.0 * q.p2 + s * (3.0 * q.p3 + s * (4.0 * q.p4))));
    vec2 pace = pace_of(rate);
    ivec2 cell = ivec2(cell_ahead(at, rate));
    int level = level_of(cell, cell + 1, 0);
    size = clamp(size, level + 1, level + node_levels);
    float nudge = 3.0e-5 + 4.0e-7 * t;  // past the edge, so that the next step is over it

    // Over the node: the height of a ray is convex in t and stays above its tangent.
    ivec2 low = level_low(w, cell, size);
    int holder = level_of(low, low + (1 << size), level);
    float leave_node = min(exit_distance(w, cell, size, at, pace), heights.w) + nudge;
    float lowest = height + min(climb, 0.0) * leave_node;
    float k = node_highest(w, cell, size, holder);
    bool whole_node = level_count == 1 || size > holder;  // else two borders in one, while it fills
    bool clear = whole_node && lowest > k + 1.0e-6 * (abs(k) + abs(height)) + 1.0e-5;

    // Else through the cell, to which it costs nothing to look at once.
    Cell c = cell_at(w, cell, level);
    float unit = 1.0 / float(1 << level);
    vec2 inside = (at - vec2(level_low(w, cell, level))) * unit;
    vec3 gap = gap_along(c, inside, rate * unit, height, climb, bend);
    float exit = min(exit_distance(w, cell, level, at, pace), heights.w);
    // The track counts as straight only as far as it bends by less than 1e-6 of the distance.
    float straight = 0.5 * heights.y + sqrt(heights.y * t);
    float stretch = min(exit, straight);
    float hit = meeting(gap);
    if (!clear && hit <= stretch) {  // a hit within the nudge is met where the next cell begins
      t += hit;
      return shown(t, c.unknown);
    }
    t += clear ? leave_node : straight < exit ? straight : exit + nudge;
    size += clear ? 1 : -1;
  }
  return unresolved;
}

void main() {
  vec3 direction = pixel_ray(ray_pixel(ivec2(gl_FragCoord.xy)));
  float empty = proven_empty(direction);
  float value = proven_sky;
  if (empty < sky) {
    Ray r = make_ray(direction);
    float start = empty > 0.0 ? distance_at(r, empty) * (1.0 - 1.0e-6) - 1.0e-3 : 0.0;
    bool at_hit = empty > 0.0 && empty < tolerance.x;
    value = first_hit(r, max(start, 0.0), at_hit ? 0 : int(heights.z));
  }
  range_bits = floatBitsToUint(value);
}
