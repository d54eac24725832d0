#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "platform/file_result.hpp"
#include "sim/synthetic/tile_writer.hpp"

namespace ridgeline::fine {

/// A post without data, as the files store it.
inline constexpr std::int16_t void_post = -32768;
/// Steps of a 3" tile.
inline constexpr int source_intervals = 1200;
/// Most one-degree cells of a mosaic; 64 cells of 3" are 184 MB.
inline constexpr int most_source_cells = 64;

/// Neighbouring one-degree tiles as one field of posts; a post on a common edge is there once.
/// Frame: row 0 is the south edge, column 0 the west one. Units: m above the tiles' datum.
struct SourceMosaic {
  int cell_rows = 0;
  int cell_columns = 0;
  int intervals = 0;                  ///< steps of one cell; posts of a cell less one
  std::vector<std::int16_t> posts_m;  ///< rows() x columns(), row by row
  std::string made_from;              ///< what GENERATED.txt says about the source

  [[nodiscard]] int rows() const { return cell_rows * intervals + 1; }
  [[nodiscard]] int columns() const { return cell_columns * intervals + 1; }
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] std::int16_t post_m(int row, int column) const {
    return posts_m[index(row, column)];
  }
};

/// All .hgt tiles of a folder (3", no sub-folders) as one mosaic. Where two tiles disagree about a
/// post of their common edge, the taller one counts; a void one counts least.
/// Domain: a tile that is not 3" is tile_size_mismatch, one whose name says no place
///         tile_name_unknown; tiles that do not fill a rectangle of cells are file_malformed (the
///         message names a missing cell); more than most_source_cells are too_many_tiles.
FileResult<SourceMosaic> mosaic_of_folder(const std::string& folder);

/// A mosaic of cells whose posts are asked from a function, rounded to whole metres.
/// Domain: 1 to most_source_cells cells, at least 2 intervals, else RL_ASSERT.
SourceMosaic mosaic_of_function(const sim::HeightFunction& height_m, int south_deg, int west_deg,
                                int cell_rows, int cell_columns, int intervals);

/// The synthetic island of sim/synthetic, four cells.
SourceMosaic synthetic_mosaic(int intervals);

}  // namespace ridgeline::fine
