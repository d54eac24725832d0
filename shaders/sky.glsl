// What is seen where no ground is.
const vec3 horizon_blue = vec3(0.72, 0.82, 0.91);
const vec3 zenith_blue = vec3(0.10, 0.30, 0.64);
vec3 sky_colour(float up) {
  float s = clamp(up, 0.0, 1.0);
  return mix(zenith_blue, horizon_blue, 1.0 / (1.0 + 7.0 * s));
}
