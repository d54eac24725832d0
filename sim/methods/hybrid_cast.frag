// The ray of one pixel through one cell: linear steps from where it enters the box to where it leaves,
// binary steps between the last over the surface and the first below. The box's far faces are drawn,
// so each ray through it has one fragment wherever the eye is.
flat in highp ivec4 box;    // south-west post, level; linear steps << 8 | binary steps
flat in highp vec4 limit;   // west, south, east, north post
flat in highp vec3 bound;   // lowest, highest over the eye; longest way
layout(location = 0) out highp uint range_bits;

const float overlap = 0.25;  // posts: neighbouring cells leave no gap between them

// The way of the ray through the box, s = 0..1: posts and height over the eye are a + s (b + s c), a
// parabola through three points of the ray.
struct Way { vec3 a, b, c; };

vec3 point_at(Ray r, float t) {
  RayPoint p = ray_point(r, t);
  vec2 z = p.g * tolerance.z * r.azimuth;
  float swell = z.y * (tolerance.y * z.y * z.y + tolerance.w * z.x * z.x);
  return vec3(ground_posts(z.x, z.y), p.height - swell);
}

Way way_of(Ray r, float start, float length_m) {
  vec3 p0 = point_at(r, start);
  vec3 p1 = point_at(r, start + 0.5 * length_m);
  vec3 p2 = point_at(r, start + length_m);
  return Way(p0, 4.0 * p1 - 3.0 * p0 - p2, 2.0 * (p0 + p2) - 4.0 * p1);
}

vec3 along(Way w, float s) { return w.a + s * (w.b + s * w.c); }

// Where a nearly straight a + s (b + s c) passes `value`.
float passes(float a, float b, float c, float value) {
  float d = value - a;
  float root = sqrt(max(b * b + 4.0 * c * d, 0.0));
  float sum = b + (b < 0.0 ? -root : root);
  return sum != 0.0 ? 2.0 * d / sum : 0.0;
}

// Cuts the span of s down to where the value is below `high`. An empty span has x > y.
void keep_below(inout vec2 span, float a, float b, float c, float high) {
  bool first = a + span.x * (b + span.x * c) > high;
  bool last = a + span.y * (b + span.y * c) > high;
  if (first && last) span = vec2(1.0, 0.0);
  else if (first) span.x = clamp(passes(a, b, c, high), span.x, span.y);
  else if (last) span.y = clamp(passes(a, b, c, high), span.x, span.y);
}

// x: how far the ray is below the surface; y: 1 where that is unknown.
vec2 below(Way w, float s) {
  count_cell
  vec3 p = along(w, s);
  vec2 surface = bilinear_height(p.xy);
  return vec2(surface.x - p.z, surface.y);
}

void main() {
  vec2 pixel = floor(gl_FragCoord.xy);
  vec3 direction = pixel_ray(pixel);
  Ray r = make_ray(direction);
  float leave = length(direction) / gl_FragCoord.w;  // of the box
  float start = max(leave - bound.z, 0.0);
  float way_m = leave - start;
  Way w = way_of(r, start, way_m);
  vec2 span = vec2(0.0, min(1.0, (ray_origin.w - start) / way_m));
  keep_below(span, w.a.x, w.b.x, w.c.x, limit.z + overlap);
  keep_below(span, -w.a.x, -w.b.x, -w.c.x, overlap - limit.x);
  keep_below(span, w.a.y, w.b.y, w.c.y, limit.w + overlap);
  keep_below(span, -w.a.y, -w.b.y, -w.c.y, overlap - limit.y);
  keep_below(span, w.a.z, w.b.z, w.c.z, bound.y);
  if (span.x > span.y) discard;

  int linear = box.w >> 8, binary = box.w & 255;
  float step = (span.y - span.x) / float(linear);
  float over = span.x, under = span.x;
  vec2 found = below(w, span.x);  // below at once: the neighbour before has missed it
  for (int k = 1; k <= linear && found.x < 0.0; ++k) {
    over = under;
    under = span.x + float(k) * step;
    found = below(w, under);
  }
  if (found.x < 0.0) discard;
  for (int k = 0; k < binary; ++k) {
    float middle = 0.5 * (over + under);
    vec2 there = below(w, middle);
    if (there.x < 0.0) {
      over = middle;
    } else {
      under = middle;
      found = there;
    }
  }
  float t = start + under * way_m;
  range_bits = floatBitsToUint(found.y > 0.0 ? -t : t) | 1u;  // found by a ray
  gl_FragDepth = t / ray_origin.w;
}
