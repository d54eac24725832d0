#pragma once
#include <cmath>

#include "tests/fine_tiles/source_mosaic.hpp"

namespace ridgeline::fine {

/// Steps of a cell of the small mosaics: divides 1, so that posts are found by whole numbers.
inline constexpr int small_intervals = 25;

/// Rough ground of whole metres from whole numbers, with a void disc where `holed`: the same on
/// every machine. Posts are those of small mosaics from 46 N 8 E on.
inline SourceMosaic small_mosaic(int cell_rows, int cell_columns, bool holed = false) {
  const auto height_m = [=](double latitude_deg, double longitude_deg) {
    const int y = static_cast<int>(std::lround((latitude_deg - 46) * small_intervals));
    const int x = static_cast<int>(std::lround((longitude_deg - 8) * small_intervals));
    if (holed && (x - 12) * (x - 12) + (y - 9) * (y - 9) < 8) return std::nan("");
    return static_cast<double>(800 + 13 * x - 7 * y + x * y % 17 * 40 + (x * x + 3 * y) % 11 * 25);
  };
  return mosaic_of_function(height_m, 46, 8, cell_rows, cell_columns, small_intervals);
}

}  // namespace ridgeline::fine
