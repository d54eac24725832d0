#include "tests/fine_tiles/fine_tile.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "core/base/assert.hpp"
#include "core/terrain/height_tile.hpp"
#include "sim/output/atomic_file.hpp"
#include "tests/fine_tiles/post_rows.hpp"

namespace ridgeline::fine {
namespace {

/// The refined posts of one cell, not mirrored.
class CellRows {
 public:
  CellRows(const SourceMosaic& mosaic, int cell_column, int factor, std::uint64_t seed) {
    RL_ASSERT(factor == 3 || factor == 9);
    const int side = mosaic.intervals * factor;
    const ColumnRange fine{cell_column * side, (cell_column + 1) * side};
    const ColumnRange middle =
        factor == 3 ? fine : RefinedRows::coarse_columns(fine, 3 * (mosaic.columns() - 1) + 1);
    source_ =
        std::make_unique<MosaicRows>(mosaic, RefinedRows::coarse_columns(middle, mosaic.columns()));
    middle_ = std::make_unique<RefinedRows>(*source_, middle, seed);
    if (factor == 9) fine_ = std::make_unique<RefinedRows>(*middle_, fine, seed + 1);
  }

  std::span<const float> row(int row) { return fine_ ? fine_->row(row) : middle_->row(row); }

 private:
  std::unique_ptr<MosaicRows> source_;
  std::unique_ptr<RefinedRows> middle_;
  std::unique_ptr<RefinedRows> fine_;
};

int stored_m(float height_m) {
  if (std::isnan(height_m)) return void_post;
  const auto known_m = static_cast<double>(std::clamp(height_m, lowest_post_m, highest_post_m));
  return sim::stored_height_m(known_m);
}

int mirrored_cell(int index, int count, bool& flipped) {
  const int within = index % (2 * count);
  flipped = within >= count;
  return flipped ? 2 * count - 1 - within : within;
}

int west_of(const Place& place, int column) {
  const int west_deg = place.west_deg + column;
  return west_deg > 179 ? west_deg - 360 : west_deg;
}

std::string generated_text(const SourceMosaic& mosaic, const Place& place, int factor,
                           std::uint64_t seed) {
  std::string text =
      "GENERATED terrain, made by ridgeline-fine-tiles for tests, not measured: heights between "
      "the\n"
      "posts of the source are invented, and tiles may stand elsewhere than their source.\n"
      "\n"
      "Source: " +
      mosaic.made_from + ".\nEvery step of the source was cut into " + std::to_string(factor) +
      ": source posts kept, between them a smooth surface and noise\nin proportion to the relief; "
      "a void of the source stays void. Seed " +
      std::to_string(seed) +
      ". Heights are whole metres above the\ndatum of the source. Nothing here may be used for "
      "navigation.\n\n";
  for (int row = 0; row < place.rows; ++row) {
    for (int column = 0; column < place.columns; ++column) {
      const MirroredCell cell = cell_of(mosaic, row, column);
      text += sim::tile_name(place.south_deg + row, west_of(place, column)) +
              ": source cell, row " + std::to_string(cell.cell_row) + " from the south, column " +
              std::to_string(cell.cell_column) + " from the west";
      if (cell.flip_rows) text += ", mirrored north to south";
      if (cell.flip_columns) text += ", mirrored east to west";
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::string wrong_with(const Place& place) {
  if (place.south_deg < -90 || place.south_deg > 89) return "south is not within -90..89";
  if (place.west_deg < -180 || place.west_deg > 179) return "west is not within -180..179";
  if (place.rows < 1 || place.columns < 1 || place.rows > most_fine_cells ||
      place.columns > most_fine_cells || place.rows * place.columns > most_fine_cells) {
    return "rows times columns is not within 1.." + std::to_string(most_fine_cells);
  }
  return place.south_deg + place.rows > 90 ? "the rows reach beyond the pole" : "";
}

MirroredCell cell_of(const SourceMosaic& mosaic, int row, int column) {
  MirroredCell cell;
  cell.cell_row = mirrored_cell(row, mosaic.cell_rows, cell.flip_rows);
  cell.cell_column = mirrored_cell(column, mosaic.cell_columns, cell.flip_columns);
  return cell;
}

sim::Outcome write_fine_tile(const std::string& path, const SourceMosaic& mosaic,
                             const MirroredCell& cell, int factor, std::uint64_t seed) {
  const std::string part = path + ".part";
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  CellRows rows(mosaic, cell.cell_column, factor, seed);
  const int side = mosaic.intervals * factor;
  std::vector<char> bytes(2 * static_cast<std::size_t>(side + 1));
  for (int k = 0; out && k <= side; ++k) {  // from north to south, as the file is
    const std::span<const float> posts_m =
        rows.row(cell.cell_row * side + (cell.flip_rows ? k : side - k));
    for (std::size_t column = 0; column < posts_m.size(); ++column) {
      const std::size_t from = cell.flip_columns ? posts_m.size() - 1 - column : column;
      const int stored = stored_m(posts_m[from]);
      bytes[2 * column] = static_cast<char>((stored >> 8) & 0xff);
      bytes[2 * column + 1] = static_cast<char>(stored & 0xff);
    }
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  out.close();
  if (out && std::rename(part.c_str(), path.c_str()) == 0) return {};
  const std::string reason = std::strerror(errno);
  std::remove(part.c_str());
  return sim::failed(Fault::file_unwritable, path, reason);
}

sim::Outcome write_fine_block(const std::string& folder, const SourceMosaic& mosaic,
                              const Place& place, int factor, std::uint64_t seed) {
  RL_ASSERT(wrong_with(place).empty());
  if (sim::Outcome made = sim::make_folder(folder); !made.ok()) return made;
  sim::Outcome written =
      sim::write_file(folder + "/GENERATED.txt", generated_text(mosaic, place, factor, seed));
  for (int row = 0; row < place.rows && written.ok(); ++row) {
    for (int column = 0; column < place.columns && written.ok(); ++column) {
      const std::string name = sim::tile_name(place.south_deg + row, west_of(place, column));
      written =
          write_fine_tile(folder + "/" + name, mosaic, cell_of(mosaic, row, column), factor, seed);
    }
  }
  return written;
}

}  // namespace ridgeline::fine
