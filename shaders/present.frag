// Present pass: every pixel from the rays of its tile, then the line of zero pitch and the words.
layout(binding = shaded_unit) uniform highp sampler2D shaded_texture;  // filtered, for colour alone
layout(binding = text_unit) uniform highp sampler2D text_texture;
layout(location = 0) out vec4 colour;

// Between the rays of the tile; at its edge that of the nearest block.
vec3 shaded(ivec2 pixel) {
  ivec2 block = pair_of(tile.w), first = pair_of(tile.y), inside = pixel - pair_of(tile.x);
  if (block == ivec2(1)) return texelFetch(shaded_texture, first + inside, 0).rgb;
  vec2 ray = clamp((vec2(inside) + 0.5) / vec2(block), vec2(0.5), vec2(tile_rays(tile)) - 0.5);
  return textureLod(shaded_texture, (vec2(first) + ray) * ray_target.xy, 0.0).rgb;
}

// Ink of the text layer: a dark plate, words over it.
vec3 with_text(vec3 under, ivec2 pixel) {
  float ink = 255.0 * texelFetch(text_texture, pixel, 0).r;
  under *= ink > 0.5 * float(text_plate) ? 0.36 : 1.0;
  vec3 words = ink > 0.5 * float(text_ink + text_caution)       ? vec3(1.0)
               : ink > 0.5 * float(text_caution + text_warning) ? vec3(1.0, 0.72, 0.10)
                                                                : vec3(1.0, 0.25, 0.20);
  return ink > 0.5 * float(text_warning + text_plate) ? words : under;
}

void main() {
  ivec2 pixel = ivec2(int(gl_FragCoord.x), int(ray_dy.w) - 1 - int(gl_FragCoord.y));
  vec3 seen = shaded(pixel);
  // The line of zero pitch, with a dark rim so that it shows on snow and sky.
  float up = ray_origin.z + float(pixel.x) * ray_dx.z + float(pixel.y) * ray_dy.z;
  float from_horizon = (abs(up) + 1.0 - legend.y) * line.y;
  seen *= 1.0 - 0.35 * clamp(2.4 - from_horizon, 0.0, 1.0);
  seen = mix(seen, vec3(1.0), 0.90 * clamp(line.z - from_horizon, 0.0, 1.0));
  colour = vec4(with_text(seen, pixel), 1.0);
}
