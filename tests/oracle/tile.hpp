#pragma once
#include <limits>
#include <string>
#include <vector>

namespace ridgeline::oracle {

/// One tile as the file has it. Posts are points; row 0 is the SOUTH row, column 0 the WEST column.
/// Units: degrees (WGS 84); heights in m above the file's vertical datum; NaN = void.
struct Tile {
  std::string name;  ///< file name, for messages
  double south_deg = 0;
  double west_deg = 0;  ///< [-180, 180)
  double lat_step_deg = 0;
  double lon_step_deg = 0;
  int rows = 0;
  int columns = 0;
  std::vector<float> posts;  ///< rows x columns, row-major from the south

  [[nodiscard]] double north_deg() const { return south_deg + (rows - 1) * lat_step_deg; }
  [[nodiscard]] double east_deg() const { return west_deg + (columns - 1) * lon_step_deg; }
  [[nodiscard]] float& at(int row, int column) {
    return posts[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  }
  [[nodiscard]] float at(int row, int column) const {
    return posts[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  }
};

inline constexpr float void_post = std::numeric_limits<float>::quiet_NaN();

}  // namespace ridgeline::oracle
