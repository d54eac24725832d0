// A part of the picture whose pixels share rays in blocks of one shape (core/render/ray_tile.hpp).

// xy: first pixel; zw: width and height, low and high half.
ivec2 tile_size(ivec4 record) { return ivec2(record.z & 0xFFFF, record.z >> 16); }
ivec2 tile_block(ivec4 record) { return ivec2(record.w & 0xFFFF, record.w >> 16); }
// Its rays, as a small picture in the corner of the tile.
ivec2 tile_rays(ivec4 record) {
  ivec2 block = tile_block(record);
  return (tile_size(record) + block - 1) / block;
}
