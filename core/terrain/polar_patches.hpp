#pragma once
#include <array>

#include "core/terrain/post_region.hpp"

namespace ridgeline {

/// A piece of the truth between two parallels and two meridians: one cell of a tile, or a few side
/// by side. Where it is known, its height at a place is the bilinear surface of its corners, from
/// `below_m` under it to `above_m` over it.
/// Units: degrees, longitude without end; m above the ellipsoid.
struct PolarPatch {
  double south_deg = 0, north_deg = 0, west_deg = 0, east_deg = 0;
  bool known = false;
  std::array<float, 4> corner_m{};  ///< south-west, south-east, north-west, north-east
  float below_m = 0, above_m = 0;
};

/// Cells of a box that a patch may touch, counted from the box's south-west; ends excluded.
struct Footprint {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
};

class PatchUser {
 public:
  virtual ~PatchUser() = default;
  /// Called for every patch that may touch the box. A patch may have no width: beyond it is ground
  /// that no tile covers.
  virtual void use(const PolarPatch& patch, const Footprint& at) = 0;
};

/// Walks every patch of every tile that touches a box of lattice cells in a polar chart, the same
/// patches whatever the box. Posts that tiles share count as post_region.hpp says; where the lower
/// and the taller height differ a patch spans both. Where tiles overlap in area each has patches.
/// `cells`: cell (column, row) has the lattice post of that name at its south-west.
/// Cost: O(tile cells near the box + tiles^2); no allocation.
void walk_patches(const TerrainSource& source, const PostBox& cells, PatchUser& user);

}  // namespace ridgeline
