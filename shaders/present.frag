// Present pass: every pixel from the rays of its tile, then the line of zero pitch.
layout(binding = shaded_unit) uniform highp sampler2D shaded_texture;  // filtered, for colour alone
layout(location = 0) out vec4 colour;

// Between the rays of the tile; at its edge that of the nearest block. A pixel with a ray of its own
// meets that in the middle.
vec3 shaded(ivec2 pixel) {
  ivec2 block = pair_of(tile.w), first = pair_of(tile.y), inside = pixel - pair_of(tile.x);
  vec2 ray = clamp((vec2(inside) + 0.5) / vec2(block), vec2(0.5), vec2(tile_rays(tile)) - 0.5);
  return textureLod(shaded_texture, (vec2(first) + ray) * ray_target.xy, 0.0).rgb;
}

void main() {
  ivec2 pixel = picture_pixel();
  colour = vec4(with_pitch_line(shaded(pixel), pixel), 1.0);
}
