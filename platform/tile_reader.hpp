#pragma once
#include <string>
#include <vector>

#include "core/terrain/height_tile.hpp"
#include "platform/file_result.hpp"

namespace ridgeline {

/// A raster that a reader has decoded into memory of its own.
/// Shape: grid.rows x grid.columns, row 0 = south edge. Units: m; NaN = void.
struct DecodedTile {
  PostGrid grid;
  std::vector<float> posts_m;
};

/// How the terrain folder reads tiles of a format that platform/ does not know (sim/ adds GeoTIFF).
/// Calls may allocate: a program that locks its heap uses no such reader.
class TileReader {
 public:
  TileReader() = default;
  TileReader(const TileReader&) = delete;
  TileReader& operator=(const TileReader&) = delete;
  virtual ~TileReader() = default;

  /// Whether the name of the file says that it is of this reader's format. Opens nothing.
  [[nodiscard]] virtual bool accepts(const std::string& path) const = 0;
  /// Where the posts stand, from the file's header: called once for each file, at boot.
  virtual FileResult<PostGrid> describe(const std::string& path) = 0;
  /// The posts: called each time the tile comes within the chosen box.
  virtual FileResult<DecodedTile> load(const std::string& path) = 0;
};

}  // namespace ridgeline
