// Four vertices a tile: all its pixels. Row 0 of the target is the bottom of the picture.
flat out highp ivec4 tile;

void main() {
  tile = record_of(gl_VertexID >> 2);
  vec2 at = vec2(pair_of(tile.x) + ivec2(gl_VertexID & 1, gl_VertexID >> 1 & 1) * pair_of(tile.z)) /
            vec2(ray_dx.w, ray_dy.w);
  gl_Position = vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
}
