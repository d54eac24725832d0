#include "core/geo/polar_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int segment_count = limits::grid_segments;
constexpr double steepest_slope = 1.0;  ///< |tan elevation| beyond which pixels are ray cast
constexpr double border_step_px = 8.0;

struct Extent {
  double low = 1e30, high = -1e30;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

bool inside_picture(const Camera& camera, const glm::dvec3& direction_enu, double margin_px) {
  const glm::dvec3 c = glm::transpose(camera.enu_from_camera.columns) * direction_enu;
  if (c.z <= 0) return false;
  const double u = camera.cx + camera.fx * c.x / c.z;
  const double v = camera.cy + camera.fy * c.y / c.z;
  return u >= -margin_px && u <= camera.width_px + margin_px && v >= -margin_px &&
         v <= camera.height_px + margin_px;
}

/// Azimuth and slope extent of the picture grown by `margin_px`, from its border.
void border_extent(const Camera& camera, double margin_px, Extent& azimuth, Extent& slope) {
  const double u0 = -margin_px, u1 = camera.width_px + margin_px;
  const double v0 = -margin_px, v1 = camera.height_px + margin_px;
  const double length = 2 * (u1 - u0 + v1 - v0);
  const int count = static_cast<int>(std::ceil(length / border_step_px));
  double previous = 0;
  for (int i = 0; i <= count; ++i) {
    double d = length * i / count;
    double u = u0, v = v0;
    if (d < u1 - u0) {
      u = u0 + d;
    } else if ((d -= u1 - u0) < v1 - v0) {
      u = u1, v = v0 + d;
    } else if ((d -= v1 - v0) < u1 - u0) {
      u = u1 - d, v = v1;
    } else {
      v = v1 - (d - (u1 - u0));
    }
    const glm::dvec3 ray = camera.ray(u, v).xyz;
    double a = std::atan2(ray.x, ray.y);
    if (i > 0) a += 2 * pi * std::round((previous - a) / (2 * pi));
    previous = a;
    azimuth.add(a);
    slope.add(std::clamp(ray.z / std::hypot(ray.x, ray.y), -steepest_slope, steepest_slope));
  }
}

/// Range of cos(angle to the camera axis) over a cell of azimuths and elevations.
struct AxisCosine {
  double low = 1, high = -1;
};

AxisCosine axis_cosine(const glm::dvec3& forward, double azimuth0, double azimuth1, double e0,
                       double e1) {
  const double horizontal = std::hypot(forward.x, forward.y);
  const double axis_azimuth = std::atan2(forward.x, forward.y);
  const double half = 0.5 * (azimuth1 - azimuth0);
  const double off = std::abs(std::remainder(0.5 * (azimuth0 + azimuth1) - axis_azimuth, 2 * pi));
  const double a_high = horizontal * std::cos(std::max(0.0, off - half));
  const double a_low = horizontal * std::cos(std::min(pi, off + half));
  AxisCosine range;
  for (const double a : {a_low, a_high}) {
    for (const double e : {e0, e1}) {
      const double c = a * std::cos(e) + forward.z * std::sin(e);
      range.low = std::min(range.low, c);
      range.high = std::max(range.high, c);
    }
    const double peak = std::atan2(forward.z, a);  // the sinusoid's crest, and its trough at +pi
    if (peak > e0 && peak < e1) range.high = std::max(range.high, std::hypot(a, forward.z));
    if (peak + pi < e1 || peak - pi > e0) range.low = -1;
  }
  return range;
}

/// Turns needed densities into indices that start at 0 and end at a whole number.
int number_segments(PolarGrid::Segments& segments, double segment_width) {
  double total = 0;
  for (const auto& s : segments) total += s.density * segment_width;
  const int count = static_cast<int>(std::ceil(total));
  double index = 0;
  for (auto& s : segments) {
    s.density *= count / total;
    s.first_index = index;
    index += s.density * segment_width;
  }
  return count;
}

double value_of_index(const PolarGrid::Segments& segments, double start, double segment_width,
                      double index) {
  int k = 0;
  while (k + 1 < segment_count && segments[k + 1].first_index <= index) ++k;
  return start + k * segment_width + (index - segments[k].first_index) / segments[k].density;
}

/// Fills both density tables: the largest pixels per rad over the visible part of each strip.
void set_densities(const Camera& camera, const GridSpacing& spacing, PolarGrid& grid) {
  const glm::dvec3 forward = camera.enu_from_camera.columns[2];
  const double edge_cosine = std::cos(camera.half_diagonal_rad(grid.margin_px));
  const double focal = std::max(camera.fx, camera.fy);
  const double azimuth_width = grid.azimuth_span_rad / segment_count;
  const double slope_width = (grid.slope_high - grid.slope_low) / segment_count;
  for (int k = 0; k < segment_count; ++k) {
    grid.planes[k].density = 1.0 / azimuth_width;
    grid.rows[k].density = 1.0 / slope_width;
  }
  for (int j = 0; j < segment_count; ++j) {
    const double s0 = grid.slope_low + j * slope_width;
    const double e0 = std::atan(s0), e1 = std::atan(s0 + slope_width);
    const double cos_e = e0 < 0 && e1 > 0 ? 1.0 : std::max(std::cos(e0), std::cos(e1));
    for (int i = 0; i < segment_count; ++i) {
      const double a0 = grid.azimuth_start_rad + i * azimuth_width;
      const AxisCosine c = axis_cosine(forward, a0, a0 + azimuth_width, e0, e1);
      if (c.high < edge_cosine) continue;  // not in the picture
      const double nearest = std::max(c.low, edge_cosine);
      const double px_per_rad = focal / (nearest * nearest);
      auto& plane = grid.planes[i].density;
      auto& row = grid.rows[j].density;
      plane = std::max(plane, px_per_rad * cos_e / spacing.planes_px);
      row = std::max(row, px_per_rad * cos_e * cos_e / spacing.rows_px);
    }
  }
}

}  // namespace

double PolarGrid::plane_azimuth_rad(int plane) const {
  return value_of_index(planes, azimuth_start_rad, azimuth_span_rad / segment_count, plane);
}

double PolarGrid::row_slope(int row) const {
  return value_of_index(rows, slope_low, (slope_high - slope_low) / segment_count, row);
}

double PolarGrid::row_of_slope(double slope) const {
  const double width = (slope_high - slope_low) / segment_count;
  const int k = std::clamp(static_cast<int>((slope - slope_low) / width), 0, segment_count - 1);
  return rows[k].first_index + (slope - slope_low - k * width) * rows[k].density;
}

PolarGrid polar_grid(const Camera& camera, const GridSpacing& spacing) {
  PolarGrid grid;
  grid.margin_px = 3.0 * std::max(spacing.planes_px, spacing.rows_px) + 2.0;
  const double margin_px = grid.margin_px;
  Extent azimuth, slope;
  border_extent(camera, margin_px, azimuth, slope);
  const double pole_margin_px = margin_px + 2 * border_step_px;
  const bool nadir = inside_picture(camera, {0, 0, -1}, pole_margin_px);
  const bool zenith = inside_picture(camera, {0, 0, 1}, pole_margin_px);
  if (nadir) slope.add(-steepest_slope);
  if (zenith) slope.add(steepest_slope);
  if (slope.high - slope.low < 1e-6) return grid;
  grid.slope_low = slope.low;
  grid.slope_high = slope.high;
  grid.full_circle = nadir || zenith || azimuth.high - azimuth.low > 1.9 * pi;
  grid.azimuth_start_rad = grid.full_circle ? -pi : azimuth.low;
  grid.azimuth_span_rad = grid.full_circle ? 2 * pi : azimuth.high - azimuth.low;
  set_densities(camera, spacing, grid);
  const int planes = number_segments(grid.planes, grid.azimuth_span_rad / segment_count);
  const int rows = number_segments(grid.rows, (grid.slope_high - grid.slope_low) / segment_count);
  grid.plane_count = grid.full_circle ? planes : planes + 1;
  grid.row_count = rows + 1;
  grid.used = true;
  return grid;
}

RowRange visible_rows(const Camera& camera, const PolarGrid& grid, double azimuth_rad) {
  // Along a plane the direction is linear in the slope, so each side of the picture cuts the
  // plane in one slope: direction(s) = (sin a, cos a, s); side: n . (camera axes of direction) >=
  // 0.
  const double margin_px = grid.margin_px;
  const glm::dmat3 camera_from_enu = glm::transpose(camera.enu_from_camera.columns);
  const glm::dvec3 base =
      camera_from_enu * glm::dvec3(std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
  const glm::dvec3 per_slope = camera_from_enu * glm::dvec3(0.0, 0.0, 1.0);
  const double x = (camera.cx + margin_px) / camera.fx;
  const double x1 = (camera.width_px - camera.cx + margin_px) / camera.fx;
  const double y = (camera.cy + margin_px) / camera.fy;
  const double y1 = (camera.height_px - camera.cy + margin_px) / camera.fy;
  double low = grid.slope_low, high = grid.slope_high;
  for (const glm::dvec3 side :
       {glm::dvec3(1, 0, x), glm::dvec3(-1, 0, x1), glm::dvec3(0, 1, y), glm::dvec3(0, -1, y1)}) {
    const double constant = glm::dot(side, base), rate = glm::dot(side, per_slope);
    if (std::abs(rate) < 1e-12) {
      if (constant < 0) return {};
    } else if (rate > 0) {
      low = std::max(low, -constant / rate);
    } else {
      high = std::min(high, -constant / rate);
    }
  }
  if (low > high) return {};
  const int first = static_cast<int>(std::floor(grid.row_of_slope(low))) - 1;
  const int last = static_cast<int>(std::ceil(grid.row_of_slope(high))) + 1;
  return {std::max(first, 0), std::min(last, grid.row_count - 1)};
}

}  // namespace ridgeline
