// Ray cast pass: the first hit of each queued pixel's own ray, exact up to rounding.
layout(local_size_x = 64) in;
layout(r32ui, binding = target_image) writeonly uniform highp uimage2D range_image;
layout(std430, binding = queue_buffer) readonly buffer Queue { uvec4 queue[]; };
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

const int step_limit = 200000;

// Distance of the first known surface or, negative, of the first unknown floor; `sky` if none.
float first_hit(Ray r, float start) {
  Track track = track_of(r.azimuth.x, r.azimuth.y);
  float range = ray_origin.w;
  float ceiling = over_eye(heights.x);
  int top_level = int(heights.z);
  float t = start;
  if (r.up < 0.0) t = max(t, (ceiling + 1.0) / r.up);  // over the highest post until here
  int level = top_level;
  for (int steps = 0; steps < step_limit; ++steps) {
    if (t > range) return sky;
    RayPoint p = ray_point(r, t);
    if (p.height > ceiling && p.height_rate >= 0.0) return sky;
    float u = p.g * tolerance.z;
    vec2 at = track_posts(track, u);
    vec2 rate = track_rate(track, u) * p.g_rate;
    ivec2 cell = ivec2(floor(at));
    float nudge = 3.0e-5 + 4.0e-7 * t;
    float leave = min(exit_distance(cell, level, at, rate), heights.w) + nudge;
    if (level > 0) {
      // The height of a ray is convex in t: it stays above its tangent.
      float lowest = p.height + min(p.height_rate, 0.0) * leave;
      float k = node_highest(cell, level);
      if (lowest > k + 1.0e-6 * (abs(k) + abs(p.height)) + 1.0e-6) {
        t += leave;
        level = min(level + 1, top_level);
      } else {
        level -= 1;
      }
      continue;
    }
    Cell q = cell_at(cell);
    vec3 gap = gap_along(q, at - vec2(cell), rate, r, p);
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
    t += leave;
    level = 1;
  }
  atomicAdd(counters[1], 1u);
  return sky;
}

void main() {
  uint slot = gl_GlobalInvocationID.x;
  if (slot >= counters[0]) return;
  uvec4 entry = queue[slot];
  uint width = uint(ray_dx.w);
  ivec2 pixel = ivec2(entry.x % width, entry.x / width);
  Ray r = make_ray(pixel_ray(vec2(pixel)));
  float value = first_hit(r, uintBitsToFloat(entry.y));
  // Not beyond the farthest witness: a ray that slips between all nodes proves nothing there.
  float far = uintBitsToFloat(entry.z);
  if (abs(value) > abs(far)) value = far;
  imageStore(range_image, pixel, uvec4(floatBitsToUint(value)));
}
