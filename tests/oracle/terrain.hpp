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

/// Blocks of side `block_cells << level` cells. A block counts all posts of its cells, its north
/// and east border included.
using BlockLevel = Sheet<Block>;

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

/// What stood where posts were replaced.
struct ReplacedPosts {
  struct Post {
    std::size_t tile;  ///< in Terrain::tiles()
    int row;
    int column;
    float height_m;  ///< the height before, NaN = void
  };
  std::vector<Post> posts;
  double lowest_elsewhere_m = 0;
};

/// The truth of the contract, section 1: every loaded post, as read.
///
/// - Tiles of one lattice that overlap in posts (a shared edge, in the usual case) share them: the
///   taller height is the truth, and a post that either of them knows is known.
/// - Tiles of different steps share the posts that coincide on a common edge. Where they overlap in
///   area the finer one is the truth, its voids included.
/// - A cell of the coverage list that no file reaches into is a tile of posts of 0 m, with the
///   finest steps of the files. It shares posts like any other tile.
/// - Replaced posts are the truth in every tile that has a post there, without a look at what they
///   replace or at what another tile says.
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
  /// A cell of `coverage` is sea unless a file reaches into it, or a refused file's name names it.
  /// Errors: InputError naming the folder, also where none of its tiles can be read.
  /// Cost:   reads every file; memory 2 bytes a post of the tiles kept, 4 where heights are not
  ///         whole metres; of a cell of sea, 4 bytes a post of its border.
  [[nodiscard]] static Terrain load(const std::filesystem::path& folder, Geoid geoid,
                                    const std::vector<Neighbourhood>& places,
                                    const std::vector<DegreeCell>& coverage = {});

  /// Replaces every post of every tile kept that stands where a post of `patch` stands.
  /// Cost: grows with the posts of the patch, and with the blocks near it that hold unknown cells.
  ReplacedPosts replace(const Tile& patch);
  /// Undoes a replacement. Domain: the last one that has not been undone.
  void put_back(const ReplacedPosts& replaced);
  /// Whether some tile of the folder, kept or not, has the steps of `patch` (to a millionth) and a
  /// post where a post of it stands.
  [[nodiscard]] bool has_lattice_of(const Grid& patch) const;

  /// The tiles, finest first.
  [[nodiscard]] const std::vector<TerrainTile>& tiles() const { return tiles_; }
  [[nodiscard]] const Geoid& geoid() const { return geoid_; }
  [[nodiscard]] double lowest_post_m() const { return lowest_post_m_; }
  [[nodiscard]] double highest_post_m() const { return highest_post_m_; }
  /// One line for every tile of the folder that could not be read: the file, then the fault.
  [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }
  /// Cells of the coverage list: those that are sea, and those that are not because of a file.
  [[nodiscard]] int sea_cells() const { return sea_cells_; }
  [[nodiscard]] int ignored_sea_cells() const { return ignored_sea_cells_; }
  /// At least the steepest rise per run between known neighbouring posts.
  [[nodiscard]] double steepest() const { return steepest_; }

  /// The height over the datum below which passing over the unknown cells of a box *must* show
  /// unknown. The contract speaks of 3 x 3 aligned blocks of 64 x 64 cells without saying from
  /// where they are aligned, so this is the smallest threshold over all 64 x 64 alignments and over
  /// all cells of the box: a ray below it is below the contract's threshold for each of them. An
  /// alignment reaches at most 127 cells from the cell, and at least 64 to every side; the lowest
  /// post of the whole terrain is taken unless the part that all alignments share has a known post.
  /// Units: degrees, the box at most some hundred cells wide; steps of the cells in question.
  [[nodiscard]] double must_below_m(const GeoBox& box, double lat_step_deg,
                                    double lon_step_deg) const;

 private:
  void share_posts();
  void summarise();
  void summarise_changed(const std::vector<ReplacedPosts::Post>& posts);
  void summarise_whole(const std::vector<GeoBox>& changed);
  void set_thresholds(TerrainTile& entry, const std::vector<GeoBox>* changed);

  std::vector<TerrainTile> tiles_;
  std::vector<Grid> far_grids_;  ///< of the tiles of the folder that were not kept
  std::vector<std::string> refused_;
  Geoid geoid_;
  int sea_cells_ = 0;
  int ignored_sea_cells_ = 0;
  double lowest_elsewhere_m_ = 0;
  double lowest_post_m_ = 0;
  double highest_post_m_ = 0;
  double steepest_ = 0;
};

/// The lowest known post of a tile of a file or an edit; +inf without one.
[[nodiscard]] double lowest_known_m(const Tile& tile);

}  // namespace ridgeline::oracle
