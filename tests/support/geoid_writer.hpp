#pragma once
#include <string>

namespace ridgeline::test {

/// Cells of one degree, ends excluded.
struct CellRange {
  int south_deg = 0, north_deg = 0, west_deg = 0, east_deg = 0;
};

/// A number in 0..1 that depends on a post alone, to the arc second.
double lottery(double latitude_deg, double longitude_deg);

/// A geoid of half degrees (PROJ .gtx) over a range of cells: `least_m` and up to `more_m` on top.
/// Aborts the test program where it cannot be written.
void write_geoid(const std::string& file, const CellRange& cells, double least_m, double more_m);

}  // namespace ridgeline::test
