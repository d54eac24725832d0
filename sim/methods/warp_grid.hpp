#pragma once
#include <glm/vec2.hpp>

#include "sim/methods/raster_target.hpp"
#include "sim/methods/warp_bounds.hpp"

namespace ridgeline::sim {

struct WarpSettings {
  int grid = 512;    ///< vertices a side
  int map = 256;     ///< texels of the importance map a side
  double edge = 2;   ///< wanted length of an edge, px
  double posts = 2;  ///< most vertices a post without detail
  bool turn = true;  ///< the square is turned into the view
  bool detail = false;
};

/// Numbers a row of vertices takes: more than it has, so that neighbouring rows fall into different
/// places of a vertex cache of a power of two (a software driver's has 256, by number).
[[nodiscard]] constexpr int warp_stride(int grid) {
  constexpr int cache = 256, apart = 17;
  return (grid + cache - 1) / cache * cache + apart;
}

/// The warp itself: importance map, its blend, row pass, column pass, geometry image; five compute
/// passes. A context must be current whenever a member is called.
class WarpGrid {
 public:
  explicit WarpGrid(const WarpSettings& settings) : settings_(settings) {}
  /// Makes programs and textures once, and puts the bounds of this terrain into their textures.
  Outcome make(const MethodTerrain& terrain);
  /// Warps the grid for one frame.
  void warp(const RangeScene& scene);
  /// Sets the uniforms of warp.glsl in the program in use, for the frame last warped.
  /// `top_first`: whether row 0 of the target is the top of the picture.
  void set_uniforms(bool any_unknown, bool top_first) const;
  /// Direction of v in the frame last warped, east and north; of unit length.
  [[nodiscard]] const glm::dvec2& ahead() const { return ahead_; }

  /// RGBA32F, map x map: vertices a unit of u and of v asked for; whether it is in sight.
  [[nodiscard]] GLuint importance() const { return blended_.name(); }
  /// RGBA32F, grid x grid: xyz position, m from the eye; w octave of detail carried.
  [[nodiscard]] GLuint positions() const { return positions_.name(); }
  /// RGBA32F, toroidal: mean squares of the slopes of blocks.
  [[nodiscard]] GLuint slopes() const { return slopes_.name(); }
  [[nodiscard]] const WarpSettings& settings() const { return settings_; }
  [[nodiscard]] std::size_t gpu_bytes() const;

 private:
  Outcome make_programs();
  [[nodiscard]] glm::dvec2 ahead_of(const RangeScene& scene) const;
  Outcome make_bounds(const SurfaceBounds& bounds);

  WarpSettings settings_;
  Program importance_pass_, blend_pass_, rows_pass_, columns_pass_, mesh_pass_;
  Texture heights_, slopes_, importance_, blended_, rows_, columns_, positions_;
  glm::dvec2 ahead_{0, 1};
  int block_columns_ = 0, block_rows_ = 0;
};

}  // namespace ridgeline::sim
