// Shade pass: what the pilot sees along each ray, from its range. No terrain value is made here.
// Without branches where it can be: a software GPU runs both sides of each anyway.
layout(binding = range_unit) uniform highp usampler2D range_texture;
layout(location = 0) out vec4 colour;

// How much is made of the ground (Shading in core/render/renderer.hpp): 0 everything, 1 without
// lines, 2 each cell lit by itself, 3 none is drawn.
#ifndef shading
#define shading 0
#endif

const vec3 plain_ground = vec3(0.36, 0.25, 0.14);  // the lower half of a frame without terrain
const vec3 sea_blue = vec3(0.09, 0.27, 0.47);
const vec3 line_dark = vec3(0.07, 0.06, 0.05);
const float contour_m = 100.0;
const float ambient = 0.36;

float ramp(float low, float high, float value) {
  float slope = 1.0 / (high - low);  // of constants: no division is left
  return clamp(value * slope - low * slope, 0.0, 1.0);
}

vec3 height_tint(float height_m) {
  vec3 c = mix(vec3(0.25, 0.43, 0.20), vec3(0.53, 0.56, 0.29), ramp(0.0, 650.0, height_m));
  c = mix(c, vec3(0.60, 0.46, 0.29), ramp(600.0, 1500.0, height_m));
  c = mix(c, vec3(0.58, 0.53, 0.49), ramp(1500.0, 2400.0, height_m));
  return mix(c, vec3(0.97, 0.98, 1.00), ramp(2300.0, 3200.0, height_m));
}

// Mean sea level over the ellipsoid at the ground point E, N (over the display range).
float geoid_m(vec2 at) {
  return geoid[0].x + at.x * (geoid[0].y + geoid[0].w * at.x + geoid[1].x * at.y) +
         at.y * (geoid[0].z + geoid[1].y * at.y);
}

struct Relief {
  vec2 gradient;    // m per post, continuous over cell borders: near facets do not look like tiles
  float roughness;  // m between the highest and the lowest post of the cell
};

// Rise between two posts, blended with that of the next pair over; a void post has no say.
vec2 blended(vec2 rise, vec2 near, vec2 outer, float side, float share) {
  vec2 beyond = mix(side * (outer - near), rise, lessThan(outer, vec2(void_threshold)));
  return mix(rise, beyond, share);
}

// A rise belongs to the middle of its edge and is bilinear from there to the next ones.
Relief relief_at(vec2 at) {
  Window w = window_here();
  ivec2 cell = ivec2(floor(at));
  int level = level_of(cell, cell + 1, 0);
  float unit = 1.0 / float(1 << level);
  vec2 f = (at - vec2(level_low(w, cell, level))) * unit;
  ivec2 p = level_texel(w, cell, level);
  vec4 here = four_posts(w, p, level);
  vec2 west = here.wx, east = here.zy, south = here.wz, north = here.xy;
#if shading == 2
  vec2 x = east - west, y = north - south;
#else
  bvec2 upper = greaterThan(f, vec2(0.5));
  ivec2 side = ivec2(upper) * 2 - 1;
  vec4 beside = four_posts(w, p + ivec2(side.x, 0), level);
  vec4 above = four_posts(w, p + ivec2(0, side.y), level);
  vec2 share = abs(f - 0.5);
  vec2 x = blended(east - west, upper.x ? east : west, upper.x ? beside.zy : beside.wx,
                   float(side.x), share.x);
  vec2 y = blended(north - south, upper.y ? north : south, upper.y ? above.xy : above.wz,
                   float(side.y), share.y);
#endif
  Relief r;
  r.gradient = vec2(mix(x.x, x.y, f.y), mix(y.x, y.y, f.x)) * unit;
  vec2 low = min(south, north), high = max(south, north);
  r.roughness = max(high.x, high.y) - min(low.x, low.y);
  if (min(low.x, low.y) < void_threshold) r.gradient = vec2(0.0);  // rounding next to a void
  return r;
}

// How much of a pixel a line covers: `offset` in lines from any line, `px2` the square of the
// pixels between two lines. Fades before neighbouring lines would run together.
vec3 line_cover(vec3 offset, vec3 px2) {
  vec3 near = fract(offset + 0.5) - 0.5;
  return clamp(line.z - near * near * px2, 0.0, 1.0) * clamp(px2 * 0.008 - 0.4, 0.0, 1.0);
}

// Ground under the hit at distance t: tint, light, contours, grid, haze.
vec3 ground_colour(vec3 direction, Ray r, float t) {
  RayPoint p = ray_point(r, t);
  float u = p.g * tolerance.z;
  vec2 place = u * r.azimuth;
  vec2 at = ground_posts(place.x, place.y);
  Relief relief = relief_at(at);
  float height = p.height + earth.w - geoid_m(place);
  vec2 slope = turned_back(relief.gradient * post_step.xy);
  vec3 normal = vec3(-slope, 1.0);  // not of unit length
  float size2 = 1.0 + dot(slope, slope);

  bool sea = abs(height) < post_step.w && relief.roughness <= post_step.z;
  float light = ambient + 0.72 * clamp(dot(normal, sun.xyz) * inversesqrt(size2), 0.0, 1.0);
  vec3 ground = sea ? sea_blue : height_tint(height) * light;
#if shading == 0
  // Change of east, north and height on the tangent plane when the ray moves by one pixel, squared.
  vec3 sight = vec3(r.azimuth * r.along, r.up);
  float facing = 1.0 / min(dot(normal, sight), -0.02);
  vec3 a = sight * facing;
  vec3 per_pixel2 = max(1.0 + a * (a * size2 - 2.0 * normal), 1.0e-4) * (t * t);
  vec3 offset = vec3(ground_grid.xy + at * ground_grid.zw, height * (1.0 / contour_m));
  // A pixel off the axis is a smaller angle: `direction` is longer than 1 by that much.
  // Where one ray stands for a block of pixels its lines are as much wider.
  ivec2 block = pair_of(tile.w);
  vec3 px2 = vec3(grid_step.xy, line.x) * dot(direction, direction) /
             (per_pixel2 * float(block.x * block.y));
  vec3 cover = line_cover(offset, px2);

  cover.z *= sea ? 0.0 : ramp(1.00003, 1.0004, size2);  // flat ground has no contours
  ground = mix(ground, line_dark, 0.42 * cover.z);
  ground = mix(ground, sea ? vec3(0.55, 0.72, 0.86) : line_dark, 0.30 * max(cover.x, cover.y));
#endif
  float far = t * line.w;
  float clear = 1.0 - far;  // squared, so that the end of the range is not cut out of the sky
  return mix(sky_colour(r.up), ground, clear * clear * (1.0 + 1.2 * far));
}

// The picture without terrain: plain blue over brown, or a red cross when even that is not known.
vec3 plain_colour(vec3 direction, vec2 pixel) {
  vec2 place = pixel * legend.zw;
  float off_cross = min(abs(place.x - place.y), abs(place.x + place.y - 1.0));
  vec3 dark = off_cross < 0.008 ? vec3(0.85, 0.05, 0.05) : vec3(0.05);
  return legend.y < 0.5 ? dark : direction.z >= 0.0 ? vec3(0.20, 0.45, 0.78) : plain_ground;
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 pixel = ray_pixel(texel);
  vec3 direction = pixel_ray(pixel);
#if shading == 3
  vec3 seen = plain_colour(direction, pixel + 0.5);
#else
  Ray r = make_ray(direction);
  float t = uintBitsToFloat(texelFetch(range_texture, texel, 0).r);
  vec3 seen = ground_colour(direction, r, min(abs(t), ray_origin.w));
  // Unknown is hatched in the picture, not on the ground, so that it looks like no ground.
  float hatch = fract((pixel.x + pixel.y) * (1.0 / 12.0));
  vec3 unknown = hatch < 0.5 ? vec3(0.86, 0.05, 0.86) : vec3(0.26, 0.02, 0.28);
  seen = t < 0.0 ? unknown : seen;
  seen = abs(t) >= sky ? sky_colour(r.up) : seen;
  seen = legend.x < 0.5 ? plain_colour(direction, pixel + 0.5) : seen;
#endif
  colour = vec4(seen, 1.0);
}
