// Records of tiles, by number.
layout(binding = tiles_unit) uniform highp isampler2D tiles_texture;
ivec4 record_of(int k) {
  return texelFetch(tiles_texture, ivec2(k % tile_list_width, k / tile_list_width), 0);
}
// Corners of two triangles that make a rectangle.
ivec2 corner_of(int vertex) { return ivec2(vertex & 1, (vertex >= 2 && vertex <= 4) ? 1 : 0) ; }
