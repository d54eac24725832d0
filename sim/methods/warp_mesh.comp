// Third pass: the warped geometry image: xyz the position of each vertex, m from the eye; w the octave
// of detail its neighbours leave room for: log2 of vertices a post.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 6) uniform highp sampler2D rows_texture;
layout(binding = 7) uniform highp sampler2D columns_texture;
layout(rgba32f, binding = 0) writeonly uniform highp image2D positions_image;

// Where a vertex stands in the square.
vec2 place_of(ivec2 vertex) {
  vertex = clamp(vertex, ivec2(0), warp_sizes.yy - 1);
  float v = texelFetch(columns_texture, vertex, 0).r;
  float row = clamp(v * float(warp_sizes.x) - 0.5, 0.0, float(warp_sizes.x - 1));
  int low = min(int(row), warp_sizes.x - 2);
  float south = texelFetch(rows_texture, ivec2(vertex.x, low), 0).r;
  float north = texelFetch(rows_texture, ivec2(vertex.x, low + 1), 0).r;
  return vec2(mix(south, north, row - float(low)), v);
}

// Its ground point; what is far outside the range, where the ground map ends, moves onto a rim there.
vec2 ground_of(ivec2 vertex) {
  vec2 en = from_square((place_of(vertex) * 2.0 - 1.0) * ray_origin.w);
  return en * min(1.0, 1.05 * ray_origin.w / max(length(en), 1.0));
}

void main() {
  ivec2 vertex = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(vertex, warp_sizes.yy))) return;
  vec2 en = ground_of(vertex);
  vec2 posts = posts_of_ground(en);
  vec2 surface = bilinear_height(posts);
  float height = surface.x;
  float carried = 0.0;
  if (warp_asks.z > 0.5) {
    float apart = 0.0;
    for (int k = 0; k < 4; ++k) {
      ivec2 step = ivec2(k == 0 ? 1 : k == 1 ? -1 : 0, k == 2 ? 1 : k == 3 ? -1 : 0);
      apart = max(apart, length(posts_of_ground(ground_of(vertex + step)) - posts));
    }
    carried = -log2(max(apart, 1.0e-3));
    height += carried_height(posts, carried);
  }
  imageStore(positions_image, vertex, vec4(ground_position(en, height), carried + 64.0 * surface.y));
}
