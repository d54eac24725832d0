// One post of a cell drawn as a mesh; gl_VertexID counts its posts row by row.
layout(location = 0) in highp ivec4 cell;  // south-west post relative to the eye's; z: level
layout(location = 0) uniform highp int side;  // cells along a cell of the method
out float unknown;
out vec2 at;  // post coordinates
flat out int level;

void main() {
  level = cell.z;
  int posts = side + 1;
  ivec2 post = cell.xy + (ivec2(gl_VertexID % posts, gl_VertexID / posts) << level);
  ivec4 held = level_rect[level];
  post = clamp(post, held.xy, held.zw);  // cells beyond the edge have no width
  vec2 height = post_height(post, level);
  at = vec2(post);
  unknown = height.y;
  gl_Position = clip_of(ground_position(ground_of_posts(at), height.x));
}
