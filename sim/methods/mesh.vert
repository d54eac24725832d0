// One post of the full-resolution mesh; gl_VertexID counts the 65 x 65 posts of a block.
layout(location = 0) in highp ivec3 block;  // south-west post relative to the eye's; z: level
out float unknown;
out vec2 at;         // post coordinates
flat out int level;

void main() {
  level = block.z;
  ivec2 post = block.xy + (ivec2(gl_VertexID % 65, gl_VertexID / 65) << level);
  ivec4 held = level_rect[level];
  post = clamp(post, held.xy, held.zw);  // cells beyond the edge have no width
  vec2 height = post_height(post, level);
  at = vec2(post);
  unknown = height.y;
  gl_Position = clip_of(ground_position(ground_of_posts(at), height.x));
}
