#pragma once
#include <cstdint>
#include <span>

#include "core/terrain/post_lattice.hpp"
#include "core/terrain/terrain_edit.hpp"

namespace ridgeline {

/// Undulation of the geoid, m, added to every post; null function means 0 everywhere.
struct GeoidLookup {
  double (*undulation_m)(const void* context, double latitude_deg, double longitude_deg) = nullptr;
  const void* context = nullptr;
};

/// What the raw terrain is: tiles, later changes, and the geoid the tiles count from.
struct TerrainSource {
  PostLattice lattice;
  std::span<const HeightTile> tiles;
  std::span<const TerrainEdit> edits;
  GeoidLookup geoid;
};

/// A rectangle of lattice posts.
struct PostBox {
  std::int32_t column = 0, row = 0;  ///< south-west post
  int columns = 0, rows = 0;
};

/// What reading a rectangle of posts met on the way.
struct RegionFacts {
  /// Largest amount by which the one height of a post differs from what a tile that shares the
  /// post, or interpolates between posts there, says: where tiles of different steps disagree along
  /// an edge the truth has two sides, and the region only one. m
  double seam_m = 0;
  bool seam_void = false;    ///< along such an edge one side is unknown and the other is not
  int tiles = 0;             ///< that lie in the box
  int mismatched_tiles = 0;  ///< whose posts are not on the lattice: left unknown
};

/// Reads the posts of a box, row-major from the south-west: height above the ellipsoid, NaN where
/// unknown. A tile of a coarser step is interpolated bilinearly, which leaves its surface as it is.
/// Where tiles of one step share posts the taller is the truth and a known post wins over a void
/// one; where a finer tile overlaps a coarser one in area the finer one is, its voids included.
/// `geoid_stride`: the undulation is looked up at every so manieth post and interpolated between.
/// `rests`: where given, what is left of each post by rounding it to a float: post + rest is the
/// height to 1e-10 m (interpolation and undulation are double). Undefined where unknown.
/// Shape:  posts.size() == rows * columns; scratch.size() >= 4 * columns + 8; rests as posts.
/// Cost:   O(posts + tiles); no allocation.
RegionFacts read_region(const TerrainSource& source, const PostBox& box, int geoid_stride,
                        std::span<float> posts, std::span<float> scratch,
                        std::span<float> rests = {});

/// The place of a box on the Earth, for choosing tiles.
GeoBox geo_box(const PostLattice& lattice, const PostBox& box);

}  // namespace ridgeline
