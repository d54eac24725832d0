// Counts of the finished range picture: rays cast, and rays that met their step limit. Each
// invocation takes one tile.
layout(local_size_x = 8) in;
layout(binding = range_unit) uniform highp usampler2D range_texture;
layout(std430, binding = counters_buffer) buffer Counters { uint counters[]; };

const float proven_sky = 1.5e30;  // as in ray_cast.frag
const float unresolved = 2.0e30;

void main() {
  int index = int(gl_GlobalInvocationID.x);
  if (index >= window.w) return;
  ivec4 tile = record_of(index);
  ivec2 rays = tile_rays(tile);
  uint followed = 0u, failed = 0u;
  for (int y = 0; y < rays.y; ++y) {
    for (int x = 0; x < rays.x; ++x) {
      float value = uintBitsToFloat(texelFetch(range_texture, pair_of(tile.y) + ivec2(x, y), 0).r);
      followed += value == proven_sky ? 0u : 1u;
      failed += value == unresolved ? 1u : 0u;
    }
  }
  atomicAdd(counters[0], followed);
  atomicAdd(counters[1], failed);
}
