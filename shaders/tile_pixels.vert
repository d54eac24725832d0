// One instance a tile: all its pixels. Row 0 of the target is the bottom of the picture.
layout(location = tile_attribute) in highp ivec4 record;
flat out highp ivec4 tile;

void main() {
  tile = record;
  ivec2 corner = ivec2(gl_VertexID & 1, gl_VertexID >> 1) * pair_of(record.z);
  vec2 at = vec2(pair_of(record.x) + corner) / vec2(ray_dx.w, ray_dy.w);
  gl_Position = vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
}
