// Words pass: the text layer over the picture, where there is any. Blended: colour + (1 - alpha) picture.
layout(binding = text_unit) uniform highp sampler2D text_texture;
layout(location = 0) out vec4 colour;

void main() {
  ivec2 pixel = ivec2(int(gl_FragCoord.x), int(ray_dy.w) - 1 - int(gl_FragCoord.y));
  float ink = 255.0 * texelFetch(text_texture, pixel, 0).r;
  vec3 words = ink > 0.5 * float(text_ink + text_caution)       ? vec3(1.0)
               : ink > 0.5 * float(text_caution + text_warning) ? vec3(1.0, 0.72, 0.10)
                                                                : vec3(1.0, 0.25, 0.20);
  float plate = ink > 0.5 * float(text_plate) ? 0.64 : 0.0;
  colour = ink > 0.5 * float(text_warning + text_plate) ? vec4(words, 1.0) : vec4(vec3(0.0), plate);
}
