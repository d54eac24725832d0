// One vertex of a clipmap level: the level's own height, blended with the coarser level's near the
// level's outer edge.
layout(location = 0) in highp ivec4 piece;  // xy: south-west vertex, from the eye's; z: level; w: a row
layout(location = 0) uniform highp ivec2 levels;  // x: vertices a side; y: the coarsest level
out float unknown;
flat out float cell_unknown;  // of the cell north-east of the vertex, whose triangles it ends

// Stored height of a vertex; vertices of size s stand 2^s lattice posts apart and count from the one
// south-west of the eye. Beyond what the window holds (and beyond the range) the nearest held one.
float vertex_stored(ivec2 vertex, int size) {
  ivec2 post = (vertex << size) - into_node(size);
  int level = level_of(post, post, max(size - node_levels, 0));
  if (level > size) {
    vertex = ((vertex + (window.xy >> size)) >> (level - size)) - (window.xy >> level);
    size = level;
  }
  ivec4 held = level_rect[level];
  ivec2 eye_vertex = window.xy >> size;
  ivec2 low = (window.xy + held.xy + ((1 << size) - 1)) >> size;
  ivec2 high = (window.xy + held.zw) >> size;
  return node_stored(clamp(vertex + eye_vertex, low, high) - eye_vertex, size, level);
}

// The coarser level's surface at a vertex of a finer one: a vertex of its own, the middle of an edge, or
// the middle of a quad.
vec2 coarse_height(ivec2 vertex, int size) {
  ivec2 absolute = vertex + (window.xy >> size);
  ivec2 sw = (absolute >> 1) - (window.xy >> (size + 1));
  ivec2 ne = sw + (absolute & 1);
  vec2 f = 0.5 * vec2(absolute & 1);
  vec4 weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  return mean_height(vec4(vertex_stored(sw, size + 1), vertex_stored(ivec2(ne.x, sw.y), size + 1),
                          vertex_stored(ivec2(sw.x, ne.y), size + 1), vertex_stored(ne, size + 1)),
                     weight);
}

// Share of the coarser level: 0 inside, 1 from the last but one vertex on.
float coarse_share(ivec2 vertex, int size) {
  float width = float(levels.x) * 0.1, half_side = 0.5 * float(levels.x - 1);
  vec2 eye_at = (eye.xy + vec2(into_node(size))) / float(1 << size);
  vec2 off = clamp((abs(vec2(vertex) - eye_at) - (half_side - width - 1.0)) / width, 0.0, 1.0);
  return size == levels.y ? 0.0 : max(off.x, off.y);
}

void main() {
  int size = piece.z;
  ivec2 vertex = piece.xy + ivec2(gl_VertexID % piece.w, gl_VertexID / piece.w);
  float share = coarse_share(vertex, size);
  vec2 height = stored_height(vertex_stored(vertex, size));
  if (share > 0.0) height = blended(height, coarse_height(vertex, size), share);
  unknown = height.y;
  // A triangle knows three of its cell's posts: the fourth makes the cell unknown as well.
  float lowest = min(min(vertex_stored(vertex + ivec2(1, 0), size),
                         vertex_stored(vertex + ivec2(0, 1), size)),
                     vertex_stored(vertex + ivec2(1, 1), size));
  cell_unknown = piece.w != levels.x && lowest < void_threshold ? 1.0 : 0.0;  // not of the perimeter
  vec2 en = ground_of_posts(vec2((vertex << size) - into_node(size)));
  gl_Position = clip_of(ground_position(en, height.x));
}
