#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace ridgeline::test {

/// A geoid as GeographicLib stores it: rows from 90 N, columns from 0 E.
/// `sample(row, column)` is the raw number, row 0 = NORTH; N = offset_m + scale_m * sample.
std::vector<std::byte> geoid_pgm_bytes(int columns, int rows, const std::string& offset_m,
                                       const std::string& scale_m,
                                       const std::function<unsigned(int row, int column)>& sample);

/// Where the posts of a GTX grid stand, as its header says it.
struct GtxPlace {
  double south_deg = 0;
  double west_deg = 0;
  double latitude_step_deg = 0;
  double longitude_step_deg = 0;
  int rows = 0;
  int columns = 0;
};

/// A geoid as PROJ stores it. `post_m(row, column)`, row 0 = SOUTH. Units: m.
std::vector<std::byte> geoid_gtx_bytes(const GtxPlace& place,
                                       const std::function<float(int row, int column)>& post_m);

}  // namespace ridgeline::test
