// One pixel's ray over the curved Earth.

struct Ray {
  vec2 azimuth;        // sin, cos
  float along, up;     // horizontal and upward part of the unit direction
  float inverse_radius;  // of the osculating circle at this azimuth
  float eye_radius;      // R + eye height
};

vec3 pixel_ray(vec2 pixel) { return ray_origin.xyz + pixel.x * ray_dx.xyz + pixel.y * ray_dy.xyz; }

Ray make_ray(vec3 direction) {
  Ray r;
  float horizontal = length(direction.xy);
  float size = length(direction);
  r.azimuth = horizontal > 1.0e-9 * size ? direction.xy / horizontal : vec2(0.0, 1.0);
  r.along = horizontal / size;
  r.up = direction.z / size;
  r.inverse_radius = earth.x * r.azimuth.y * r.azimuth.y + earth.y * r.azimuth.x * r.azimuth.x;
  r.eye_radius = 1.0 / r.inverse_radius + earth.w;
  return r;
}

// Where the ray is at distance t: g along the ground, height over the eye, and their rates by t.
struct RayPoint { float g, height, g_rate, height_rate; };

RayPoint ray_point(Ray r, float t) {
  float x = t * r.along, y = t * r.up;
  float inverse = 1.0 / (r.eye_radius + y);
  float v = x * inverse;
  float w = v * v;
  RayPoint p;
  p.height = y + x * v * (0.5 - 0.125 * w);
  p.g = v * (1.0 - w * (1.0 / 3.0) + w * w * 0.2) / r.inverse_radius;
  p.height_rate = r.up + v * (r.along - 0.5 * v * r.up);
  p.g_rate = (r.along - v * r.up) * inverse / (r.inverse_radius * (1.0 + w));
  return p;
}

// The bilinear cell seen along a ray: ray minus surface = x + y t + z t t from the point on.
// height, climb, bend: of the ray there; its height is height + climb t + bend t t.
vec3 gap_along(Cell c, vec2 f, vec2 rate, float height, float climb, float bend) {
  count_cell
  float h0 = c.h00 + c.dx * f.x + c.dy * f.y + c.dxy * f.x * f.y;
  float h1 = c.dx * rate.x + c.dy * rate.y + c.dxy * (f.x * rate.y + f.y * rate.x);
  float h2 = c.dxy * rate.x * rate.y;
  return vec3(height - h0, climb - h1, bend - h2);
}
