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

// The bilinear cell seen along the ray: ray minus surface = c + b t + a t t from the point on.
vec3 gap_along(Cell q, vec2 f, vec2 rate, Ray r, RayPoint p) {
  float h0 = q.h00 + q.dx * f.x + q.dy * f.y + q.dxy * f.x * f.y;
  float h1 = q.dx * rate.x + q.dy * rate.y + q.dxy * (f.x * rate.y + f.y * rate.x);
  float h2 = q.dxy * rate.x * rate.y;
  return vec3(p.height - h0, p.height_rate - h1,
              0.5 * r.along * r.along * r.inverse_radius - h2);
}
