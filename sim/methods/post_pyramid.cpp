#include "sim/methods/post_pyramid.hpp"

#include <cmath>
#include <limits>

#include "shaders/frame_block.h"
#include "shaders/post_pyramid_comp.hpp"
#include "sim/methods/raster_target.hpp"

namespace ridgeline::sim {
namespace {

constexpr int pyramid_unit = 8;  ///< as in post_pyramid.glsl
constexpr int square_posts = 4;  ///< a side of a square of CoarseGround
constexpr int group_side = 8;    ///< as in post_pyramid.comp

GLuint groups(int nodes) {
  return static_cast<GLuint>((nodes + group_side - 1) / group_side);
}

}  // namespace

Outcome PostPyramid::build(const TerrainView& view, Filter filter) {
  glActiveTexture(GL_TEXTURE0 + shader::posts_unit);
  GLint posts = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &posts);
  if (posts == 0) return failed(Fault::gl_error, "post pyramid", "no posts are bound");
  if (program_.name() == 0) {
    Outcome made = make_method_program("post_pyramid", shader::post_pyramid_comp, program_);
    if (!made.ok()) return made;
  }
  glActiveTexture(GL_TEXTURE0 + pyramid_unit);
  const LevelSizes& s = view.sizes;
  if (texture_.name() == 0 || s.levels != sizes_.levels || s.columns() != sizes_.columns() ||
      s.rows() != sizes_.rows()) {
    texture_ = {};
    auto made =
        make_texture_array(GL_R32F, s.columns() / 2 + s.columns() / 4, s.rows() / 2, s.levels, 4);
    if (!made) return failed(made.fault(), "post pyramid");
    texture_ = std::move(made).value();
    sizes_ = s;
  }
  glUseProgram(program_.name());
  glBindImageTexture(shader::target_image, texture_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32F);
  for (int level = 0; level < s.levels; ++level) fill_level(view, level, filter);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  return {};
}

void PostPyramid::fill_level(const TerrainView& view, int level, Filter filter) const {
  const PostRect& rect = view.drawable[static_cast<std::size_t>(level)];
  if (rect.empty()) return;
  // Post `east` of a rectangle of cells is the last one held.
  const std::int32_t west = rect.west >> level, south = rect.south >> level;
  const std::int32_t first_column = (west >> block_levels) * block_posts;
  const std::int32_t first_row = (south >> block_levels) * block_posts;
  const std::int32_t last_column = (rect.east >> level) - first_column;
  const std::int32_t last_row = (rect.north >> level) - first_row;
  const int columns = sizes_.columns(), rows = sizes_.rows();
  glUniform4i(0, west - first_column, south - first_row, last_column, last_row);
  glUniform4i(1, wrapped(first_column, columns), wrapped(first_row, rows), columns, rows);
  for (int up = 1; up <= shader::node_levels; ++up) {
    glUniform4i(2, level, up, filter == Filter::tent ? 1 : 0, 0);
    glDispatchCompute(groups((last_column >> up) + 1), groups((last_row >> up) + 1), 1);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

void PostPyramid::bind() const {
  glActiveTexture(GL_TEXTURE0 + pyramid_unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
}

std::size_t PostPyramid::gpu_bytes() const {
  return static_cast<std::size_t>(sizes_.posts()) * 3 / 8 * sizeof(float);
}

void CoarseGround::build(const MethodTerrain& terrain) {
  const int columns = terrain.view.sizes.columns(), rows = terrain.view.sizes.rows();
  columns_ = columns / square_posts;
  rows_ = rows / square_posts;
  squares_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      double sum = 0;
      int known = 0;
      for (int k = 0; k < square_posts * square_posts; ++k) {
        const int c = column * square_posts + k % square_posts;
        const int r = row * square_posts + k / square_posts;
        const float post = terrain.posts[static_cast<std::size_t>(r) * columns + c];
        if (!(post > void_threshold_m)) continue;
        sum += static_cast<double>(post);
        ++known;
      }
      squares_[static_cast<std::size_t>(row) * columns_ + column] =
          known > 0 ? static_cast<float>(sum / known) : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

double CoarseGround::below_eye_m(const TerrainView& view, double otherwise_m) const {
  const PostRect& rect = view.drawable[0];
  const auto column = static_cast<std::int32_t>(std::floor(view.eye_column));
  const auto row = static_cast<std::int32_t>(std::floor(view.eye_row));
  if (column < rect.west || column >= rect.east || row < rect.south || row >= rect.north) {
    return otherwise_m;
  }
  const int c = wrapped(column, columns_ * square_posts) / square_posts;
  const int r = wrapped(row, rows_ * square_posts) / square_posts;
  const float square_m = squares_[static_cast<std::size_t>(r) * columns_ + c];
  return std::isnan(square_m) ? otherwise_m : static_cast<double>(square_m);
}

}  // namespace ridgeline::sim
