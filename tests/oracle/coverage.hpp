#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "tests/oracle/tile.hpp"

namespace ridgeline::oracle {

/// The cells of a coverage list, which an installer states to be sea where there is no tile file:
/// in order of their corners, each once. A line of it reads `sea N46E008`, in any case; `#` starts
/// a comment. Errors: InputError naming the file and the line.
[[nodiscard]] std::vector<DegreeCell> read_coverage(const std::filesystem::path& file);
/// The same for the text of a file.
[[nodiscard]] std::vector<DegreeCell> coverage_in(const std::filesystem::path& file,
                                                  std::string_view text);

/// Steps of posts in a degree; those of 3" unless said otherwise.
struct StepsPerDegree {
  int lat = 1200;
  int lon = 1200;
};

/// The finest steps in latitude and in longitude among grids, as whole parts of a degree. Where a
/// grid is so coarse, or there is none, that a degree would have no step, they are 3".
/// Domain: no finer than 0.1"; finer grids count as that.
[[nodiscard]] StepsPerDegree finest_steps(const std::vector<Grid>& grids);

/// A cell of sea as a tile of posts 0 m above the datum.
[[nodiscard]] Tile sea_tile(const DegreeCell& cell, const StepsPerDegree& steps);

/// Whether a grid of posts holds part of the inside of a cell. A grid that ends within a thousandth
/// of a step of the cell's edge does not.
[[nodiscard]] bool reaches_into(const Grid& grid, const DegreeCell& cell);

}  // namespace ridgeline::oracle
