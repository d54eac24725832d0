#pragma once
#include "sim/synthetic/erosion.hpp"

namespace ridgeline::sim {

/// Where the synthetic land lies: the open ocean round the point that is farthest from any real
/// land, so that nobody can take it for a real place. Two by two one-degree tiles.
constexpr int synthetic_south_deg = -49;
constexpr int synthetic_west_deg = -124;
constexpr int synthetic_tiles_a_side = 2;

/// A rectangle of one height in the synthetic land.
struct FlatFeature {
  double latitude_deg;
  double longitude_deg;
  double axis_east;  ///< unit vector along the longer side
  double axis_north;
  double half_length_m;  ///< along the axis
  double half_width_m;   ///< across it
  double blend_m;        ///< the land around takes over within this distance
  double height_m;
};

/// The airfield plateau (2000 x 500 m) and the lake (2600 x 1000 m); heights are whole metres.
extern const FlatFeature synthetic_airfield;
extern const FlatFeature synthetic_lake;

/// An island of mountains up to about 3500 m, made by uplift and river erosion; SYNTHETIC.
/// Heights are the same bits on every machine with IEEE-754 doubles.
/// Cost: making one takes about two seconds and 40 MB.
class SyntheticTerrain {
 public:
  SyntheticTerrain();

  /// Height above the tiles' datum (m); exactly 0 on the sea, NaN in the one patch without data.
  /// Frame:  WGS 84 latitude and longitude in degrees; 0 (open sea) outside the four tiles.
  [[nodiscard]] double height_m(double latitude_deg, double longitude_deg) const;

 private:
  [[nodiscard]] double relief_m(double east_m, double north_m) const;
  Field height_m_;
  Field slope_;
};

/// The height of the one shared SyntheticTerrain, made at the first call.
[[nodiscard]] double synthetic_height_m(double latitude_deg, double longitude_deg);

}  // namespace ridgeline::sim
