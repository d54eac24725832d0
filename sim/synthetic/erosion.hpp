#pragma once
#include <vector>

namespace ridgeline::sim {

/// A square-celled map, row-major, row 0 = south.
struct Field {
  int rows = 0;
  int columns = 0;
  std::vector<double> values;

  Field(int row_count, int column_count, double value = 0)
      : rows(row_count),
        columns(column_count),
        values(static_cast<std::size_t>(row_count) * static_cast<std::size_t>(column_count),
               value) {}
  [[nodiscard]] double& at(int row, int column) { return values[index(row, column)]; }
  [[nodiscard]] double at(int row, int column) const { return values[index(row, column)]; }
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// What shapes a landscape: rock rising against rivers cutting.
struct ErosionLaw {
  double cell_m = 0;      ///< edge of a cell
  double step_years = 0;  ///< time of one step; the update is implicit, so any step is stable
  double erodibility_per_year = 0;
  double talus_slope = 0;  ///< steepest slope that loose rock holds, rise over run
};

/// Lifts and erodes `height_m` by `steps` steps; returns the drained area per cell (m²) of the last
/// one. Cells with `uplift_mpy` < 0 are sea: they keep their height and every river ends in them.
/// Domain: both fields of one size, all border cells sea.
/// Error:  the same bits on every IEEE-754 machine (only + - * / and sqrt; ties are broken by
/// index). Cost:   O(steps · n log n) in n cells. Source: stream-power law with exponents m = 1/2,
/// n = 1, solved implicitly from the sea upstream:
///         Braun & Willett (2013), doi:10.1016/j.geomorph.2012.10.008; depressions are routed by
///         priority flood: Barnes et al. (2014), doi:10.1016/j.cageo.2013.04.024.
Field erode(Field& height_m, const Field& uplift_mpy, const ErosionLaw& law, int steps);

/// Widens valleys to a U: near a river that drains `area`, no slope rises above a parabola over the
/// river bed.
void carve_valleys(Field& height_m, const Field& drained_area_m2, double cell_m);

/// The field at twice the resolution (2n - 1 cells a side), linear between the old cells.
Field doubled(const Field& field);

}  // namespace ridgeline::sim
