// One instance a tile: the corner of it that holds its rays. Row 0 of the target is the top.
layout(location = tile_attribute) in highp ivec4 record;
flat out highp ivec4 tile;

void main() {
  tile = record;
  vec2 at = vec2(record.xy + ivec2(gl_VertexID & 1, gl_VertexID >> 1) * tile_rays(record));
  gl_Position = vec4(2.0 * at / vec2(ray_dx.w, ray_dy.w) - 1.0, 0.0, 1.0);
}
