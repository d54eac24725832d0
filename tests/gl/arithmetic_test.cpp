// Every row of the table of float32 errors (docs/error_bound.md, section 4), attacked: the real
// GLSL functions on the real driver against the same geometry in double. Each test is named after
// its row, holds the derived constant and prints how much of it was met.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "config/limits.hpp"
#include "tests/gl/arithmetic_rows.hpp"
#include "tests/gl/exact_ray.hpp"
#include "tests/gl/shader_probe.hpp"

namespace ridgeline::test {
namespace {

constexpr double u = rounding_unit;
constexpr double deg = std::numbers::pi / 180.0;

Camera random_camera(Random& random, int k) {
  constexpr ImageGeometry images[] = {{1024, 800, 60}, {4096, 64, 10},   {64, 4096, 10},
                                      {640, 480, 120}, {4096, 4096, 90}, {16, 16, 120}};
  const Attitude attitude{random.between(-180, 180), random.between(-90, 90),
                          random.between(-720, 720)};
  const Attitude level{0, random.between(-10, 5), 90.0 * random.below(4)};
  return camera(k % 4 == 3 ? level : attitude, images[k % std::size(images)]).value();
}

/// A pixel as the shader is given it.
ShaderProbe::Call pixel_call(Random& random, const Camera& camera, double t_m = 0) {
  return {{static_cast<float>(random.below(camera.width_px)),
           static_cast<float>(random.below(camera.height_px)), static_cast<float>(t_m), 0},
          {}};
}

TEST(Arithmetic, ray_direction_is_off_by_11_u_at_the_edge_scale) {
  ShaderProbe probe(
      "Ray r = make_ray(pixel_ray(in_a.xy));"
      "out_a = vec4(r.azimuth, r.along, r.up); out_b.x = r.inverse_radius;");
  std::printf("[ row ] driver: %s\n", ShaderProbe::driver());
  Row direction("ray direction, px over edge scale", 11 * u);
  Row size("length of the ray", 7 * u), curvature("curvature 1/R, relative", 12 * u);
  Random random(1);
  for (int k = 0; k < 48; ++k) {
    const Camera camera = random_camera(random, k);
    const ProbeFrame frame =
        probe_frame({random.between(-60, 60), 8, 2000}, camera, 100'000, 1.0 / 1200);
    probe.set_blocks(frame.blocks);
    std::vector<ShaderProbe::Call> calls;
    for (int i = 0; i < 2'000; ++i) calls.push_back(pixel_call(random, camera));
    const auto results = probe.run(calls);
    const double edge = std::cos(camera.half_diagonal_rad(0));
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const glm::dvec3 made = direction_of(results[i].a);
      const glm::dvec3 seen = glm::transpose(camera.enu_from_camera.columns) * made;
      const double off_px = std::hypot(
          camera.cx + camera.fx * seen.x / seen.z - static_cast<double>(calls[i].a.x) - 0.5,
          camera.cy + camera.fy * seen.y / seen.z - static_cast<double>(calls[i].a.y) - 0.5);
      direction.add(off_px * edge * edge / camera.fx);
      const glm::dvec4 ray(results[i].a);
      if (ray.z > 1e-6) size.add(std::hypot(ray.z * std::hypot(ray.x, ray.y), ray.w) - 1);
      const double s = ray.x / std::hypot(ray.x, ray.y), c = ray.y / std::hypot(ray.x, ray.y);
      const double exact =
          c * c / frame.local.meridian_radius_m + s * s / frame.local.prime_vertical_radius_m;
      curvature.add(static_cast<double>(results[i].b.x) / exact - 1);
    }
  }
  direction.expect_within("px / s");
  size.expect_within("");
  curvature.expect_within("");
}

/// The Horner sums of first_hit(), word for word: they stand inside its loop.
constexpr std::string_view course_body =
    "Ray r = make_ray(pixel_ray(in_a.xy)); Course q = course_of(r); float s = in_a.z * tolerance.z;"
    "float height = s * (q.h.x + s * (q.h.y + s * (q.h.z + s * q.h.w)));"
    "vec2 at = eye.xy + s * (q.p1 + s * (q.p2 + s * (q.p3 + s * (q.p4 + s * q.p5))));"
    "out_a = vec4(at, height, in_a.z); out_b = vec4(r.azimuth, r.along, r.up);";

/// What a place on a ray may be off by, over the distance.
struct CourseRows {
  Row sideways, upright, along;

  void add(const ProbeFrame& frame, const ShaderProbe::Call& result) {
    const ExactRay ray(frame, direction_of(result.b));
    const double t_m = static_cast<double>(result.a.w);
    const ExactRay::Place exact = ray.at(t_m);
    // Only over ground that a ray can meet.
    const double over_sea_m = exact.height_m + frame.local.eye.height_m;
    if (over_sea_m > limits::max_terrain_height_m || over_sea_m < -600) return;
    const glm::dvec2 posts = glm::dvec2(glm::vec2(result.a)) - exact.posts;
    const glm::dvec2 shift = ray.shift_m(t_m, posts);
    const double s = std::sin(ray.azimuth_rad), c = std::cos(ray.azimuth_rad);
    const double forward_m = shift.x * s + shift.y * c;
    const double rise_m = static_cast<double>(result.a.z) - exact.height_m;
    // A place inside the eye's own post is stored to u of a post.
    const double near = 2 * u * 111'200 * frame.lattice.latitude_step_deg / t_m;
    sideways.add((shift.x * c - shift.y * s) / t_m, near);
    upright.add((rise_m * ray.along - forward_m * ray.up) / t_m, near);
    along.add((rise_m * ray.up + forward_m * ray.along) / t_m, near);
  }
  void expect_within() const {
    sideways.expect_within("rad");
    upright.expect_within("rad");
    along.expect_within("of t");
  }
};

/// One pose with a random view, random pixels, distances up to the range. Result: its error_rad.
double attack_course(ShaderProbe& probe, CourseRows& rows, Random& random, double latitude_deg,
                     double range_m, double step_deg, Chart chart) {
  const GeodeticPosition eye{latitude_deg, random.between(-180, 180),
                             random.between(-600, limits::max_eye_height_m)};
  const double pitch = random.below(3) == 0 ? random.between(-90, 30) : random.between(-15, 3);
  const Camera camera =
      ridgeline::camera({0, pitch, random.between(0, 360)}, {1024, 400, 90}).value();
  const ProbeFrame frame = probe_frame(eye, camera, range_m, step_deg, chart);
  probe.set_blocks(frame.blocks);
  std::vector<ShaderProbe::Call> calls;
  for (int i = 0; i < 4'000; ++i) {
    const double t_m = range_m * std::pow(10.0, -random.between(0, 5) * random.below(2));
    calls.push_back(pixel_call(random, camera, t_m));
  }
  for (const ShaderProbe::Call& result : probe.run(calls)) rows.add(frame, result);
  return frame.map.error_rad;
}

TEST(Arithmetic, course_of_the_ray_in_latitude_and_longitude) {
  ShaderProbe probe(course_body);
  // Sideways 8.4 u of rounding and 4e-7 of the series; upright 17.3 u and 7e-8.
  CourseRows rows{{"course: sideways", 9e-7}, {"course: upright", 1.1e-6}, {"course: along", 3e-6}};
  Random random(2);
  for (int k = 0; k < 120; ++k) {
    const double range_m = (k % 3 == 0 ? 10 : k % 3 == 1 ? 100 : 200) * 1'000.0;
    const double farthest = range_m > 150'000 ? 65 : 74;  // nearer the poles: the next test
    attack_course(probe, rows, random, random.between(-farthest, farthest), range_m,
                  1.0 / (k % 2 == 0 ? 1200 : 10800), Chart::geographic);
  }
  rows.expect_within();
}

TEST(Arithmetic, course_of_the_ray_in_a_polar_chart) {
  ShaderProbe probe(course_body);
  CourseRows rows{{"polar: sideways", 13 * u}, {"polar: upright", 1.1e-6}, {"polar: along", 3e-6}};
  Random random(3);
  for (int k = 0; k < 60; ++k) {
    const bool north = k % 2 == 0;
    attack_course(probe, rows, random, (north ? 1 : -1) * random.between(80, 90),
                  k % 3 == 0 ? 10'000 : 200'000, 1.0 / 2400,
                  north ? Chart::north_polar : Chart::south_polar);
  }
  rows.expect_within();
}

TEST(Arithmetic, course_of_the_ray_near_the_limit_of_the_geographic_chart) {
  // Five to eight ranges from a pole the sixth order of the composed series counts: 0.19 of what
  // the map itself is off by (error_rad is 1.5 times that), besides 4e-7 and the rounding.
  ShaderProbe probe(course_body);
  double largest = 0;
  Random random(4);
  for (int k = 0; k < 60; ++k) {
    const double range_m = k % 2 == 0 ? 200'000 : 50'000;
    const double ranges = random.between(5.2, 8.0);
    const double latitude_deg = std::acos(ranges * range_m / 6'378'137.0) / deg;
    CourseRows rows{{"", 0}, {"", 0}, {"", 0}};
    const double error_rad =
        attack_course(probe, rows, random, k % 4 < 2 ? latitude_deg : -latitude_deg, range_m,
                      1.0 / 1200, Chart::geographic);
    const double derived = 0.19 / 1.5 * error_rad + 9e-7;
    EXPECT_LE(rows.sideways.largest(), derived) << latitude_deg << ' ' << range_m;
    EXPECT_LE(rows.upright.largest(), derived) << latitude_deg << ' ' << range_m;
    largest = std::max(largest, rows.sideways.largest() / derived);
  }
  std::printf("[ row ] near the limit of the chart: %.2f of what is derived\n", largest);
}

TEST(Arithmetic, straight_way_inside_a_cell_bends_by_less_than_1e_6) {
  // From one place of the march to the next: at + rate x, as gap_along() takes it.
  ShaderProbe probe(
      "Ray r = make_ray(pixel_ray(in_a.xy)); Course q = course_of(r); float s = in_a.z * "
      "tolerance.z;"
      "vec2 at = eye.xy + s * (q.p1 + s * (q.p2 + s * (q.p3 + s * (q.p4 + s * q.p5))));"
      "vec2 rate = tolerance.z * (q.p1 + s * (2.0 * q.p2 + s * (3.0 * q.p3 + s * (4.0 * q.p4))));"
      "float x = min(min(0.5 * heights.y + sqrt(heights.y * in_a.z), heights.w), in_a.w);"
      "out_a = vec4(at + rate * x, in_a.z, x); out_b = vec4(r.azimuth, r.along, r.up);");
  Row row("straight inside a cell", 1e-6 + 9e-7);
  Random random(5);
  for (int k = 0; k < 40; ++k) {
    const double range_m = k % 2 == 0 ? 20'000 : 200'000;
    const double latitude_deg = random.between(-70, 70);
    const Camera camera =
        ridgeline::camera({0, random.between(-40, 5), random.between(0, 360)}, {1024, 400, 90})
            .value();
    const double step_deg = k % 3 == 0 ? 1.0 / 120 : 1.0 / 1200;
    const ProbeFrame frame = probe_frame({latitude_deg, 8, 2000}, camera, range_m, step_deg);
    probe.set_blocks(frame.blocks);
    std::vector<ShaderProbe::Call> calls;
    for (int i = 0; i < 2'000; ++i) {
      calls.push_back(pixel_call(random, camera, 5e4 * std::pow(10.0, -random.between(0, 6))));
      calls.back().a.w = static_cast<float>(1.4 * 111'200 * step_deg);  // across one cell
      if (i % 10 == 0) calls.back().a.z = 0;                            // the eye's own cell
    }
    for (const ShaderProbe::Call& result : probe.run(calls)) {
      const ExactRay ray(frame, direction_of(result.b));
      const double t_m = static_cast<double>(result.a.z) + static_cast<double>(result.a.w);
      const glm::dvec2 shift =
          ray.shift_m(t_m, glm::dvec2(glm::vec2(result.a)) - ray.at(t_m).posts);
      const double s = std::sin(ray.azimuth_rad), c = std::cos(ray.azimuth_rad);
      row.add((shift.x * c - shift.y * s) / t_m, 3 * u * 111'200 * step_deg / t_m);
    }
  }
  row.expect_within("rad");
}

TEST(Arithmetic, distance_at_overshoots_by_less_than_a_millionth) {
  ShaderProbe probe(
      "Ray r = make_ray(pixel_ray(in_a.xy)); out_a = vec4(distance_at(r, in_a.z), in_a.z, 0.0, "
      "0.0);"
      "out_b = vec4(r.azimuth, r.along, r.up);");
  Row row("distance_at, relative", 1e-6);
  Random random(6);
  for (int k = 0; k < 40; ++k) {
    const Camera camera =
        ridgeline::camera({0, random.between(-45, 45), random.between(0, 360)}, {1024, 400, 90})
            .value();
    const ProbeFrame frame = probe_frame({random.between(-70, 70), 8, random.between(-600, 20'500)},
                                         camera, 200'000, 1.0 / 1200);
    probe.set_blocks(frame.blocks);
    std::vector<ShaderProbe::Call> calls;
    for (int i = 0; i < 2'000; ++i) {
      calls.push_back(pixel_call(random, camera, 2e5 * std::pow(10.0, -random.between(0, 5))));
    }
    for (const ShaderProbe::Call& result : probe.run(calls)) {
      const ExactRay ray(frame, direction_of(result.b));
      if (std::abs(ray.up) > ray.along) continue;  // the grid ends at a slope of 1
      const glm::dvec4 made(result.a);
      row.add(made.x / ray.distance_at_m(made.y) - 1);
    }
  }
  row.expect_within("of t");
}

/// The grid as the frame pipeline makes it: as dense as its capacity allows.
PolarGrid densest_grid(const Camera& camera) {
  GridSpacing spacing;
  PolarGrid grid = polar_grid(camera, spacing);
  while (grid.plane_count > limits::max_planes || grid.row_count > limits::max_rows) {
    if (grid.plane_count > limits::max_planes) spacing.planes_px *= 1.5;
    if (grid.row_count > limits::max_rows) spacing.rows_px *= 1.5;
    grid = polar_grid(camera, spacing);
  }
  return grid;
}

TEST(Arithmetic, choice_of_plane_and_row) {
  // proven_empty() itself over nodes that hold their own number. A wedge is proven for 0.85 posts
  // beside its plane and 0.10 of the way; the choice may use what is left to 1: 0.05.
  ShaderProbe probe(
      "vec3 d = pixel_ray(in_a.xy); out_a = vec4(d, proven_empty(d)); out_b.xy = in_a.xy;");
  Row plane_row("choice of plane, wedge half widths", 0.05 / 0.85);
  Row row_row("choice of row, of its margin", 0.01);
  Random random(7);
  for (int k = 0; k < 60; ++k) {
    const Camera camera = random_camera(random, k);
    const PolarGrid grid = densest_grid(camera);
    if (!grid.used) continue;
    const ProbeFrame frame =
        probe_frame({46, 8, 2000}, camera, 100'000, 1.0 / 1200, Chart::geographic, grid);
    probe.set_blocks(frame.blocks);
    probe.number_nodes(grid.plane_count, grid.row_count);
    double widest_rad = 0;
    for (const auto& segment : grid.planes) widest_rad = std::max(widest_rad, 1 / segment.density);
    std::vector<ShaderProbe::Call> calls;
    for (int i = 0; i < 4'000; ++i) calls.push_back(pixel_call(random, camera));
    for (const ShaderProbe::Call& result : probe.run(calls)) {
      const glm::dvec4 made(result.a);
      const double slope = made.z / std::hypot(made.x, made.y);
      if (slope <= grid.slope_low + 1e-6 || slope >= grid.slope_high - 1e-6) continue;
      const int node = static_cast<int>(made.w);
      const double azimuth = std::atan2(made.x, made.y);
      const double off = std::abs(std::remainder(
          azimuth - grid.plane_azimuth_rad(node % grid.plane_count), 2 * std::numbers::pi));
      plane_row.add(std::max(0.0, off / (0.5 * widest_rad) - 1));
      const int row = node / grid.plane_count;
      const auto slope_used = static_cast<double>(static_cast<float>(grid.row_slope(row)));
      const double below = grid.row_of_slope(slope) - grid.row_of_slope(slope_used);
      if (row > 0) row_row.add(std::max(0.0, 0.01 - below));
    }
  }
  plane_row.expect_within("");
  row_row.expect_within("rows");
}

}  // namespace
}  // namespace ridgeline::test
