// Blends the importance of each texel with its eight neighbours'. Where what is asked jumps from one
// texel to the next, neighbouring lines of the warp would part and the mesh between them shear.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 6) uniform highp sampler2D importance_texture;
layout(rgba32f, binding = 0) writeonly uniform highp image2D blended_image;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, warp_sizes.xx))) return;
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 9; ++k) {
    ivec2 step = ivec2(k % 3 - 1, k / 3 - 1);
    ivec2 beside = clamp(texel + step, ivec2(0), warp_sizes.xx - 1);
    float weight = (step.x == 0 ? 0.5 : 0.25) * (step.y == 0 ? 0.5 : 0.25);
    sum += weight * texelFetch(importance_texture, beside, 0);
  }
  float seen = texelFetch(importance_texture, texel, 0).z;
  imageStore(blended_image, texel, vec4(sum.xy, seen, 0.0));
}
