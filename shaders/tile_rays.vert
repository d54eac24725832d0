// One instance a tile: where its rays stand. Row 0 of the target is the top.
layout(location = tile_attribute) in highp ivec4 record;
flat out highp ivec4 tile;

void main() {
  tile = record;
  ivec2 corner = ivec2(gl_VertexID & 1, gl_VertexID >> 1) * tile_rays(record);
  gl_Position = vec4(2.0 * vec2(pair_of(record.y) + corner) * ray_target.xy - 1.0, 0.0, 1.0);
}
