// One instance a tile: all its pixels. Row 0 of the target is the bottom of the picture.
layout(location = tile_attribute) in highp ivec4 record;
flat out highp ivec4 tile;

void main() {
  tile = record;
  vec2 at = vec2(record.xy + ivec2(gl_VertexID & 1, gl_VertexID >> 1) * tile_size(record));
  vec2 clip = 2.0 * at / vec2(ray_dx.w, ray_dy.w) - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);
}
