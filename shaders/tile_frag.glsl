flat in highp ivec4 tile;

// The image point of a ray of the tile, in pixels whose centres are whole: the middle of its block.
vec2 ray_pixel(ivec2 texel) {
  vec2 block = vec2(tile_block(tile));
  return vec2(tile.xy) + (vec2(texel - tile.xy) + 0.5) * block - 0.5;
}
