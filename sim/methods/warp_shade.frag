// Light of the procedural detail over a shaded picture: the product of both is blended as
// 2 * source * picture. The mesh carries the octaves its vertices have room for as relief; all octaves,
// up to what a pixel can show, are lit.
in vec2 at;
in float unknown;
in float carried;
layout(binding = text_unit) uniform highp sampler2D text_texture;
layout(location = 0) out vec4 colour;

const float ambient = 0.36, sunlight = 0.72;  // as in shade.frag

float light(vec2 slope) {
  vec3 normal = vec3(-slope, 1.0);
  return ambient + sunlight * clamp(dot(normalize(normal), sun.xyz), 0.0, 1.0);
}

// Slope of the detail, m per post.
vec2 detail_slope(float pixel_posts) {
  vec2 sum = vec2(0.0);
  float height = detail_height(at);
  for (int k = first_octave; k < first_octave + octave_count; ++k) {
    float cell = exp2(-float(k));
    float shown = clamp(2.0 - 2.0 * pixel_posts / cell, 0.0, 1.0);
    if (shown <= 0.0) break;
    sum += shown * height * noise_octave(at, k).yz;
    height *= detail_fall;
  }
  return sum;
}

void main() {
  ivec2 pixel = ivec2(int(gl_FragCoord.x), int(ray_dy.w) - 1 - int(gl_FragCoord.y));
  vec3 ray = ray_origin.xyz + float(pixel.x) * ray_dx.xyz + float(pixel.y) * ray_dy.xyz;
  float t = length(ray) / gl_FragCoord.w;
  float pixel_posts = max(length(dFdx(at)), length(dFdy(at)));
  gl_FragDepth = min(t / ray_origin.w, 1.0);
  if (!(t <= ray_origin.w)) discard;
  ivec2 cell = ivec2(floor(held_posts(at)));
  int level = level_of(cell, cell + 1, 0);
  Window w = window_here();
  Cell c = cell_at(w, cell, level);
  vec2 f = (at - vec2(level_low(w, cell, level))) / float(1 << level);
  vec2 base = vec2(c.dx + c.dxy * f.y, c.dy + c.dxy * f.x) / float(1 << level);
  vec2 here = turned_back(base * post_step.xy);
  vec2 there = turned_back((base + detail_slope(pixel_posts)) * post_step.xy);
  float ratio = light(there) / light(here);
  float clear = 1.0 - t / ray_origin.w;  // haze as in shade.frag
  ratio = mix(1.0, ratio, clear * clear);
  bool plain = unknown > 0.0 || c.unknown || texelFetch(text_texture, pixel, 0).r > 0.0;
  colour = vec4(vec3(plain ? 0.5 : 0.5 * min(ratio, 2.0)), 0.5);
}
