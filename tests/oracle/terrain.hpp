#pragma once
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "tests/oracle/geoid.hpp"
#include "tests/oracle/tile.hpp"
#include "tests/oracle/wgs84.hpp"

namespace ridgeline::oracle {

/// Side of the smallest blocks of the summary of a tile, in cells.
inline constexpr int block_cells = 16;

/// What is known of a square of cells. Units: m above the tile's datum.
struct Block {
  float lowest_m;      ///< lowest known post; +inf without one
  float highest_m;     ///< highest known post; -inf without one
  float must_below_m;  ///< passing over its unknown cells lower than this *must* show unknown;
                       ///< -inf without unknown cells
  bool has_unknown = false;  ///< some cell has a void post
};

/// Blocks of side `block_cells << level` cells, row 0 south. A block counts all posts of its cells,
/// its north and east border included.
struct BlockLevel {
  int rows = 0;
  int columns = 0;
  std::vector<Block> blocks;

  [[nodiscard]] const Block& at(int row, int column) const {
    return blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
  }
};

struct TerrainTile {
  Tile tile;
  std::vector<BlockLevel> levels;
};

/// Keeps a tile near one of these positions.
struct Neighbourhood {
  double lat_deg = 0;
  double lon_deg = 0;
  double radius_m = 0;
};

/// The truth of the contract, section 1: every loaded post, as read.
///
/// - Tiles of one lattice that overlap in posts (a shared edge, in the usual case) share them: the
///   taller height is the truth, and a post that either of them knows is known.
/// - Tiles of different steps share the posts that coincide on a common edge. Where they overlap in
///   area the finer one is the truth, its voids included.
/// - Nothing else fills a void.
class Terrain {
 public:
  /// `lowest_elsewhere_m` is the lowest known post of loaded terrain that is not among `tiles`.
  /// Errors: InputError where there is no tile.
  Terrain(std::vector<Tile> tiles, Geoid geoid,
          double lowest_elsewhere_m = std::numeric_limits<double>::infinity());

  /// Reads every tile of a folder and of its sub-folders, one level deep, and keeps those near one
  /// of `places` (all, if there are none). The others still count for the lowest post of the loaded
  /// terrain. A tile that cannot be read is a missing tile: unknown ground, named by refused().
  /// Errors: InputError naming the folder, also where none of its tiles can be read.
  [[nodiscard]] static Terrain load(const std::filesystem::path& folder, Geoid geoid,
                                    const std::vector<Neighbourhood>& places);

  /// The tiles, finest first.
  [[nodiscard]] const std::vector<TerrainTile>& tiles() const { return tiles_; }
  [[nodiscard]] const Geoid& geoid() const { return geoid_; }
  [[nodiscard]] double lowest_post_m() const { return lowest_post_m_; }
  [[nodiscard]] double highest_post_m() const { return highest_post_m_; }
  /// One line for every tile of the folder that could not be read: the file, then the fault.
  [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }
  /// The steepest rise per run between known neighbouring posts.
  [[nodiscard]] double steepest() const { return steepest_; }

  /// The height over the datum below which passing over the unknown cells of a box *must* show
  /// unknown. The contract speaks of 3 x 3 aligned blocks of 64 x 64 cells without saying from
  /// where they are aligned, so this is the smallest threshold over all 64 x 64 alignments and over
  /// all cells of the box: a ray below it is below the contract's threshold for each of them. An
  /// alignment reaches at most 127 cells from the cell, and at least 64 to every side; the lowest
  /// post of the whole terrain is taken unless the part that all alignments share has a known post.
  /// Units: degrees, the box at most some hundred cells wide; steps of the cells in question.
  [[nodiscard]] double must_below_m(double south_deg, double north_deg, double west_deg,
                                    double east_deg, double lat_step_deg,
                                    double lon_step_deg) const;

 private:
  void share_posts();
  void summarise(double lowest_elsewhere_m);

  std::vector<TerrainTile> tiles_;
  std::vector<std::string> refused_;
  Geoid geoid_;
  double lowest_post_m_ = 0;
  double highest_post_m_ = 0;
  double steepest_ = 0;
};

/// The longitude of `west_deg` on the turn that brings the middle of a tile closest to `near_deg`.
[[nodiscard]] double west_on_turn(const Tile& tile, double near_deg);

}  // namespace ridgeline::oracle
