#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/terrain/height_tile.hpp"
#include "core/terrain/tile_location.hpp"
#include "platform/file_result.hpp"
#include "platform/mapped_file.hpp"
#include "platform/tile_reader.hpp"

namespace ridgeline {

/// The terrain tiles of one folder; those near the aircraft are mapped, the others are not.
///
/// A tile is a file with the extension .hgt, whose name says where it is (`N46E008.hgt`,
/// `n46e008.SRTMGL1.hgt`), with .dt0, .dt1 or .dt2, whose header says where it is (a name that
/// names a cell, `n46_e008.dt1`, must agree), or one that the extra reader accepts. Case does not
/// matter. The folder and its sub-folders, one level deep, are searched once, when it is opened;
/// names that begin with a dot and all other files are passed over.
///
/// A tile that is truncated, mis-sized, corrupt, misplaced or unreadable is refused as a whole: its
/// area stays unknown, refused() names it once with the reason, and it is not tried again. Sizes
/// and headers are verified when the folder is opened, DTED checksums each time a tile is mapped.
class TerrainFolder {
 public:
  /// Searches the folder. `extra` (may be null) outlives the result.
  /// Domain: Fault::folder_unreadable for a folder that is missing or cannot be read,
  ///         Fault::folder_without_tiles when no file in it looks like a tile. A folder whose tiles
  ///         are all refused opens: see any_usable().
  /// Cost:   reads every name, the headers of DTED files and what the reader's describe() reads.
  ///         Allocates everything that select() needs for .hgt and DTED.
  /// `sea`: cells that an installer states to be sea. Where no file lies in such a cell, not even a
  ///         refused one, it is a tile whose posts stand at 0 m over the tiles' datum, with the
  ///         finest steps of the tiles found.
  static FileResult<TerrainFolder> open(const std::string& path, TileReader* extra = nullptr,
                                        std::span<const TileLocation> sea = {});

  /// Maps the tiles that meet the box and unmaps the others; true when that changed tiles().
  /// A tile refused on the way shows in refused().
  /// Cost:   O(tiles found), and for a new DTED tile one reading of its bytes. No heap, unless a
  ///         tile of the extra reader comes in or goes.
  bool select(const GeoBox& box);

  /// Lets the memory of pages read so far go; tiles stay chosen.
  void forget_pages() const;

  /// The tiles of the last select(), by south, then west, then name. Two files of the same cell are
  /// both here; the window decides between them.
  /// Owner: views this folder; valid until the next select().
  [[nodiscard]] std::span<const HeightTile> tiles() const { return tiles_; }

  /// Cells that became sea by the installer's statement, and statements not followed because a file
  /// lies in the cell.
  [[nodiscard]] int sea_count() const { return sea_count_; }
  [[nodiscard]] int idle_sea_count() const { return idle_sea_count_; }

  /// The post grids of all tiles found in files, in the same order, chosen or not.
  [[nodiscard]] std::vector<PostGrid> grids() const;
  /// Those of the cells of stated sea.
  [[nodiscard]] std::vector<PostGrid> sea_grids() const;

  /// Every refused file so far, once each; grows at the end only.
  [[nodiscard]] std::span<const FileProblem> refused() const { return refused_; }

  /// Whether any tile found has not been refused so far (checksums are known after select()).
  [[nodiscard]] bool any_usable() const { return usable_count_ > 0; }
  [[nodiscard]] std::size_t usable_count() const { return usable_count_; }

  /// Bytes of files mapped now.
  [[nodiscard]] std::size_t mapped_bytes() const { return mapped_bytes_; }
  /// Bytes of heap that tiles of the extra reader hold now.
  [[nodiscard]] std::size_t decoded_bytes() const { return decoded_bytes_; }

 private:
  enum class Format : std::uint8_t { hgt, dted, extra, sea };

  struct Entry {
    PostGrid grid;
    Format format = Format::hgt;
    bool refused = false;
    FileProblem problem;  // .file is the path; the message has its memory from open() on
    MappedFile mapping;
    DecodedTile decoded;
    std::optional<HeightTile> tile;  // set while the tile is chosen
  };

  [[nodiscard]] static std::optional<Format> format_of(const std::string& path,
                                                       const TileReader* extra);
  [[nodiscard]] static FileResult<PostGrid> described(const std::string& path, Format format,
                                                      TileReader* extra);
  void add_tile(const std::string& path, Format format);
  void add_sea(const TileLocation& cell, int rows, int columns);
  [[nodiscard]] bool search(const std::string& folder, bool into_sub_folders);
  void choose(Entry& entry);
  void choose_decoded(Entry& entry);
  void drop(Entry& entry);
  void refuse(Entry& entry, Fault fault, const char* detail);

  TileReader* extra_ = nullptr;
  std::vector<Entry> entries_;
  std::vector<HeightTile> tiles_;
  std::vector<FileProblem> refused_;
  int sea_count_ = 0, idle_sea_count_ = 0;
  std::size_t usable_count_ = 0;
  std::size_t mapped_bytes_ = 0;
  std::size_t decoded_bytes_ = 0;
};

}  // namespace ridgeline
