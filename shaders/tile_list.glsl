// Records of tiles, by number.
layout(binding = tiles_unit) uniform highp isampler2D tiles_texture;
ivec4 record_of(int k) {
  return texelFetch(tiles_texture, ivec2(k & (tile_list_width - 1), k / tile_list_width), 0);
}
