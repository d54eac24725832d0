// A square of the rays of a tile, as a point. Row 0 of the target is the top.
flat out highp ivec4 tile;

void main() {
  send_members();
  tile = record_of(int(square.x));
  vec3 part = place_of(square.y);
  vec2 middle = vec2(pair_of(tile.y)) + part.xy + 0.5 * part.z;
  gl_Position = vec4(2.0 * middle * ray_target.xy - 1.0, 0.0, 1.0);
  gl_PointSize = part.z;
}
