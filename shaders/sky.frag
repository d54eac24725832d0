// Sky pass: tiles of the picture where no ground shows, pixel by pixel.
layout(location = 0) out vec4 colour;

void main() {
  ivec2 pixel = picture_pixel();
  vec3 direction = ray_origin.xyz + float(pixel.x) * ray_dx.xyz + float(pixel.y) * ray_dy.xyz;
  vec3 seen = sky_colour(direction.z * inversesqrt(dot(direction, direction)));
  colour = vec4(with_pitch_line(seen, pixel), 1.0);
}
