// From nodes to pixels: the error buffer.
//
// Each node is exact for its own ray, so any node within the witness radius of a pixel proves that
// its distance occurs inside the pixel's disc. A pixel whose four nodes agree takes the
// interpolated distance, pulled onto the surface along its own ray and held between its
// witnesses. A pixel where they disagree (a silhouette, or an interpolant off the surface by more
// than the residual) joins the queue of the ray cast, with the interval its hit must lie in.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = nodes_unit) uniform highp sampler2D nodes_texture;
layout(r32ui, binding = target_image) writeonly uniform highp uimage2D range_image;

// x: pixel, yz: start and far end of the search, as float bits
layout(std430, binding = queue_buffer) writeonly buffer Queue { uvec4 queue[]; };
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

void answer(ivec2 pixel, float value) {
  imageStore(range_image, pixel, uvec4(floatBitsToUint(value)));
}

void ask(ivec2 pixel, float start, float far) {
  uint slot = atomicAdd(counters[0], 1u);
  uint index = uint(pixel.y) * uint(ray_dx.w) + uint(pixel.x);
  queue[slot] = uvec4(index, floatBitsToUint(start), floatBitsToUint(far), 0u);
}

float farther(float a, float b) { return abs(b) > abs(a) ? b : a; }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= int(ray_dx.w) || pixel.y >= int(ray_dy.w)) return;
  vec3 direction = pixel_ray(vec2(pixel));
  float horizontal = length(direction.xy);
  if (grid.z == 0 || direction.z <= slope.x * horizontal || direction.z >= slope.y * horizontal) {
    ask(pixel, 0.0, sky);
    return;
  }

  // Place in the grid.
  float turn = 6.28318530718;
  float az = atan(direction.x, direction.y) - azimuth.x;
  az -= turn * floor(az / turn);
  int ka = clamp(int(az * azimuth.z), 0, segment_count - 1);
  float a = planes[ka].x + (az - float(ka) / azimuth.z) * planes[ka].y;
  float rise = direction.z / horizontal - slope.x;
  int kb = clamp(int(rise * slope.z), 0, segment_count - 1);
  float b = rows[kb].x + (rise - float(kb) / slope.z) * rows[kb].y;
  int i0 = int(floor(a)), j0 = clamp(int(floor(b)), 0, grid.y - 2);
  int i1 = i0 + 1;
  if (azimuth.w > 0.5) {
    if (i0 >= grid.x) i0 -= grid.x;
    if (i1 >= grid.x) i1 -= grid.x;
  } else {
    i0 = clamp(i0, 0, grid.x - 2);
    i1 = i0 + 1;
  }
  float fa = clamp(a - floor(a), 0.0, 1.0), fb = clamp(b - float(j0), 0.0, 1.0);
  float n00 = texelFetch(nodes_texture, ivec2(i0, j0), 0).r;
  float n10 = texelFetch(nodes_texture, ivec2(i1, j0), 0).r;
  float n01 = texelFetch(nodes_texture, ivec2(i0, j0 + 1), 0).r;
  float n11 = texelFetch(nodes_texture, ivec2(i1, j0 + 1), 0).r;

  float nearest = min(min(abs(n00), abs(n10)), min(abs(n01), abs(n11)));
  if (nearest >= sky) {
    answer(pixel, sky);
    return;
  }

  // Witnesses: nodes within the radius. The nearest node always is one.
  float w2 = tolerance.x * tolerance.x;
  float a0 = fa * fa, a1 = (1.0 - fa) * (1.0 - fa), b0 = fb * fb, b1 = (1.0 - fb) * (1.0 - fb);
  float far = 0.0, near = sky;
  if (a0 + b0 <= w2) { far = farther(far, n00); near = min(near, abs(n00)); }
  if (a1 + b0 <= w2) { far = farther(far, n10); near = min(near, abs(n10)); }
  if (a0 + b1 <= w2) { far = farther(far, n01); near = min(near, abs(n01)); }
  if (a1 + b1 <= w2) { far = farther(far, n11); near = min(near, abs(n11)); }

  bool known = min(min(n00, n10), min(n01, n11)) > 0.0;
  float farthest = max(max(abs(n00), abs(n10)), max(abs(n01), abs(n11)));
  bool hidden = max(max(n00, n10), max(n01, n11)) < 0.0;
  if (hidden) {
    answer(pixel, -clamp(mix(mix(-n00, -n10, fa), mix(-n01, -n11, fa), fb), near, abs(far)));
    return;
  }
  if (known && farthest < sky) {
    float inverse = mix(mix(1.0 / n00, 1.0 / n10, fa), mix(1.0 / n01, 1.0 / n11, fa), fb);
    float t = 1.0 / inverse;
    Ray r = make_ray(direction);
    RayPoint p = ray_point(r, t);
    float u = p.g * tolerance.z;
    vec2 at = ground_posts(u * r.azimuth.x, u * r.azimuth.y);
    vec2 floor_at = floor(at);
    Cell q = cell_at(ivec2(floor_at));
    vec2 rate = vec2(longitude[0].x * r.azimuth.x, latitude[0].x * r.azimuth.y) * tolerance.z * p.g_rate;
    vec3 gap = gap_along(q, at - floor_at, rate, r, p);
    if (!q.unknown && abs(gap.x) * r.along <= tolerance.y * t) {
      float onto = gap.y < -1.0e-6 ? -gap.x / gap.y : 0.0;
      if (abs(onto) > 0.02 * t) onto = 0.0;
      answer(pixel, clamp(t + onto, near, abs(far)));
      return;
    }
  }
  ask(pixel, max(0.98 * nearest - 250.0, 0.0), far);
}
