// The grid of `loffler` by itself: what the warp is for, and that it stays a grid.
#include "sim/methods/loffler_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace ridgeline::test {
namespace {

using sim::CoarseGrid;
using sim::Projector;

/// The ground from `near_m` to `far_m` that a camera of 60 degrees sees on both sides of a heading.
std::vector<glm::dvec2> sector(double heading_deg, double near_m, double far_m) {
  std::vector<glm::dvec2> ground;
  for (double off_deg = -30; off_deg <= 30; off_deg += 5) {
    const double azimuth = (heading_deg + off_deg) * 3.14159265358979 / 180;
    const glm::dvec2 way{std::sin(azimuth), std::cos(azimuth)};
    ground.push_back(near_m * way);
    ground.push_back(far_m * way);
  }
  return ground;
}

/// Of ln(length / width).
struct Squareness {
  double mean = 0;         ///< of its absolute value, cell by cell
  double ground_mean = 0;  ///< the same, square metre by square metre of the ground
  double spread = 0;       ///< standard deviation, cell by cell
};

/// Of the cells that `columns` x `rows` vertices make, on the ground; those at the range, which
/// have no length, left out.
Squareness squareness(const Projector& projector, const CoarseGrid& grid, int columns, int rows) {
  std::vector<double> logs;
  double area = 0, of_area = 0;
  const auto ground = [&](int i, int j) {
    return projector.ground_m(grid.view_at(i / (columns - 1.0), j / (rows - 1.0)));
  };
  for (int j = 0; j + 1 < rows; j += 3) {
    for (int i = 0; i + 1 < columns; i += 7) {
      const glm::dvec2 p = ground(i, j);
      const double width = glm::distance(p, ground(i + 1, j));
      const double length = glm::distance(p, ground(i, j + 1));
      if (glm::length(ground(i, j + 1)) < 0.999 * projector.range_m) {
        logs.push_back(std::log(length / width));
        area += length * width;
        of_area += length * width * std::abs(logs.back());
      }
    }
  }
  Squareness s;
  s.ground_mean = of_area / area;
  double sum = 0, squares = 0;
  for (const double l : logs) {
    s.mean += std::abs(l) / static_cast<double>(logs.size());
    sum += l;
    squares += l * l;
  }
  const double n = static_cast<double>(logs.size());
  s.spread = std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0));
  return s;
}

struct View {
  const char* name;
  Attitude attitude;
  double base_m, near_m, far_m;
};

class Warp : public testing::TestWithParam<View> {};

TEST_P(Warp, makes_projected_cells_closer_to_square) {
  const View& view = GetParam();
  const auto ground = sector(view.attitude.heading_deg, view.near_m, view.far_m);
  const Projector projector = sim::projector_over(view.attitude, view.base_m, 100'000, ground);
  for (const auto& [columns, rows] : {std::pair{1024, 512}, {512, 256}, {400, 1900}}) {
    CoarseGrid uniform, warped;
    uniform.spread(projector);
    warped.spread(projector);
    warped.warp(projector);
    const Squareness before = squareness(projector, uniform, columns, rows);
    const Squareness after = squareness(projector, warped, columns, rows);
    std::printf(
        "[ warp ] %s, %d x %d: |ln aspect| %.2f -> %.2f a cell, %.2f -> %.2f by ground, "
        "spread %.2f -> %.2f\n",
        view.name, columns, rows, before.mean, after.mean, before.ground_mean, after.ground_mean,
        before.spread, after.spread);
    // Whatever the numbers of columns and rows: all alike. How near to square then depends on them:
    // a grid wider than high gets nearer by ground, where the uniform one has its few long cells,
    // the high one cell by cell.
    EXPECT_LT(after.spread, 0.5 * before.spread);
    if (rows > columns) {
      EXPECT_LT(after.mean, before.mean);
    } else {
      EXPECT_LT(after.ground_mean, before.ground_mean);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Views, Warp,
                         testing::Values(View{"low", {0, -4, 30}, 1500, 300, 100'000},
                                         View{"valley", {0, 0, 200}, 400, 100, 60'000},
                                         View{"high", {10, -10, 60}, 9000, 9000, 100'000},
                                         View{"banked", {-45, -3, 275}, 2500, 1000, 100'000}),
                         [](const auto& instance) { return instance.param.name; });

TEST(Grid, of_every_attitude_covers_its_footprint_and_does_not_fold) {
  for (double pitch_deg = -90; pitch_deg <= 60; pitch_deg += 15) {
    for (const double base_m : {50.0, 2000.0, 20'000.0}) {
      const auto ground = sector(70, 0.2 * base_m, 90'000);
      const Projector projector = sim::projector_over({33, pitch_deg, 70}, base_m, 100'000, ground);
      CoarseGrid grid;
      grid.spread(projector);
      grid.warp(projector);
      const glm::dvec2 first = grid.view_at(0, 0), last = grid.view_at(1, 1);
      EXPECT_NEAR(first.x, projector.rect.left, 1e-6);
      EXPECT_NEAR(first.y, projector.rect.bottom, 1e-6);
      EXPECT_NEAR(last.x, projector.rect.right, 1e-6);
      EXPECT_NEAR(last.y, projector.rect.top, 1e-6);
      for (int k = 0; k < CoarseGrid::cells; ++k) {
        const double here = k / 32.0, next = (k + 1) / 32.0;
        EXPECT_LT(grid.view_at(0.3, here).y, grid.view_at(0.3, next).y);
        EXPECT_LT(grid.view_at(here, 0.3).x, grid.view_at(next, 0.3).x);
      }
      for (const glm::dvec2& point : ground) {
        const glm::dvec3 way{point.x, point.y, -base_m};
        const double depth = glm::dot(way, projector.ahead);
        EXPECT_GT(depth, 0.09 * glm::length(way));
        const double x = glm::dot(way, projector.right) / depth;
        const double y = glm::dot(way, projector.upward) / depth;
        EXPECT_TRUE(x >= projector.rect.left && x <= projector.rect.right);
        EXPECT_TRUE(y >= projector.rect.bottom && y <= projector.rect.top);
      }
    }
  }
}

TEST(Grid, rays_that_miss_the_plane_end_at_the_range) {
  Projector projector;
  projector.base_m = 100;
  projector.range_m = 5000;
  EXPECT_NEAR(glm::length(projector.ground_m({0, 0.5})), 5000, 1e-6);
  EXPECT_NEAR(glm::length(projector.ground_m({0.3, -0.001})), 5000, 1e-6);
  EXPECT_NEAR(projector.ground_m({0, -0.1}).y, 1000, 1e-6);
}

}  // namespace
}  // namespace ridgeline::test
