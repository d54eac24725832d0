#include "tests/gl/exact_ray.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ridgeline::test {

ProbeFrame probe_frame(const GeodeticPosition& eye, const Camera& camera, double range_m,
                       double step_deg, Chart chart, const PolarGrid& grid) {
  ProbeFrame f;
  f.local = local_frame(eye).value();
  f.camera = camera;
  const Result<GroundMap> map = ground_map(f.local, range_m, chart);
  if (!map) {
    std::fprintf(stderr, "no ground map at %g %g\n", eye.latitude_deg, eye.longitude_deg);
    std::abort();
  }
  f.map = map.value();
  f.lattice = {0, 0, step_deg, step_deg, chart};
  f.grid = grid;
  const LatticePoint at = f.lattice.point_of({eye.latitude_deg, eye.longitude_deg}, 0);
  f.eye_column = at.column;
  f.eye_row = at.row;
  TerrainView view;
  view.lattice = f.lattice;
  view.sizes = {1, 2, 2};
  view.eye_column = f.eye_column;
  view.eye_row = f.eye_row;
  f.blocks = frame_blocks(f.local, camera, f.map, grid, view, 9000);
  return f;
}

ExactRay::ExactRay(const ProbeFrame& frame, const glm::dvec3& direction) : frame_(frame) {
  const double horizontal = std::hypot(direction.x, direction.y);
  const double size = std::hypot(horizontal, direction.z);
  azimuth_rad = std::atan2(direction.x, direction.y);
  along = horizontal / size;
  up = direction.z / size;
  const double s = std::sin(azimuth_rad), c = std::cos(azimuth_rad);
  radius_m_ =
      1.0 / (c * c / frame.local.meridian_radius_m + s * s / frame.local.prime_vertical_radius_m);
  eye_radius_m_ = radius_m_ + frame.local.eye.height_m;
}

glm::dvec2 ExactRay::posts_at(double e, double n) const {
  const ChartPoint offset = frame_.map.offset(e, n);
  const Turn turn = turn_of(frame_.lattice.chart, frame_.local.eye);
  const double east = offset.east_deg / frame_.lattice.longitude_step_deg;
  const double north = offset.north_deg / frame_.lattice.latitude_step_deg;
  return {
      frame_.eye_column - std::floor(frame_.eye_column) + turn.cosine * east - turn.sine * north,
      frame_.eye_row - std::floor(frame_.eye_row) + turn.sine * east + turn.cosine * north};
}

ExactRay::Place ExactRay::at(double t_m) const {
  const double x = along * t_m, y = eye_radius_m_ + up * t_m;
  const double g = radius_m_ * std::atan2(x, y);
  const double e = g * std::sin(azimuth_rad) / frame_.map.range_m;
  const double n = g * std::cos(azimuth_rad) / frame_.map.range_m;
  // sqrt(y² + x²) - eye radius, without the cancellation of the two large numbers.
  const double rise = t_m * (2.0 * eye_radius_m_ * up + t_m) / (std::hypot(x, y) + eye_radius_m_);
  return {posts_at(e, n), rise - frame_.map.swell_at_m(e, n), g};
}

glm::dvec2 ExactRay::shift_m(double t_m, const glm::dvec2& posts) const {
  const double g = at(t_m).ground_m, range_m = frame_.map.range_m;
  const double e = g * std::sin(azimuth_rad) / range_m, n = g * std::cos(azimuth_rad) / range_m;
  constexpr double step = 1e-5;
  const glm::dvec2 de = (posts_at(e + step, n) - posts_at(e - step, n)) / (2 * step * range_m);
  const glm::dvec2 dn = (posts_at(e, n + step) - posts_at(e, n - step)) / (2 * step * range_m);
  const double det = de.x * dn.y - dn.x * de.y;
  return {(dn.y * posts.x - dn.x * posts.y) / det, (de.x * posts.y - de.y * posts.x) / det};
}

double ExactRay::distance_at_m(double ground_m) const {
  const double theta = ground_m / radius_m_;
  return eye_radius_m_ * std::sin(theta) / (along * std::cos(theta) - up * std::sin(theta));
}

}  // namespace ridgeline::test
