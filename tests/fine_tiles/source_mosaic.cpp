#include "tests/fine_tiles/source_mosaic.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>
#include <system_error>

#include "core/base/assert.hpp"
#include "core/terrain/hgt_tile.hpp"
#include "platform/mapped_file.hpp"
#include "sim/synthetic/synthetic_terrain.hpp"

namespace ridgeline::fine {
namespace {

namespace fs = std::filesystem;

struct SourceFile {
  std::string path;
  TileLocation location;
};

/// The .hgt files of the folder in the order of their names.
FileResult<std::vector<SourceFile>> files_of(const std::string& folder) {
  std::error_code error;
  std::vector<SourceFile> files;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::string extension = at->path().extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (extension == ".hgt") files.push_back({at->path().string(), {}});
  }
  if (error) return file_problem(folder, Fault::folder_unreadable, error.message());
  if (files.empty()) return file_problem(folder, Fault::folder_without_tiles, "no .hgt");
  if (files.size() > most_source_cells) return file_problem(folder, Fault::too_many_tiles, "");
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  for (SourceFile& file : files) {
    const auto location = hgt_location(fs::path(file.path).filename().string());
    if (!location.ok()) return file_problem(file.path, location.fault(), "");
    file.location = location.value();
  }
  return files;
}

/// The smallest rectangle of cells that holds the tiles.
struct Block {
  int south_deg = 90, west_deg = 180, north_deg = -91, east_deg = -181;
  [[nodiscard]] int cell_rows() const { return north_deg - south_deg + 1; }
  [[nodiscard]] int cell_columns() const { return east_deg - west_deg + 1; }
};

FileResult<Block> block_of(const std::string& folder, const std::vector<SourceFile>& files) {
  Block block;
  std::set<std::pair<int, int>> cells;
  for (const SourceFile& file : files) {
    const TileLocation& at = file.location;
    block.south_deg = std::min(block.south_deg, at.south_deg);
    block.north_deg = std::max(block.north_deg, at.south_deg);
    block.west_deg = std::min(block.west_deg, at.west_deg);
    block.east_deg = std::max(block.east_deg, at.west_deg);
    if (!cells.insert({at.south_deg, at.west_deg}).second) {
      return file_problem(file.path, Fault::file_malformed, "a second tile of its cell");
    }
  }
  for (int south = block.south_deg; south <= block.north_deg; ++south) {
    for (int west = block.west_deg; west <= block.east_deg; ++west) {
      if (cells.contains({south, west})) continue;
      return file_problem(
          folder, Fault::file_malformed,
          "the tiles do not fill a rectangle: " + sim::tile_name(south, west) + " is missing");
    }
  }
  return block;
}

SourceMosaic empty_mosaic(int cell_rows, int cell_columns, int intervals) {
  SourceMosaic mosaic{cell_rows, cell_columns, intervals, {}, {}};
  mosaic.posts_m.assign(mosaic.index(mosaic.rows(), 0), void_post);
  return mosaic;
}

/// Copies a tile to its cell; what is there already stays where it is taller.
FileProblem add_tile(SourceMosaic& mosaic, const SourceFile& file, const Block& block) {
  const Result<MappedFile> mapping = MappedFile::open(file.path.c_str());
  if (!mapping.ok()) return file_problem(file.path, Fault::tile_unreadable, std::strerror(errno));
  const auto tile =
      parse_hgt(mapping.value().bytes(), file.location.south_deg, file.location.west_deg);
  if (!tile.ok()) return file_problem(file.path, tile.fault(), "");
  if (tile.value().grid.rows != source_intervals + 1) {
    return file_problem(file.path, Fault::tile_size_mismatch, "a source tile has 1201 x 1201");
  }
  const int first_row = (file.location.south_deg - block.south_deg) * source_intervals;
  const int first_column = (file.location.west_deg - block.west_deg) * source_intervals;
  std::vector<float> row_m(source_intervals + 1);
  for (int row = 0; row <= source_intervals; ++row) {
    read_posts(tile.value(), row, 0, row_m);
    for (int column = 0; column <= source_intervals; ++column) {
      const float height_m = row_m[static_cast<std::size_t>(column)];
      if (std::isnan(height_m)) continue;
      std::int16_t& post = mosaic.posts_m[mosaic.index(first_row + row, first_column + column)];
      post = std::max(post, static_cast<std::int16_t>(height_m));
    }
  }
  return {};
}

}  // namespace

FileResult<SourceMosaic> mosaic_of_folder(const std::string& folder) {
  const FileResult<std::vector<SourceFile>> files = files_of(folder);
  if (!files.ok()) return files.problem();
  const FileResult<Block> block = block_of(folder, files.value());
  if (!block.ok()) return block.problem();
  SourceMosaic mosaic =
      empty_mosaic(block.value().cell_rows(), block.value().cell_columns(), source_intervals);
  mosaic.made_from = "the 3\" tiles";
  for (const SourceFile& file : files.value()) {
    if (FileProblem problem = add_tile(mosaic, file, block.value()); problem.fault != Fault::none) {
      return problem;
    }
    mosaic.made_from += " " + fs::path(file.path).filename().string();
  }
  return mosaic;
}

SourceMosaic mosaic_of_function(const sim::HeightFunction& height_m, int south_deg, int west_deg,
                                int cell_rows, int cell_columns, int intervals) {
  RL_ASSERT(cell_rows >= 1 && cell_columns >= 1 && intervals >= 2);
  RL_ASSERT(cell_rows * cell_columns <= most_source_cells);
  SourceMosaic mosaic = empty_mosaic(cell_rows, cell_columns, intervals);
  mosaic.made_from = "a function";
  for (int row = 0; row < mosaic.rows(); ++row) {
    const double latitude_deg = static_cast<double>(south_deg * intervals + row) / intervals;
    for (int column = 0; column < mosaic.columns(); ++column) {
      const double longitude_deg = static_cast<double>(west_deg * intervals + column) / intervals;
      mosaic.posts_m[mosaic.index(row, column)] =
          static_cast<std::int16_t>(sim::stored_height_m(height_m(latitude_deg, longitude_deg)));
    }
  }
  return mosaic;
}

SourceMosaic synthetic_mosaic(int intervals) {
  SourceMosaic mosaic =
      mosaic_of_function(sim::synthetic_height_m, sim::synthetic_south_deg, sim::synthetic_west_deg,
                         sim::synthetic_tiles_a_side, sim::synthetic_tiles_a_side, intervals);
  mosaic.made_from = "the synthetic island of `ridgeline make-demo` (computed, not measured)";
  return mosaic;
}

}  // namespace ridgeline::fine
