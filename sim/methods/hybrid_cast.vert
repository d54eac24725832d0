// A corner of the box round a cell that is ray cast; gl_VertexID counts the corners of six faces.
layout(location = 0) in highp ivec4 cell;    // south-west post relative to the eye's; level; steps
layout(location = 1) in highp vec2 low_high;  // lowest, highest over the ellipsoid
layout(location = 0) uniform highp int side;
flat out highp ivec4 box;   // as cell
flat out highp vec4 limit;  // west, south, east, north post
flat out highp vec3 bound;  // lowest, highest over the eye; longest way of a ray through the box

const float margin = 0.5;  // posts: a box on the curved Earth has no quite straight edges

void main() {
  int corner = gl_VertexID;  // 1: east, 2: north, 4: top
  box = cell;
  ivec4 held = level_rect[cell.z];
  limit = vec4(max(cell.xy, held.xy), min(cell.xy + (side << cell.z), held.zw));
  vec2 per_m = vec2(longitude[0].x, latitude[0].x) * tolerance.z;
  float across = 1.1 * length((limit.zw - limit.xy + 2.0 * margin) / per_m);
  float bulge = 1.0 + across * across * earth.x * 0.15;  // the Earth between the edges
  bound = vec3(over_eye(low_high.x) - 1.0, over_eye(low_high.y) + bulge, 0.0);
  bound.z = length(vec2(across, bound.y - bound.x));
  vec2 post = vec2((corner & 1) != 0 ? limit.z + margin : limit.x - margin,
                   (corner & 2) != 0 ? limit.w + margin : limit.y - margin);
  gl_Position = clip_of(ground_position(ground_of_posts(post), (corner & 4) != 0 ? bound.y : bound.x));
}
