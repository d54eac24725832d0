// Shade pass: what the pilot sees, from the range of each pixel. No terrain value is made here.
layout(binding = range_unit) uniform highp usampler2D range_texture;
layout(location = 0) out vec4 colour;

vec3 sky_colour(float up) {
  return mix(vec3(0.66, 0.80, 0.92), vec3(0.16, 0.38, 0.72), clamp(up * 2.2, 0.0, 1.0));
}

vec3 height_tint(float h) {
  vec3 c = mix(vec3(0.26, 0.42, 0.20), vec3(0.47, 0.52, 0.28), smoothstep(0.0, 700.0, h));
  c = mix(c, vec3(0.56, 0.46, 0.32), smoothstep(600.0, 1600.0, h));
  c = mix(c, vec3(0.55, 0.50, 0.46), smoothstep(1500.0, 2400.0, h));
  return mix(c, vec3(0.93, 0.94, 0.96), smoothstep(2300.0, 3200.0, h));
}

void main() {
  ivec2 pixel = ivec2(int(gl_FragCoord.x), int(ray_dy.w) - 1 - int(gl_FragCoord.y));
  vec3 direction = pixel_ray(vec2(pixel));
  Ray r = make_ray(direction);
  float t = uintBitsToFloat(texelFetch(range_texture, pixel, 0).r);
  if (abs(t) >= sky) {
    colour = vec4(sky_colour(r.up), 1.0);
    return;
  }
  if (t < 0.0) {  // unknown: magenta, hatched in the picture so that it looks like no ground
    float stripe = step(0.5, fract(float(pixel.x + pixel.y) / 10.0));
    colour = vec4(mix(vec3(0.78, 0.0, 0.78), vec3(0.30, 0.0, 0.32), stripe), 1.0);
    return;
  }
  RayPoint p = ray_point(r, t);
  float u = p.g * tolerance.z;
  vec2 at = ground_posts(u * r.azimuth.x, u * r.azimuth.y);
  vec2 cell = floor(at);
  Cell q = cell_at(ivec2(cell));
  vec2 f = at - cell;
  vec2 gradient = vec2(q.dx + q.dxy * f.y, q.dy + q.dxy * f.x) / post_step.xy;
  vec3 normal = normalize(vec3(-gradient, 1.0));
  float height = p.height + eye.z + eye.w + earth.z;
  float light = clamp(dot(normal, sun.xyz), 0.0, 1.0);
  vec3 ground = height_tint(height);
  bool sea = abs(height) < 0.6 && q.dx == 0.0 && q.dy == 0.0 && q.dxy == 0.0;
  if (sea) ground = vec3(0.10, 0.27, 0.45);
  ground *= 0.35 + 0.75 * light;
  float haze = 1.0 - exp(-t * sun.w);
  colour = vec4(mix(ground, vec3(0.70, 0.79, 0.86), haze), 1.0);
}
