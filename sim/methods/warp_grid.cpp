#include "sim/methods/warp_grid.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "shaders/warp_blend_comp.hpp"
#include "shaders/warp_columns_comp.hpp"
#include "shaders/warp_importance_comp.hpp"
#include "shaders/warp_mesh_comp.hpp"
#include "shaders/warp_rows_comp.hpp"

namespace ridgeline::sim {
namespace {

// As in the shaders.
constexpr int sizes_location = 0, asks_location = 1, ahead_location = 2;
constexpr int upward_location = 3;
constexpr int first_unit = 6, second_unit = 7, detail_unit = 8;
constexpr int local_size = 8;
constexpr double posts_with_detail = 64;  ///< vertices a post: the finest octave

GLuint groups(int count) {
  return static_cast<GLuint>((count + local_size - 1) / local_size);
}

void bind(int unit, GLuint texture) {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

void write_to(const Texture& image, GLenum format) {
  glBindImageTexture(0, image.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
}

Outcome make_image(GLenum format, int columns, int rows, Texture& texture) {
  auto made = make_texture(format, columns, rows, 1, format == GL_R32F ? 4 : 16);
  if (!made) return failed(made.fault(), "method warp");
  texture = std::move(made).value();
  return {};
}

}  // namespace

Outcome WarpGrid::make_programs() {
  struct Entry {
    std::string_view name, source;
    Program* program;
  };
  for (const Entry& entry :
       {Entry{"warp_importance", shader::warp_importance_comp, &importance_pass_},
        Entry{"warp_blend", shader::warp_blend_comp, &blend_pass_},
        Entry{"warp_rows", shader::warp_rows_comp, &rows_pass_},
        Entry{"warp_columns", shader::warp_columns_comp, &columns_pass_},
        Entry{"warp_mesh", shader::warp_mesh_comp, &mesh_pass_}}) {
    const Outcome made = make_method_program(entry.name, entry.source, *entry.program);
    if (!made.ok()) return made;
  }
  return {};
}

Outcome WarpGrid::make_bounds(const SurfaceBounds& bounds) {
  Outcome made;
  if (bounds.columns != block_columns_ || bounds.rows != block_rows_) {
    made = make_image(GL_RGBA32F, bounds.columns, bounds.rows, heights_);
    if (made.ok()) made = make_image(GL_RGBA32F, bounds.columns, bounds.rows, slopes_);
    if (!made.ok()) return made;
    block_columns_ = bounds.columns;
    block_rows_ = bounds.rows;
  }
  bind(first_unit, heights_.name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, bounds.columns, bounds.rows, GL_RGBA, GL_FLOAT,
                  bounds.heights.data());
  bind(first_unit, slopes_.name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, bounds.columns, bounds.rows, GL_RGBA, GL_FLOAT,
                  bounds.slopes.data());
  return {};
}

Outcome WarpGrid::make(const MethodTerrain& terrain) {
  if (mesh_pass_.name() == 0) {
    const int map = settings_.map, grid = settings_.grid;
    Outcome made = make_programs();
    if (made.ok()) made = make_image(GL_RGBA32F, map, map, importance_);
    if (made.ok()) made = make_image(GL_RGBA32F, map, map, blended_);
    if (made.ok()) made = make_image(GL_R32F, grid, map, rows_);
    if (made.ok()) made = make_image(GL_R32F, grid, grid, columns_);
    if (made.ok()) made = make_image(GL_RGBA32F, grid, grid, positions_);
    if (!made.ok()) return made;
  }
  return make_bounds(surface_bounds(terrain));
}

void WarpGrid::set_uniforms(bool any_unknown, bool top_first) const {
  const double most = settings_.detail ? posts_with_detail : settings_.posts;
  glUniform4i(sizes_location, settings_.map, settings_.grid, warp_stride(settings_.grid), 0);
  glUniform4f(asks_location, static_cast<float>(settings_.edge), static_cast<float>(most),
              settings_.detail ? 1.0f : 0.0f, any_unknown ? 1.0f : 0.0f);
  glUniform2f(ahead_location, static_cast<float>(ahead_.x), static_cast<float>(ahead_.y));
  glUniform1f(upward_location, top_first ? 1.0f : -1.0f);
}

glm::dvec2 WarpGrid::ahead_of(const RangeScene& scene) const {
  constexpr double level_enough = 0.02;  // of the line of sight
  if (!settings_.turn) return {0, 1};
  const glm::dmat3& axes = scene.report.camera.enu_from_camera.columns;
  glm::dvec2 way(axes[2]);
  // Straight up or down the picture's upper side is ahead, or behind.
  if (glm::length(way) < level_enough) way = glm::dvec2(axes[1]) * (axes[2].z > 0 ? 1.0 : -1.0);
  return way / glm::length(way);
}

void WarpGrid::warp(const RangeScene& scene) {
  const bool any_unknown = scene.report.window.void_posts > 0;
  ahead_ = ahead_of(scene);
  const GLuint maps = groups(settings_.map), grids = groups(settings_.grid);
  glUseProgram(importance_pass_.name());
  set_uniforms(any_unknown, true);
  bind(first_unit, heights_.name());
  bind(second_unit, slopes_.name());
  write_to(importance_, GL_RGBA32F);
  glDispatchCompute(maps, maps, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);

  glUseProgram(blend_pass_.name());
  set_uniforms(any_unknown, true);
  bind(first_unit, importance_.name());
  write_to(blended_, GL_RGBA32F);
  glDispatchCompute(maps, maps, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);

  glUseProgram(rows_pass_.name());
  set_uniforms(any_unknown, true);
  bind(first_unit, blended_.name());
  write_to(rows_, GL_R32F);
  glDispatchCompute(maps, 1, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);

  glUseProgram(columns_pass_.name());
  set_uniforms(any_unknown, true);
  bind(second_unit, rows_.name());
  write_to(columns_, GL_R32F);
  glDispatchCompute(grids, 1, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);

  glUseProgram(mesh_pass_.name());
  set_uniforms(any_unknown, true);
  bind(first_unit, rows_.name());
  bind(second_unit, columns_.name());
  bind(detail_unit, slopes_.name());
  write_to(positions_, GL_RGBA32F);
  glDispatchCompute(grids, grids, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

std::size_t WarpGrid::gpu_bytes() const {
  const auto map = static_cast<std::size_t>(settings_.map);
  const auto grid = static_cast<std::size_t>(settings_.grid);
  const auto blocks =
      static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows_);
  return 32 * map * map + 4 * grid * map + 20 * grid * grid + 32 * blocks;
}

}  // namespace ridgeline::sim
