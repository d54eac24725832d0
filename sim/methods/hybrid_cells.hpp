#pragma once
#include <array>
#include <vector>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// A square of cells of the height field, drawn one way or the other as a whole.
struct HybridCell {
  std::int32_t column = 0, row = 0;  ///< south-west post, lattice posts
  int level = 0;                     ///< of the window; a cell spans `side` posts of it
  float low_m = 0, high_m = 0;       ///< of its posts, the next cells' first ones included
  std::array<Vec3<Ecef>, 8> corners;
  Vec3<Ecef> centre;
  glm::dvec3 up{};      ///< at the centre
  double radius_m = 0;  ///< of the ball round the corners
};

/// The cells of `side` x `side` posts that cover what the window can draw. Cells of coarser levels
/// that a finer one covers are left out; their heights are bounded by the window's.
std::vector<HybridCell> hybrid_cells(const MethodTerrain& terrain, int side);

/// Linear and binary steps of the ray caster, most precise first.
struct Precision {
  int linear = 0, binary = 0;
};
inline constexpr std::array<Precision, 4> precisions{{{64, 25}, {27, 11}, {12, 5}, {5, 2}}};

/// How one cell is drawn.
struct CellChoice {
  enum class Kind : std::uint8_t { hidden, mesh, cast };
  Kind kind = Kind::hidden;
  int precision = 0;      ///< of a cast cell, index into `precisions`
  double distance_m = 0;  ///< d_b: from the eye to the centre
};

/// What the choice is made from.
struct CellView {
  const Camera& camera;
  const LocalFrame& local;
  double range_m = 0;
  double relief_m = 0;  ///< highest minus lowest ground of the window
  int side = 128;       ///< S: posts along a cell
  double t = 70;        ///< a cell is a mesh where A / S > t
  double k = 1.3;       ///< d_max = range / k
};

/// A: area of the projected box, px; infinite where a part of it is behind the eye.
[[nodiscard]] double box_area_px(const HybridCell& cell, const CellView& view);
/// Result: hidden outside the cone round the picture and beyond the range.
[[nodiscard]] CellChoice choice_of(const HybridCell& cell, const CellView& view);

}  // namespace ridgeline::sim
