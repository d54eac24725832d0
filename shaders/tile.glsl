// A part of the picture whose pixels share rays in blocks of one shape (core/render/ray_tile.hpp).
// x: first pixel; y: where its rays begin in the targets; z: size; w: block. Two numbers each.
ivec2 pair_of(int both) { return ivec2(both & 0xFFFF, both >> 16); }
ivec2 tile_rays(ivec4 record) {
  ivec2 block = pair_of(record.w);
  vec2 blocks = (vec2(pair_of(record.z) + block) - 0.5) / vec2(block);  // no number is near a whole one
  return ivec2(blocks);
}
