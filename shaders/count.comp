// Counts of the finished range picture: rays cast, and rays that met their step limit. Each
// invocation takes two rows of the picture.
layout(local_size_x = 8) in;
layout(binding = range_unit) uniform highp usampler2D range_texture;
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

const float proven_sky = 1.5e30;  // as in ray_cast.frag
const float unresolved = 2.0e30;

void main() {
  ivec2 size = textureSize(range_texture, 0);
  int first = 2 * int(gl_GlobalInvocationID.x);
  if (first >= size.y) return;
  int last = min(first + 1, size.y - 1);
  uint proven = 0u, failed = 0u;
  for (int y = first; y <= last; ++y) {
    for (int x = 0; x < size.x; ++x) {
      float value = uintBitsToFloat(texelFetch(range_texture, ivec2(x, y), 0).r);
      proven += value == proven_sky ? 1u : 0u;
      failed += value == unresolved ? 1u : 0u;
    }
  }
  atomicAdd(counters[0], uint((last - first + 1) * size.x) - proven);
  atomicAdd(counters[1], failed);
}
