// One vertex of the persistent grid: its ray meets the base plane, the average pyramid tells the height
// there, and the vertex is lifted to it.
layout(location = 0) uniform highp vec3 corner;  // ray of vertex (0, 0), ENU
layout(location = 1) uniform highp vec3 across;  // change from column to column
layout(location = 2) uniform highp vec3 down;    // from row to row
layout(location = 3) uniform highp vec2 base;    // x: depth of the plane under the eye; y: largest g
layout(location = 4) uniform highp int stride;   // vertex numbers a row
out float unknown;

// Where the ray of a vertex meets the base plane; m east and north of the foot of the eye.
vec2 base_point(vec2 vertex) {
  vec3 ray = corner + vertex.x * across + vertex.y * down;
  vec2 en = ray.xy * (base.x / -min(ray.z, -1.0e-6 * base.x / base.y));
  float g = length(en);
  return g > base.y ? en * (base.y / g) : en;
}

// Posts to the farthest neighbour. The eight form the border of a quadrilateral on the plane, of which a
// corner is farthest from any point.
float farthest_posts(vec2 vertex, vec2 en) {
  vec2 per_m = vec2(longitude[0].x, latitude[0].x) * tolerance.z;
  vec2 a = (base_point(vertex + vec2(-1.0, -1.0)) - en) * per_m;
  vec2 b = (base_point(vertex + vec2(1.0, -1.0)) - en) * per_m;
  vec2 c = (base_point(vertex + vec2(-1.0, 1.0)) - en) * per_m;
  vec2 d = (base_point(vertex + vec2(1.0, 1.0)) - en) * per_m;
  return sqrt(max(max(dot(a, a), dot(b, b)), max(dot(c, c), dot(d, d))));
}

// The average of nodes of 2^size posts at any place between their middles.
vec2 average_height(vec2 posts, int size) {
  ivec2 low = ivec2(floor(posts)) - (1 << size);
  int level = level_of(low, low + (2 << size) + 1, max(size - node_levels, 0));
  size = max(size, level);
  ivec2 eye_node = window.xy >> size, r_low = (window.xy + level_rect[level].xy) >> size;
  ivec2 r_high = (window.xy + level_rect[level].zw) >> size;
  vec2 at = (posts + vec2(into_node(size)) + 0.5) / float(1 << size) - 0.5;
  vec2 whole = floor(at), f = at - whole;
  ivec2 sw = clamp(ivec2(whole) + eye_node, r_low, r_high) - eye_node;
  ivec2 ne = clamp(ivec2(whole) + 1 + eye_node, r_low, r_high) - eye_node;
  vec4 weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  return mean_height(vec4(node_stored(sw, size, level), node_stored(ivec2(ne.x, sw.y), size, level),
                          node_stored(ivec2(sw.x, ne.y), size, level), node_stored(ne, size, level)),
                     weight);
}

void main() {
  vec2 vertex = vec2(gl_VertexID % stride, gl_VertexID / stride);
  vec2 en = base_point(vertex);
  vec2 posts = posts_of_ground(en);
  float size = log2(max(farthest_posts(vertex, en), 1.0));
  int most = window.z - 1 + node_levels;
  size = min(size, float(most));
  int own = min(int(size), most - 1);
  vec2 height = blended(average_height(posts, own), average_height(posts, own + 1), size - float(own));
  unknown = height.y;
  gl_Position = clip_of(ground_position(en, height.x));
}
