#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/terrain/terrain_block.hpp"

namespace ridgeline::test {

inline constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// A rectangle of posts counted in posts of a lattice, wherever it runs over the antimeridian.
struct Patch {
  int column = 0, row = 0;  ///< south-west post
  int column_ratio = 1, row_ratio = 1;
  int columns = 0, rows = 0;

  [[nodiscard]] int last_column() const { return column + (columns - 1) * column_ratio; }
  [[nodiscard]] int last_row() const { return row + (rows - 1) * row_ratio; }
};

/// Where the posts of a patch stand; west within -180..180.
[[nodiscard]] PostGrid grid_of(const PostLattice& lattice, const Patch& patch);

/// Terrain that a test lays out on a lattice, as the code under test gets it and as the contract
/// reads it: tiles that share a post are given its taller height first, then edits replace posts,
/// then the finest tile at a place is the truth. Works in whole lattice posts and shares nothing
/// with the code under test.
class Ground {
 public:
  using Height = std::function<float(int column, int row)>;  ///< of a lattice post; NaN = void

  explicit Ground(const PostLattice& lattice) : lattice_(lattice) {}

  void add(const Patch& patch, const Height& height_m);
  /// Replaces posts; counts from the call of finish() on.
  void edit(const Patch& patch, const Height& height_m);
  /// Must come before anything below.
  void finish();

  /// The raw tiles with the first `edits` edits; all of them by default. Owner: this object.
  [[nodiscard]] TerrainSource source(int edits = -1) const;
  [[nodiscard]] const PostLattice& lattice() const { return lattice_; }
  [[nodiscard]] const Patch& edited(int index) const {
    return edits_[static_cast<std::size_t>(index)].patch;
  }

  /// Height of the surface at a place, NaN where its cell is unknown. A place on a border of two
  /// tiles has one height for each: move it inside the wanted one. Units: lattice posts, m.
  [[nodiscard]] double height_m(double column, double row) const;
  /// Whether the ground inside the lattice cell north-east of a post is known.
  [[nodiscard]] bool cell_known(int column, int row) const;

 private:
  struct Sheet {
    Patch patch;
    std::vector<float> raw, truth;
    [[nodiscard]] int index(int column, int row) const;  ///< -1: no post there
  };

  static void share(Sheet& a, Sheet& b);

  PostLattice lattice_;
  std::vector<Sheet> sheets_, edits_;
  std::vector<HeightTile> tiles_;
  std::vector<TerrainEdit> terrain_edits_;
};

/// A number in 0..1 that depends on its arguments alone.
[[nodiscard]] double lottery(int a, int b, int seed);

/// Mountains from 100 m to 2500 m with single posts that stand out. Units: lattice posts, m.
[[nodiscard]] Ground::Height rough(int seed);
/// The same with void islands of many sizes, and single void posts.
[[nodiscard]] Ground::Height rough_with_voids(int seed);

/// 3" posts from 46 N 8 E on.
[[nodiscard]] PostLattice lattice_3s();
/// 1" posts from 46 N 8 E on.
[[nodiscard]] PostLattice lattice_1s();

/// Posts of a box as the code under test reads them.
struct Region {
  PostBox box;
  std::vector<float> posts;
  RegionFacts facts;

  [[nodiscard]] float at(int column, int row) const {
    return posts[static_cast<std::size_t>(row - box.row) * static_cast<std::size_t>(box.columns) +
                 static_cast<std::size_t>(column - box.column)];
  }
};
[[nodiscard]] Region region_of(const TerrainSource& source, const PostBox& box,
                               int geoid_stride = 1);

/// A block as the code under test builds it, in scratch memory of exactly the stated size.
[[nodiscard]] TerrainBlock block_of(const TerrainSource& source, const BlockId& id,
                                    double far_floor_m = 0);

}  // namespace ridgeline::test
