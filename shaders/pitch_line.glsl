// The line of zero pitch, with a dark rim so that it shows on snow and sky.
vec3 with_pitch_line(vec3 seen, ivec2 pixel) {
  float up = ray_origin.z + float(pixel.x) * ray_dx.z + float(pixel.y) * ray_dy.z;
  float from_horizon = (abs(up) + 1.0 - legend.y) * line.y;
  seen *= 1.0 - 0.35 * clamp(2.4 - from_horizon, 0.0, 1.0);
  return mix(seen, vec3(1.0), 0.90 * clamp(line.z - from_horizon, 0.0, 1.0));
}
// Row 0 of the target is the bottom of the picture.
ivec2 picture_pixel() {
  return ivec2(int(gl_FragCoord.x), int(ray_dy.w) - 1 - int(gl_FragCoord.y));
}
