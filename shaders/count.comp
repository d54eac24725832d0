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
  ivec2 first = pair_of(tile.y);
  vec2 texel = ray_target.xy;
  uint followed = 0u, failed = 0u;
  for (int y = 0; y < rays.y; y += 2) {
    for (int x = 0; x < rays.x; x += 2) {
      // Four rays at once: x north-west, y north-east, z south-east, w south-west of their corner.
      uvec4 bits = textureGather(range_texture, vec2(first + ivec2(x, y) + 1) * texel);
      bvec4 beside = bvec4(false, x + 1 == rays.x, x + 1 == rays.x, false);
      bvec4 above = bvec4(y + 1 == rays.y, y + 1 == rays.y, false, false);
      vec4 value = mix(mix(uintBitsToFloat(bits), vec4(proven_sky), beside), vec4(proven_sky), above);
      uvec4 met = uvec4(notEqual(value, vec4(proven_sky)));
      uvec4 unmet = uvec4(equal(value, vec4(unresolved)));
      followed += met.x + met.y + met.z + met.w;
      failed += unmet.x + unmet.y + unmet.z + unmet.w;
    }
  }
  atomicAdd(counters[0], followed);
  atomicAdd(counters[1], failed);
}
