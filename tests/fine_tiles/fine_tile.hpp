#pragma once
#include <cstdint>
#include <string>

#include "sim/output/outcome.hpp"
#include "tests/fine_tiles/source_mosaic.hpp"

namespace ridgeline::fine {

/// A block of one-degree cells to fill, with its south-west corner.
/// Frame: WGS 84; columns run on across the antimeridian.
struct Place {
  int south_deg = 0;
  int west_deg = 0;
  int rows = 1;
  int columns = 1;
};

/// Most cells of a block: 64 tiles of 1/3" are 15 GB.
inline constexpr int most_fine_cells = 64;

/// What is wrong with a place; empty where it is good: south -90..89, west -180..179, no row beyond
/// the pole, 1 to most_fine_cells cells.
[[nodiscard]] std::string wrong_with(const Place& place);

/// One cell of a mosaic, as it is or mirrored.
struct MirroredCell {
  int cell_row = 0;
  int cell_column = 0;
  bool flip_rows = false;     ///< mirrored from north to south
  bool flip_columns = false;  ///< mirrored from east to west
};

/// The cell of the mosaic that stands in a row and column of the place. The mosaic lies at the
/// south-west corner and is mirrored at each of its own edges, so that neighbours share their posts
/// there as well.
[[nodiscard]] MirroredCell cell_of(const SourceMosaic& mosaic, int row, int column);

/// Writes one tile of mosaic.intervals * factor + 1 posts a side as .hgt, row by row: the posts of
/// the source where it has some, refined posts (RefinedRows, once for 3, twice for 9) between,
/// rounded to whole metres, at least lowest_post_m and at most highest_post_m.
/// Domain: factor 3 or 9, else RL_ASSERT.
/// Error:  Fault::file_unwritable with the system's reason; no part of a file is left.
/// Cost:   a few rows of memory; about 4 s for 10801 x 10801 posts.
[[nodiscard]] sim::Outcome write_fine_tile(const std::string& path, const SourceMosaic& mosaic,
                                           const MirroredCell& cell, int factor,
                                           std::uint64_t seed);

/// Fills a place with tiles in `folder` (made where missing) and writes GENERATED.txt, which says
/// what they were made from and how. The file is written first: no tile lies there without it.
/// Domain: as write_fine_tile(), and wrong_with(place) empty.
[[nodiscard]] sim::Outcome write_fine_block(const std::string& folder, const SourceMosaic& mosaic,
                                            const Place& place, int factor, std::uint64_t seed);

}  // namespace ridgeline::fine
