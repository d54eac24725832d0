#pragma once
#include <cstdint>
#include <span>

#include "core/geo/chart.hpp"
#include "core/terrain/height_tile.hpp"
#include "core/terrain/tile_location.hpp"

namespace ridgeline {

/// A post of the lattice. Row 0, column 0 is its origin; columns count eastwards without end, so
/// that a flight over the antimeridian meets no jump: column and column + circle_columns() are the
/// same place.
struct PostIndex {
  std::int32_t column = 0, row = 0;
};

/// A place on the lattice, in posts from its origin.
struct LatticePoint {
  double column = 0, row = 0;
};

/// The endless regular grid that the terrain window is cut from. In the geographic chart it is the
/// finest grid on which every post of the tiles lies, fixed for a session; in a polar chart a
/// square grid from the pole, on which no post of a tile needs to lie. Frame: WGS 84 latitude and
/// longitude, degrees; rows northwards, columns eastwards. In a polar
///        chart rows and columns are `north` and `east` of that chart, and the functions of one
///        coordinate have no meaning.
struct PostLattice {
  double origin_latitude_deg = 0, origin_longitude_deg = 0;
  double latitude_step_deg = 0, longitude_step_deg = 0;
  Chart chart = Chart::geographic;

  [[nodiscard]] bool polar() const { return chart != Chart::geographic; }
  [[nodiscard]] GroundPlace place_of(double column, double row) const;
  /// The point of a place; in the geographic chart on the turn nearest to `near_column`.
  [[nodiscard]] LatticePoint point_of(const GroundPlace& place, double near_column) const;

  [[nodiscard]] double latitude_deg(double row) const {
    return origin_latitude_deg + row * latitude_step_deg;
  }
  [[nodiscard]] double longitude_deg(double column) const {
    return origin_longitude_deg + column * longitude_step_deg;
  }
  [[nodiscard]] double row_of(double latitude_deg) const {
    return (latitude_deg - origin_latitude_deg) / latitude_step_deg;
  }
  [[nodiscard]] double column_of(double longitude_deg) const {
    return (longitude_deg - origin_longitude_deg) / longitude_step_deg;
  }
  [[nodiscard]] double circle_columns() const { return 360.0 / longitude_step_deg; }
  /// The column of a longitude on the turn nearest to `near_column`.
  [[nodiscard]] double column_near(double longitude_deg, double near_column) const;
};

/// The lattice of a chart for a session whose lattice in the geographic chart is `geographic`: half
/// its latitude step both ways in a polar chart.
PostLattice lattice_in(Chart chart, const PostLattice& geographic);

/// How one axis of a tile lies on the lattice: post k of the tile is lattice post first + k *
/// ratio.
struct AxisFit {
  std::int32_t first = 0;
  int ratio = 0;  ///< 0: its posts do not lie on the lattice
};

/// Rows of a tile on the lattice.
AxisFit fit_rows(const PostLattice& lattice, const PostGrid& tile);
/// Columns of a tile on the lattice, on the turn that brings the tile nearest to `near_column`.
AxisFit fit_columns(const PostLattice& lattice, const PostGrid& tile, double near_column);

/// The lattice of a set of tiles: its step is the largest of which the steps of the tiles are whole
/// multiples. The tile nearest to `near` with the finest step of those within a degree sets origin
/// and phase; tiles that would make the step finer than a sixth of both theirs and the one so far,
/// or whose posts are out of phase, are left out (they are mismatched wherever they are met).
/// Result: 3 arc seconds from the equator and Greenwich where there is no tile.
PostLattice lattice_of(std::span<const PostGrid> tiles, const GeodeticPosition& near);

}  // namespace ridgeline
