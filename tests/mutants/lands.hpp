#pragma once
#include <string>

#include "sim/synthetic/tile_writer.hpp"
#include "tests/support/geoid_writer.hpp"

namespace ridgeline::test {

/// Writes cells as DTED level 0 (posts half a minute apart, the smallest tiles there are) or aborts
/// the test program. NaN is void.
void write_coarse_cells(const std::string& folder, const CellRange& cells,
                        const sim::HeightFunction& height_m);
/// One cell as a 3" tile.
void write_fine_cell(const std::string& folder, int south_deg, int west_deg,
                     const sim::HeightFunction& height_m);
/// Mountains of all sizes down to one post, from 0 to about 3200 m.
double rough_m(double latitude_deg, double longitude_deg);
/// The same with void islands and single void posts.
double rough_with_voids_m(double latitude_deg, double longitude_deg);
/// A plain at 300 m with a spire of one post, up to 2000 m high, on one in 300.
double spires_m(double latitude_deg, double longitude_deg);
/// A plain at 0 m between walls of one post's width, up to 3000 m high, along both axes.
double walls_m(double latitude_deg, double longitude_deg);
/// Sea level.
double sea_m(double latitude_deg, double longitude_deg);

}  // namespace ridgeline::test
