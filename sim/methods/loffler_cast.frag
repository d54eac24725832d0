// Adaptive ray casting: the pixels whose error is above the threshold, and no others. Where the grid
// drew nothing there is no error, so nothing is cast (L1).
//
// The paper leaves the caster open (L8). This one goes down the window's own pyramid of maxima and
// meets the bilinear cells of the posts, so from the eye it is exact up to rounding. From the grid's
// surface it is as good as that surface is a shell: where true terrain stands before the surface, the
// ray begins behind it.
layout(binding = nodes_unit) uniform highp usampler2D surface_texture;
layout(location = 0) out highp uint range_bits;

const float unresolved = 2.0e30;  // as in ray_cast.frag

// First zero of x + y t + z t t for t > 0, where x > 0; `sky` if there is none. Without cancellation.
float first_zero(vec3 gap) {
  float disc = gap.y * gap.y - 4.0 * gap.z * gap.x;
  float root = sqrt(max(disc, 0.0));
  if (gap.y > 0.0) return gap.z < 0.0 ? (gap.y + root) / (-2.0 * gap.z) : sky;
  float down = root - gap.y;
  return disc < 0.0 || down <= 0.0 ? sky : 2.0 * gap.x / down;
}

float cast_ray(Ray r, float start) {
  Track track = track_of(r.azimuth.x, r.azimuth.y);
  vec2 z = r.azimuth;
  float swell = z.y * (tolerance.y * z.y * z.y + tolerance.w * z.x * z.x);
  float bend = 0.5 * r.along * r.along * r.inverse_radius;
  float ceiling = over_eye(heights.x) + 1.0;
  int largest = int(heights.z), size = 3;
  float t = r.up < 0.0 ? max(start, ceiling / r.up) : start;
  Window w = window_here();
  for (int steps = 0; steps < step_limit; ++steps) {
    if (t > ray_origin.w) return sky;
    RayPoint p = ray_point(r, t);
    float u = p.g * tolerance.z;
    float height = p.height - swell * u * u * u;
    if (height > ceiling && p.height_rate >= 0.0) return sky;
    vec2 at = track_posts(track, u);
    vec2 rate = track_rate(track, u) * p.g_rate;
    ivec2 cell = ivec2(cell_ahead(at, rate));
    int level = level_of(cell, cell + 1, 0);
    size = clamp(size, level, level + node_levels);
    float exit = min(exit_distance(w, cell, size, at, pace_of(rate)), heights.w);
    float leave = exit + 3.0e-5 + 4.0e-7 * t;
    if (size > level) {
      ivec2 low = level_low(w, cell, size);
      int holder = level_of(low, low + (1 << size), level);
      float lowest = height + min(p.height_rate, 0.0) * leave;  // the height is convex in t
      bool clear = false;
      if (holder < size) {
        float k = node_highest(w, cell, size, holder);
        clear = lowest > k + 1.0e-6 * (abs(k) + abs(height)) + 1.0e-5;
      }
      t += clear ? leave : 0.0;
      size += clear && size < largest ? 1 : (clear ? 0 : -1);
      continue;
    }
    Cell c = cell_at(w, cell, level);
    float unit = 1.0 / float(1 << level);
    vec2 inside = (at - vec2(level_low(w, cell, level))) * unit;
    vec3 gap = gap_along(c, inside, rate * unit, height, p.height_rate, bend);
    float straight = 0.5 * heights.y + sqrt(heights.y * t);  // the track bends, see ray_cast.frag
    float hit = gap.x > 0.0 ? first_zero(gap) : 0.0;
    if (hit <= min(exit, straight)) {
      t += hit;
      return t > ray_origin.w ? sky : (c.unknown ? -max(t, 1.0e-3) : t);
    }
    t += min(straight, leave);
    size += 1;
  }
  return unresolved;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 surface = texelFetch(surface_texture, pixel, 0).rg;
  if (!(uintBitsToFloat(surface.x) > 0.0)) discard;
  float start = options.y == 1 ? 0.0 : abs(uintBitsToFloat(surface.y));
  range_bits = floatBitsToUint(cast_ray(make_ray(pixel_ray(vec2(pixel))), start));
}
