#pragma once
#include <limits>
#include <vector>

#include "tests/oracle/terrain.hpp"
#include "tests/oracle/wgs84.hpp"

namespace ridgeline::oracle {

/// Heights below which a ray over an unknown cell *may* show unknown (contract, section 1).
inline constexpr double may_be_unknown_below_m = 9000;

/// What one ray truly meets.
struct FirstHit {
  /// Z of the contract: m along the ray, +inf for sky.
  double distance_m = std::numeric_limits<double>::infinity();
  bool may_be_unknown = false;   ///< before Z, over an unknown cell below 9000 m
  bool must_be_unknown = false;  ///< before Z, over an unknown cell below the contract's threshold

  [[nodiscard]] bool is_sky() const { return distance_m > std::numeric_limits<double>::max(); }
};

/// How rays are walked. Acceleration skips stretches that a block's highest post proves irrelevant;
/// the answers are the same without it (test Tracer.acceleration_changes_nothing).
enum class Walk { accelerated, every_cell };

/// Walks rays from one eye, cell by cell, in double precision on the ellipsoid.
///
/// A ray is cut into stretches, at the lines of the geoid grid, at the edges of tiles and at the
/// lines of posts; between two cuts the surface is one bilinear patch and the ray one polynomial,
/// so the first root of their difference is found in closed intervals, tangencies included.
/// Towards a pole the stretches become shorter. A ray through the pole itself is walked up to 1 mm
/// before it and from 1 mm behind it.
/// A location in two overlapping tiles belongs to the finer one. Where there is no tile the cells
/// are unknown, with the steps of the nearest tile.
/// A ray that leaves a cell where it begins has not passed over it: from an eye on a line of posts
/// what rounding puts on the far side of the line does not count as unknown ground.
/// Error:  the surface is met within 1e-8 m of its height, and 1.2e-12 rad (1e-9 px of a usual
///         picture), as the same definition says in long double; where a ray grazes a hill that
///         closely the hit may be on the next one (test
///         Precision.first_hits_are_those_of_long_double_to_a_tenth_of_a_micrometre).
/// Owner:  views `terrain`, which must outlive it. Safe to use from several threads.
class Tracer {
 public:
  /// Units: m; rays end at `range_m`, and a surface beyond it is sky.
  Tracer(const Terrain& terrain, const Geodetic& eye, double range_m,
         Walk walk = Walk::accelerated);

  /// The exact first hit of the ray along a unit vector (ECEF).
  [[nodiscard]] FirstHit first_hit(const Vec3& direction) const;

  /// The smallest of (height of the ray over the known surface) / (distance), over distances up to
  /// `to_m`: negative once the ray is under the surface, and by how steep a turn it would get out.
  /// Values above `ceiling` are cut to it, which lets the walk skip nearly everything.
  [[nodiscard]] double clearance(const Vec3& direction, double to_m, double ceiling) const;

  [[nodiscard]] const Vec3& eye() const { return eye_; }
  [[nodiscard]] double range_m() const { return range_m_; }

  /// A tile and its edges, which are the same numbers as those of the tiles beside it.
  struct View {
    const TerrainTile* entry = nullptr;
    double south_deg = 0;
    double north_deg = 0;
    double west_deg = 0;
    double east_deg = 0;
  };
  [[nodiscard]] const Terrain& terrain() const { return *terrain_; }
  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  [[nodiscard]] double eye_lon_deg() const { return eye_lon_deg_; }
  /// The eye stands on a border between cells, to the rounding of its coordinates.
  [[nodiscard]] bool eye_on_a_line() const { return eye_on_a_line_; }
  [[nodiscard]] Walk walk() const { return walk_; }

 private:
  const Terrain* terrain_;
  Vec3 eye_;
  double eye_lon_deg_;
  double range_m_;
  Walk walk_;
  bool eye_on_a_line_ = false;
  std::vector<View> views_;
};

/// An edge to the microsecond of arc, so that the edges of neighbouring tiles are the same number.
[[nodiscard]] double shared_edge(double degrees);

}  // namespace ridgeline::oracle
