#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace ridgeline::test {

/// What goes into a GeoTIFF that a test writes. The defaults are a good small tile: 31 x 31 posts
/// at 2', from 46 N 8 E to 47 N 9 E, as pixel-is-area raster with its corner half a pixel outside.
struct GeotiffRecipe {
  int columns = 31;
  int rows = 31;
  std::array<double, 6> corner_and_steps = {8 - 1.0 / 60, 1.0 / 30, 0, 47 + 1.0 / 60, 0, -1.0 / 30};
  std::string system = "EPSG:4326";  ///< anything OSRSetFromUserInput takes; empty: none
  std::string type = "Int16";        ///< GDAL's name
  std::optional<double> no_data;
  std::optional<double> scale;
  std::optional<double> offset_m;
  std::string unit;
  int bands = 1;
  std::vector<std::string> options;  ///< creation options, e.g. COMPRESS=DEFLATE
  std::vector<double> samples;  ///< rows x columns, first row first; empty: no sample is written
  std::vector<unsigned char> mask;  ///< as samples; 0 hides the post; empty: no mask
  bool pixel_is_point = false;
};

/// Writes the file through GDAL, or aborts the test program.
void write_geotiff(const std::string& path, const GeotiffRecipe& recipe);

}  // namespace ridgeline::test
