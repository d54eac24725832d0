// A square of the pixels of a tile, as a point. Row 0 of the target is the bottom of the picture.
flat out highp ivec4 tile;

void main() {
  send_members();
  tile = record_of(int(square.x));
  vec3 part = place_of(square.y);
  vec2 middle = vec2(pair_of(tile.x)) + part.xy + 0.5 * part.z;
  vec2 at = middle / vec2(ray_dx.w, ray_dy.w);
  gl_Position = vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
  gl_PointSize = part.z;
}
