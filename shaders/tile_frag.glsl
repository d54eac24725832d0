flat in highp ivec4 tile;

// The image point of a ray of the tile, in pixels whose centres are whole: the middle of its block.
vec2 ray_pixel(ivec2 texel) {
  vec2 block = vec2(pair_of(tile.w));
  return vec2(pair_of(tile.x)) + (vec2(texel - pair_of(tile.y)) + 0.5) * block - 0.5;
}
