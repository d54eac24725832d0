#pragma once
#include <filesystem>
#include <vector>

#include "tests/oracle/tile.hpp"

namespace ridgeline::oracle {

/// The cells of a coverage list, which an installer states to be sea where there is no tile file:
/// in order of their corners, each once. A line of it reads `sea N46E008`, in any case; `#` starts
/// a comment. Errors: InputError naming the file and the line.
[[nodiscard]] std::vector<DegreeCell> read_coverage(const std::filesystem::path& file);

/// A cell of sea as a tile: four posts of 0 m above the datum.
[[nodiscard]] Tile sea_tile(const DegreeCell& cell);

/// Whether a grid of posts holds part of the inside of a cell. A grid that ends within a thousandth
/// of a step of the cell's edge does not.
[[nodiscard]] bool reaches_into(const Grid& grid, const DegreeCell& cell);

}  // namespace ridgeline::oracle
