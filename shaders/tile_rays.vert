// Four vertices a tile: where its rays stand. Row 0 of the target is the top.
flat out highp ivec4 tile;

void main() {
  tile = record_of(gl_VertexID >> 2);
  ivec2 corner = ivec2(gl_VertexID & 1, gl_VertexID >> 1 & 1) * tile_rays(tile);
  gl_Position = vec4(2.0 * vec2(pair_of(tile.y) + corner) * ray_target.xy - 1.0, 0.0, 1.0);
}
