#pragma once
#include "core/render/gl_object.hpp"
#include "core/terrain/terrain_levels.hpp"
#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// Coarser versions of the posts, for methods that sample them at a level of their own: per level
/// of the terrain window up to six more, each half as dense as the one before, toroidal like the
/// posts and in the texture layout of the renderer's pyramid of maxima. Made on the GPU, whole, by
/// one compute pass a step. Read by post_pyramid.glsl.
///
/// A node that stands for any unknown post is unknown: stored like a void post (floor less
/// void_offset_m), with the highest floor among them. So what is unknown is never lost in a mean.
class PostPyramid {
 public:
  enum class Filter : std::uint8_t {
    box,  ///< node (i, j) is the mean of posts i 2^k .. (i + 1) 2^k - 1: an average pyramid
    tent  ///< node (i, j) is vertex i 2^k; weights 1 2 1 each way of the vertices round it
  };

  /// Makes program and texture once for a size of the window, and fills it from the renderer's
  /// posts, which must be bound to posts_unit (the renderer leaves them there).
  /// Outcome: gl_shader, gl_out_of_memory; gl_error when no posts are bound.
  Outcome build(const TerrainView& view, Filter filter);
  /// Binds it for drawing.
  void bind() const;
  [[nodiscard]] std::size_t gpu_bytes() const;

 private:
  void fill_level(const TerrainView& view, int level, Filter filter) const;

  Program program_;
  Texture texture_;
  LevelSizes sizes_;
};

/// Heights of the ground near the eye, for choices that a method makes once a frame on the CPU: the
/// finest level of the window, each square of 4 x 4 known posts as its mean.
class CoarseGround {
 public:
  void build(const MethodTerrain& terrain);
  /// The mean of the square that holds the eye; `otherwise` where it is unknown. m, ellipsoid.
  [[nodiscard]] double below_eye_m(const TerrainView& view, double otherwise_m) const;
  [[nodiscard]] std::size_t heap_bytes() const { return squares_.capacity() * sizeof(float); }

 private:
  std::vector<float> squares_;  ///< NaN where unknown
  int columns_ = 0, rows_ = 0;
};

}  // namespace ridgeline::sim
