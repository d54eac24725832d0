#include "core/geo/polar_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace ridgeline {
namespace {

constexpr double pi = std::numbers::pi;

struct View {
  Camera camera;
  PolarGrid grid;
  GridSpacing spacing;
};

View view(const Attitude& attitude, const ImageGeometry& image, const GridSpacing& spacing) {
  const auto made = camera(attitude, image);
  EXPECT_TRUE(made.ok());
  return {made.value(), polar_grid(made.value(), spacing), spacing};
}

std::string words(const Attitude& a, const ImageGeometry& i) {
  return "roll " + std::to_string(a.roll_deg) + " pitch " + std::to_string(a.pitch_deg) +
         " heading " + std::to_string(a.heading_deg) + " fov " +
         std::to_string(i.horizontal_field_of_view_deg);
}

/// Fractional plane of an azimuth, as the shader looks it up.
double plane_of_azimuth(const PolarGrid& grid, double azimuth_rad) {
  double from_start = azimuth_rad - grid.azimuth_start_rad;
  from_start -= 2 * pi * std::floor(from_start / (2 * pi));
  const double width = grid.azimuth_span_rad / limits::grid_segments;
  const int k = std::min(static_cast<int>(from_start / width), limits::grid_segments - 1);
  return grid.planes[k].first_index + (from_start - k * width) * grid.planes[k].density;
}

std::vector<Attitude> attitudes() {
  std::vector<Attitude> all;
  for (const double roll : {0.0, 20.0, 90.0, -133.0, 180.0}) {
    for (const double pitch : {-90.0, -75.0, -60.0, -45.0, -6.0, 0.0, 30.0, 60.0, 90.0}) {
      all.push_back({roll, pitch, 200.0});
    }
  }
  std::mt19937 random(7);
  const auto share = [&] { return static_cast<double>(random()) * 0x1p-32; };
  for (int k = 0; k < 40; ++k) {
    all.push_back({360 * share() - 180, 180 * share() - 90, 360 * share()});
  }
  return all;
}

/// Nodes the shader needs for the pixels of a view, against those it is given.
int pixels_without_node(const View& v) {
  int missing = 0;
  std::vector<RowRange> rows;
  for (int i = 0; i < v.grid.plane_count; ++i) {
    rows.push_back(visible_rows(v.camera, v.grid, v.grid.plane_azimuth_rad(i)));
  }
  for (int y = 0; y < v.camera.height_px; ++y) {
    for (int x = 0; x < v.camera.width_px; ++x) {
      const auto ray = v.camera.ray(x + 0.5, y + 0.5).xyz;
      const double slope = ray.z / std::hypot(ray.x, ray.y);
      if (!(slope > v.grid.slope_low && slope < v.grid.slope_high)) continue;
      const double a = plane_of_azimuth(v.grid, std::atan2(ray.x, ray.y));
      int plane = static_cast<int>(std::floor(a + 0.5));
      if (v.grid.full_circle && plane >= v.grid.plane_count) plane -= v.grid.plane_count;
      if (plane < 0 || plane >= v.grid.plane_count) {
        ++missing;
        continue;
      }
      const int row = static_cast<int>(std::floor(v.grid.row_of_slope(slope) - 0.01));
      if (std::max(row, 0) < rows[plane].first || row > rows[plane].last) ++missing;
    }
  }
  return missing;
}

TEST(PolarGrid, every_pixel_finds_its_node_among_the_visible_rows) {
  int used = 0;
  for (const double fov_deg : {10.0, 60.0, 120.0}) {
    const ImageGeometry image{100, 80, fov_deg};
    for (const Attitude& attitude : attitudes()) {
      const View v = view(attitude, image, {3.0, 1.5});
      if (!v.grid.used) continue;
      ++used;
      EXPECT_EQ(pixels_without_node(v), 0) << words(attitude, image);
    }
  }
  EXPECT_GT(used, 150);
}

/// Where a node appears; false when it is not in the picture.
bool node_place(const View& v, int plane, int row, double& u, double& w) {
  const double azimuth = v.grid.plane_azimuth_rad(plane), slope = v.grid.row_slope(row);
  const Vec3<Enu> direction{{std::sin(azimuth), std::cos(azimuth), slope}};
  const auto c = (v.camera.enu_from_camera.inverse() * direction).xyz;
  if (c.z <= 0) return false;
  u = v.camera.cx + v.camera.fx * c.x / c.z;
  w = v.camera.cy + v.camera.fy * c.y / c.z;
  return u >= 0 && u <= v.camera.width_px && w >= 0 && w <= v.camera.height_px;
}

TEST(PolarGrid, neighbouring_nodes_of_the_picture_are_never_farther_apart_than_promised) {
  int pairs = 0;
  for (const double fov_deg : {10.0, 60.0, 120.0}) {
    const ImageGeometry image{100, 80, fov_deg};
    for (const Attitude& attitude : attitudes()) {
      const View v = view(attitude, image, {3.0, 1.5});
      if (!v.grid.used) continue;
      double widest_planes_px = 0, widest_rows_px = 0;
      for (int i = 0; i + 1 < v.grid.plane_count; ++i) {
        for (int j = 0; j + 1 < v.grid.row_count; ++j) {
          double u0 = 0, w0 = 0, u1 = 0, w1 = 0;
          if (!node_place(v, i, j, u0, w0)) continue;
          if (node_place(v, i + 1, j, u1, w1)) {
            widest_planes_px = std::max(widest_planes_px, std::hypot(u1 - u0, w1 - w0));
            ++pairs;
          }
          if (node_place(v, i, j + 1, u1, w1)) {
            widest_rows_px = std::max(widest_rows_px, std::hypot(u1 - u0, w1 - w0));
          }
        }
      }
      EXPECT_LE(widest_planes_px, v.spacing.planes_px * 1.001) << words(attitude, image);
      EXPECT_LE(widest_rows_px, v.spacing.rows_px * 1.001) << words(attitude, image);
    }
  }
  EXPECT_GT(pairs, 10'000);
}

TEST(PolarGrid, a_picture_without_ground_near_the_horizon_uses_no_grid) {
  const View v = view({0, -90, 0}, {100, 100, 30}, {3.0, 1.5});
  EXPECT_FALSE(v.grid.used);
}

TEST(PolarGrid, index_and_value_are_inverse_to_each_other) {
  const View v = view({12, -8, 77}, {200, 160, 60}, {3.0, 1.5});
  ASSERT_TRUE(v.grid.used);
  for (int j = 0; j < v.grid.row_count; ++j) {
    EXPECT_NEAR(v.grid.row_of_slope(v.grid.row_slope(j)), j, 1e-6);
  }
  for (int i = 0; i < v.grid.plane_count; ++i) {
    EXPECT_NEAR(plane_of_azimuth(v.grid, v.grid.plane_azimuth_rad(i)), i, 1e-6);
  }
  EXPECT_NEAR(v.grid.row_slope(0), v.grid.slope_low, 1e-12);
  EXPECT_NEAR(v.grid.row_slope(v.grid.row_count - 1), v.grid.slope_high, 1e-9);
}

}  // namespace
}  // namespace ridgeline
