#include "sim/methods/loffler_grid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ridgeline::sim {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double off_axis_rad = 75.0 * rad_per_deg;  ///< farthest a footprint point may lie
constexpr double least_depth = 0.1;   ///< of a point's distance: points behind are drawn to it
constexpr double margin = 0.01;       ///< of the rectangle, added on every side
constexpr int row_rounds = 6;         ///< repetitions of the row pass; four would do
constexpr double least_share = 1e-3;  ///< of the mean importance, for cells of no size
constexpr double least_extent_m = 1e-3;

/// New places that share the sum of `mass` equally; old[k]..old[k + 1] holds mass[k].
template <std::size_t Cells>
std::array<double, Cells + 1> equal_shares(const std::array<double, Cells + 1>& old,
                                           std::array<double, Cells> mass) {
  double total = 0;
  for (const double m : mass) total += m;
  const double floor = least_share * total / Cells;
  total = 0;
  for (double& m : mass) {
    m = std::max(m, floor);
    total += m;
  }
  std::array<double, Cells + 1> result = old;
  std::size_t cell = 0;
  double before = 0;
  for (std::size_t k = 1; k < Cells; ++k) {
    const double wanted = total * static_cast<double>(k) / Cells;
    while (cell + 1 < Cells && before + mass[cell] < wanted) before += mass[cell++];
    const double part = std::clamp((wanted - before) / mass[cell], 0.0, 1.0);
    result[k] = old[cell] + part * (old[cell + 1] - old[cell]);
  }
  return result;
}

}  // namespace

glm::dvec2 Projector::ground_m(glm::dvec2 view) const {
  const glm::dvec3 ray = ahead + view.x * right + view.y * upward;
  const double across = std::hypot(ray.x, ray.y);
  const double scale =
      -ray.z * range_m > base_m * across ? base_m / -ray.z : range_m / std::max(across, 1e-9);
  return {scale * ray.x, scale * ray.y};
}

Projector projector_over(const Attitude& attitude, double base_m, double range_m,
                         std::span<const glm::dvec2> footprint) {
  const double heading = attitude.heading_deg * rad_per_deg;
  const glm::dvec2 forward{std::sin(heading), std::cos(heading)};
  const glm::dvec2 aside{forward.y, -forward.x};
  double lowest = 0, highest = -std::numbers::pi;
  for (const glm::dvec2& point : footprint) {
    const double angle = std::atan2(-base_m, glm::dot(point, forward));
    lowest = std::min(lowest, angle);
    highest = std::max(highest, angle);
  }
  double pitch = attitude.pitch_deg * rad_per_deg;
  const double least = highest - off_axis_rad, most = lowest + off_axis_rad;
  pitch = least <= most ? std::clamp(pitch, least, most) : 0.5 * (least + most);

  Projector p;
  p.base_m = base_m;
  p.range_m = range_m;
  const double c = std::cos(pitch), s = std::sin(pitch);
  p.right = {aside.x, aside.y, 0};
  p.ahead = {c * forward.x, c * forward.y, s};
  p.upward = {-s * forward.x, -s * forward.y, c};
  ViewRect& r = p.rect;
  r = {1e9, -1e9, 1e9, -1e9};
  for (const glm::dvec2& point : footprint) {
    const glm::dvec3 way{point.x, point.y, -base_m};
    const double depth = std::max(glm::dot(way, p.ahead), least_depth * glm::length(way));
    const double x = glm::dot(way, p.right) / depth, y = glm::dot(way, p.upward) / depth;
    r.left = std::min(r.left, x);
    r.right = std::max(r.right, x);
    r.bottom = std::min(r.bottom, y);
    r.top = std::max(r.top, y);
  }
  const double x_margin = margin * (r.right - r.left), y_margin = margin * (r.top - r.bottom);
  r.left -= x_margin;
  r.right += x_margin;
  r.bottom -= y_margin;  // not at the top: that is where the range ends
  return p;
}

void CoarseGrid::spread(const Projector& projector) {
  const ViewRect& r = projector.rect;
  for (int row = 0; row <= cells; ++row) {
    const double y = r.bottom + (r.top - r.bottom) * row / cells;
    for (int column = 0; column <= cells; ++column) {
      vertex(column, row) = {r.left + (r.right - r.left) * column / cells, y};
    }
  }
}

void CoarseGrid::warp(const Projector& projector) {
  for (int round = 0; round < row_rounds; ++round) warp_rows(projector);
  warp_columns(projector);
}

CoarseGrid::Extent CoarseGrid::extent(const Projector& projector, int column, int row) const {
  const glm::dvec2 sw = projector.ground_m(vertex(column, row));
  const glm::dvec2 se = projector.ground_m(vertex(column + 1, row));
  const glm::dvec2 nw = projector.ground_m(vertex(column, row + 1));
  const glm::dvec2 ne = projector.ground_m(vertex(column + 1, row + 1));
  return {std::max(0.5 * (glm::distance(sw, nw) + glm::distance(se, ne)), least_extent_m),
          std::max(0.5 * (glm::distance(sw, se) + glm::distance(nw, ne)), least_extent_m)};
}

void CoarseGrid::warp_rows(const Projector& projector) {
  std::array<double, cells> importance{};
  std::array<double, cells + 1> y{};
  for (int row = 0; row <= cells; ++row) y[row] = vertex(0, row).y;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const Extent e = extent(projector, column, row);
      importance[row] += e.length_m / e.width_m / cells;
    }
  }
  const auto warped = equal_shares<cells>(y, importance);
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      vertex(column, row).y = static_cast<float>(warped[row]);
    }
  }
}

void CoarseGrid::warp_columns(const Projector& projector) {
  std::array<std::array<double, cells>, cells> importance{};
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const Extent e = extent(projector, column, row);
      importance[row][column] = e.width_m / e.length_m;
    }
  }
  for (int row = 0; row <= cells; ++row) {
    const auto& below = importance[std::max(row - 1, 0)];
    const auto& above = importance[std::min(row, cells - 1)];
    std::array<double, cells> mean{};
    std::array<double, cells + 1> x{};
    for (int column = 0; column < cells; ++column) {
      mean[column] = 0.5 * (below[column] + above[column]);
    }
    for (int column = 0; column <= cells; ++column) x[column] = vertex(column, row).x;
    const auto warped = equal_shares<cells>(x, mean);
    for (int column = 0; column <= cells; ++column) {
      vertex(column, row).x = static_cast<float>(warped[column]);
    }
  }
}

glm::dvec2 CoarseGrid::view_at(double across, double along) const {
  const double u = std::clamp(across, 0.0, 1.0) * cells, v = std::clamp(along, 0.0, 1.0) * cells;
  const int column = std::min(static_cast<int>(u), cells - 1);
  const int row = std::min(static_cast<int>(v), cells - 1);
  const double fx = u - column, fy = v - row;
  return (1 - fy) * ((1 - fx) * glm::dvec2(vertex(column, row)) +
                     fx * glm::dvec2(vertex(column + 1, row))) +
         fy * ((1 - fx) * glm::dvec2(vertex(column, row + 1)) +
               fx * glm::dvec2(vertex(column + 1, row + 1)));
}

}  // namespace ridgeline::sim
