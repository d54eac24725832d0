#pragma once
#include <limits>
#include <string>
#include <vector>

#include "tests/oracle/grid.hpp"

namespace ridgeline::oracle {

/// One tile as the file has it. Posts are points.
/// Units: m above the file's vertical datum; NaN = void.
struct Tile : Grid {
  std::string name;          ///< file name, for messages
  std::vector<float> posts;  ///< rows x columns, row-major from the south
  bool is_sea = false;       ///< stated by a coverage list, not read from a file

  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] float& at(int row, int column) { return posts[index(row, column)]; }
  [[nodiscard]] float at(int row, int column) const { return posts[index(row, column)]; }
};

inline constexpr float void_post = std::numeric_limits<float>::quiet_NaN();

}  // namespace ridgeline::oracle
