#include "sim/synthetic/erosion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::sim {
namespace {

struct Neighbour {
  int row;
  int column;
  double distance_cells;
};
constexpr double diagonal = 1.4142135623730951;
constexpr std::array<Neighbour, 8> neighbours = {{{0, 1, 1},
                                                  {1, 0, 1},
                                                  {0, -1, 1},
                                                  {-1, 0, 1},
                                                  {1, 1, diagonal},
                                                  {1, -1, diagonal},
                                                  {-1, -1, diagonal},
                                                  {-1, 1, diagonal}}};

/// Where the water of every cell goes, and an order in which each cell follows its receiver.
struct Drainage {
  std::vector<int> order;
  std::vector<int> receiver;
  std::vector<double> distance_cells;
};

/// Steepest way down from `cell` over the water surface, among the cells that already drain to the
/// sea.
void choose_receiver(const Field& shape, const std::vector<double>& water_m,
                     const std::vector<char>& drained, int cell, Drainage& drainage) {
  const int row = cell / shape.columns;
  const int column = cell % shape.columns;
  double steepest = -1;
  for (const Neighbour& way : neighbours) {
    const int other = (row + way.row) * shape.columns + column + way.column;
    if (drained[other] == 0) continue;
    // Rock is uneven: a fixed chance per pair of cells keeps valleys from running along the grid.
    const double chance = static_cast<double>(lattice_hash(cell, other, 7) >> 40) / (1 << 24);
    const double slope = (water_m[cell] - water_m[other]) / way.distance_cells * (0.4 + chance);
    if (slope > steepest) {
      steepest = slope;
      drainage.receiver[cell] = other;
      drainage.distance_cells[cell] = way.distance_cells;
    }
  }
}

Drainage drain(const Field& height_m, const Field& uplift_mpy) {
  const std::size_t count = height_m.values.size();
  Drainage drainage{{}, std::vector<int>(count, -1), std::vector<double>(count, 1)};
  drainage.order.reserve(count);
  std::vector<double> water_m = height_m.values;
  std::vector<char> drained(count, 0);
  std::vector<char> queued(count, 0);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> shore;
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (uplift_mpy.values[cell] >= 0) continue;
    drained[cell] = queued[cell] = 1;
  }
  const auto spread = [&](int cell) {
    const int row = cell / height_m.columns;
    const int column = cell % height_m.columns;
    if (row == 0 || column == 0 || row == height_m.rows - 1 || column == height_m.columns - 1)
      return;
    for (const Neighbour& way : neighbours) {
      const int other = (row + way.row) * height_m.columns + column + way.column;
      if (queued[other] != 0) continue;
      queued[other] = 1;
      water_m[other] = std::max(water_m[other], water_m[cell] + 1e-4);
      shore.emplace(water_m[other], other);
    }
  };
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (uplift_mpy.values[cell] < 0) spread(static_cast<int>(cell));
  }
  while (!shore.empty()) {
    const int cell = shore.top().second;
    shore.pop();
    choose_receiver(height_m, water_m, drained, cell, drainage);
    drained[cell] = 1;
    drainage.order.push_back(cell);
    spread(cell);
  }
  return drainage;
}

}  // namespace

Field erode(Field& height_m, const Field& uplift_mpy, const ErosionLaw& law, int steps) {
  Field area_m2(height_m.rows, height_m.columns);
  for (int step = 0; step < steps; ++step) {
    const Drainage drainage = drain(height_m, uplift_mpy);
    std::fill(area_m2.values.begin(), area_m2.values.end(), law.cell_m * law.cell_m);
    for (auto cell = drainage.order.rbegin(); cell != drainage.order.rend(); ++cell) {
      area_m2.values[drainage.receiver[*cell]] += area_m2.values[*cell];
    }
    for (const int cell : drainage.order) {
      const double distance_m = drainage.distance_cells[cell] * law.cell_m;
      const double below_m = std::max(0.0, height_m.values[drainage.receiver[cell]]);
      const double cut =
          law.erodibility_per_year * law.step_years * std::sqrt(area_m2.values[cell]) / distance_m;
      const double lifted_m = height_m.values[cell] + uplift_mpy.values[cell] * law.step_years;
      const double cut_m = (lifted_m + cut * below_m) / (1 + cut);
      height_m.values[cell] = std::min(cut_m, below_m + law.talus_slope * distance_m);
    }
  }
  return area_m2;
}

void carve_valleys(Field& height_m, const Field& drained_area_m2, double cell_m) {
  constexpr double smallest_river_m2 = 12e6;
  const Field bed_m = height_m;
  for (int row = 0; row < height_m.rows; ++row) {
    for (int column = 0; column < height_m.columns; ++column) {
      const double area_m2 = drained_area_m2.at(row, column);
      if (area_m2 < smallest_river_m2 || bed_m.at(row, column) <= 0) continue;
      const double half_width_m = std::min(2200.0, 250 + 0.05 * std::sqrt(area_m2));
      const int reach = static_cast<int>(2 * half_width_m / cell_m) + 1;
      for (int r = std::max(0, row - reach); r <= std::min(height_m.rows - 1, row + reach); ++r) {
        for (int c = std::max(0, column - reach);
             c <= std::min(height_m.columns - 1, column + reach); ++c) {
          const double across =
              static_cast<double>((r - row) * (r - row) + (c - column) * (c - column)) * cell_m *
              cell_m / (half_width_m * half_width_m);
          if (across > 4) continue;
          const double wall_m = bed_m.at(row, column) + 0.28 * half_width_m * across * across;
          height_m.at(r, c) = std::min(height_m.at(r, c), wall_m);
        }
      }
    }
  }
}

Field doubled(const Field& field) {
  Field fine(2 * field.rows - 1, 2 * field.columns - 1);
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      const int r = row / 2;
      const int c = column / 2;
      const int r1 = r + row % 2;
      const int c1 = c + column % 2;
      fine.at(row, column) =
          0.25 * (field.at(r, c) + field.at(r, c1) + field.at(r1, c) + field.at(r1, c1));
    }
  }
  return fine;
}

}  // namespace ridgeline::sim
