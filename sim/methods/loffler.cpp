#include "sim/methods/loffler.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/vec4.hpp>

#include "shaders/loffler_cast_frag.hpp"
#include "shaders/loffler_cast_vert.hpp"
#include "shaders/loffler_frag.hpp"
#include "shaders/loffler_refine_comp.hpp"
#include "shaders/loffler_vert.hpp"
#include "sim/methods/setting_reader.hpp"

namespace ridgeline::sim {
namespace {

constexpr int block_binding = 3;      ///< of loffler_block.glsl
constexpr int relief_unit = 2;        ///< of loffler_refine.comp
constexpr GLuint coarse_binding = 1;  ///< likewise
constexpr int refine_threads = 64;
constexpr std::size_t vertex_bytes = 8 * sizeof(float);
constexpr double least_base_m = 50.0;  ///< of the eye over the base plane
constexpr std::uint32_t restart = 0xFFFFFFFFU;
constexpr float sky = 1e30F;

/// loffler_block.glsl, std140.
struct Block {
  glm::vec4 right, ahead, upward;
  glm::ivec4 size, place, options;
};
static_assert(sizeof(Block) == 96);

glm::vec4 with_w(const glm::dvec3& v, double w) {
  return {glm::vec3(v), static_cast<float>(w)};
}

/// Strips of two rows of vertices each, parted by the restart index.
std::vector<std::uint32_t> strip_indices(int columns, int rows) {
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(rows - 1) * (2 * columns + 1));
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      indices.push_back(static_cast<std::uint32_t>((row + 1) * columns + column));
      indices.push_back(static_cast<std::uint32_t>(row * columns + column));
    }
    indices.push_back(restart);
  }
  return indices;
}

GLuint make_framebuffer(Framebuffer& target) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  target = Framebuffer(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  return name;
}

/// Puts the renderer's range picture into the bound framebuffer, where it is not there already.
void attach_range(GLuint range, GLuint& attached) {
  if (range == attached) return;
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, range, 0);
  attached = range;
}

}  // namespace

std::string Loffler::params() const {
  char text[160];
  std::snprintf(text, sizeof text, "grid %dx%d, warp %s, rays %s%s, claims gamma %g px%s%s",
                settings_.columns, settings_.rows, settings_.warp ? "on" : "off",
                settings_.rays ? "on" : "off",
                settings_.rays && settings_.from_eye ? " from the eye" : "", settings_.gamma_px,
                settings_.lift ? "" : ", not lifted", settings_.flat ? ", flat Earth" : "");
  return text;
}

Outcome Loffler::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  build_relief(terrain, relief_);
  lowest_m_ = terrain.lowest_m;
  voids_ = terrain.view.sizes.levels > 1 || relief_.void_posts > 0;
  if (Outcome made = make_objects(sizes); !made.ok()) return made;
  upload_relief();
  return {};
}

Outcome Loffler::make_objects(const RenderSizes& sizes) {
  const std::size_t before = gl_bytes_allocated();
  Outcome made;
  if (refine_.name() == 0) {
    made = make_method_program("loffler_refine", shader::loffler_refine_comp, refine_);
    if (made.ok()) {
      made = make_method_program("loffler", shader::loffler_vert, shader::loffler_frag, draw_);
    }
    if (made.ok()) {
      made = make_method_program("loffler_cast", shader::loffler_cast_vert,
                                 shader::loffler_cast_frag, cast_);
    }
    if (made.ok()) made = make_vertices();
  }
  if (made.ok()) made = make_relief(sizes);
  if (made.ok() && settings_.rays) made = make_surface(sizes);
  if (made.ok() && !settings_.rays) made = plain_target_.make(sizes);
  gpu_bytes_ += gl_bytes_allocated() - before;
  return made;
}

Outcome Loffler::make_vertices() {
  const std::vector<std::uint32_t> indices = strip_indices(settings_.columns, settings_.rows);
  const std::size_t index_bytes = indices.size() * sizeof indices[0];
  index_count_ = static_cast<GLsizei>(indices.size());
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  empty_ = VertexArray(name);
  glGenVertexArrays(1, &name);
  arrays_ = VertexArray(name);
  glBindVertexArray(name);
  const char* const owner = "loffler";
  Outcome made =
      make_method_buffer(owner, GL_ELEMENT_ARRAY_BUFFER, index_bytes, GL_STATIC_DRAW, indices_);
  if (!made.ok()) return made;
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(index_bytes), indices.data());
  made = make_method_buffer(owner, GL_ARRAY_BUFFER, vertex_count() * vertex_bytes, GL_DYNAMIC_COPY,
                            vertices_);
  if (!made.ok()) return made;
  for (GLuint k = 0; k < 2; ++k) {
    glEnableVertexAttribArray(k);
    glVertexAttribPointer(k, 4, GL_FLOAT, GL_FALSE, vertex_bytes,
                          reinterpret_cast<const void*>(k * vertex_bytes / 2));
  }
  glBindVertexArray(0);
  made = make_method_buffer(owner, GL_UNIFORM_BUFFER, sizeof(Block), GL_DYNAMIC_DRAW, block_);
  if (!made.ok()) return made;
  return make_method_buffer(owner, GL_SHADER_STORAGE_BUFFER, CoarseGrid::points * sizeof(glm::vec2),
                            GL_DYNAMIC_DRAW, coarse_buffer_);
}

Outcome Loffler::make_relief(const RenderSizes& sizes) {
  const int columns = sizes.window.columns() / 2, rows = sizes.window.rows() / 2;
  if (columns == relief_columns_ && rows == relief_rows_) return {};
  int levels = 1;
  std::size_t texels = 0;
  for (int side = std::max(columns, rows); side > 1; side /= 2) ++levels;
  for (int k = 0; k < levels; ++k) {
    texels += static_cast<std::size_t>(std::max(columns >> k, 1)) * std::max(rows >> k, 1);
  }
  // Not make_texture: its byte count knows one level only.
  GLuint name = 0;
  glGenTextures(1, &name);
  relief_texture_ = Texture(name);
  while (glGetError() != GL_NO_ERROR) {
  }
  glBindTexture(GL_TEXTURE_2D, name);
  glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA32F, columns, rows);
  if (glGetError() != GL_NO_ERROR) {
    return failed(Fault::gl_out_of_memory, "method loffler", "relief pyramid");
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  relief_columns_ = columns;
  relief_rows_ = rows;
  gpu_bytes_ += texels * sizeof(Relief);
  return {};
}

Outcome Loffler::make_surface(const RenderSizes& sizes) {
  const int w = sizes.width_px, h = sizes.height_px;
  if (w == width_px_ && h == height_px_) return {};
  auto surface = make_texture(GL_RG32UI, w, h, 1, 8);
  auto depth = make_texture(GL_DEPTH_COMPONENT32F, w, h, 1, 4);
  if (!surface || !depth) {
    return failed(Fault::gl_out_of_memory, "method loffler", "error buffer");
  }
  surface_ = std::move(surface).value();
  depth_ = std::move(depth).value();
  make_framebuffer(surface_target_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, surface_.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  const GLenum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, buffers);
  make_framebuffer(cast_target_);
  surface_range_ = 0;
  cast_range_ = 0;
  width_px_ = w;
  height_px_ = h;
  row_words_.resize(4 * static_cast<std::size_t>(w));
  return {};
}

void Loffler::upload_relief() {
  glActiveTexture(GL_TEXTURE0 + relief_unit);
  glBindTexture(GL_TEXTURE_2D, relief_texture_.name());
  for (std::size_t k = 0; k < relief_.levels.size(); ++k) {
    const ReliefPyramid::Level& level = relief_.levels[k];
    glTexSubImage2D(GL_TEXTURE_2D, static_cast<GLint>(k), 0, 0, level.columns, level.rows, GL_RGBA,
                    GL_FLOAT, level.texels.data());
  }
}

void Loffler::upload_frame(const RangeScene& scene) {
  footprint_.look(scene, relief_, lowest_m_);
  const Camera& camera = scene.report.camera;
  const double base_m = std::max(scene.report.local.eye.height_m - lowest_m_, least_base_m);
  const Projector projector =
      projector_over(camera.attitude, base_m, scene.map.range_m, footprint_.ground());
  coarse_.spread(projector);
  if (settings_.warp) coarse_.warp(projector);
  const double field_of_view_rad = 2.0 * std::atan(0.5 * camera.width_px / camera.fx);
  const double lambda = camera.width_px / field_of_view_rad;
  const PostRect& rect = scene.view.drawable[0];
  const auto column = static_cast<std::int32_t>(std::floor(scene.view.eye_column));
  const auto row = static_cast<std::int32_t>(std::floor(scene.view.eye_row));
  const Block block{
      with_w(projector.right, base_m),
      with_w(projector.ahead, lambda),
      with_w(projector.upward, settings_.gamma_px),
      {settings_.columns, settings_.rows, static_cast<int>(relief_.levels.size()),
       settings_.lift ? 1 : 0},
      {relief_.west - column, relief_.south - row, rect.east - rect.west, rect.north - rect.south},
      {settings_.flat ? 1 : 0, settings_.from_eye ? 1 : 0, voids_ ? 1 : 0, 0}};
  glBindBuffer(GL_UNIFORM_BUFFER, block_.name());
  glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, block_binding, block_.name());
  const auto points = coarse_.vertices();
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, coarse_buffer_.name());
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(points.size_bytes()),
                  points.data());
}

void Loffler::refine() {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shader::planes_buffer, vertices_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, coarse_binding, coarse_buffer_.name());
  glActiveTexture(GL_TEXTURE0 + relief_unit);
  glBindTexture(GL_TEXTURE_2D, relief_texture_.name());
  glUseProgram(refine_.name());
  const auto groups = (vertex_count() + refine_threads - 1) / refine_threads;
  glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

void Loffler::begin_surface(const Renderer& renderer) {
  glBindFramebuffer(GL_FRAMEBUFFER, surface_target_.name());
  attach_range(renderer.names().range, surface_range_);
  glViewport(0, 0, width_px_, height_px_);
  for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_DITHER}) glDisable(off);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  const auto word = std::bit_cast<std::uint32_t>(sky);
  const GLuint words[4] = {word, word, word, word}, zeros[4] = {};
  const GLfloat far = 1.0F;
  glClearBufferuiv(GL_COLOR, 0, words);
  glClearBufferuiv(GL_COLOR, 1, zeros);
  glClearBufferfv(GL_DEPTH, 0, &far);
}

void Loffler::draw(const RangeScene& scene) {
  upload_frame(scene);
  refine();
  if (settings_.rays) {
    begin_surface(scene.renderer);
  } else {
    plain_target_.begin(scene.renderer);
  }
  glUseProgram(draw_.name());
  glBindVertexArray(arrays_.name());
  glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  glDrawElements(GL_TRIANGLE_STRIP, index_count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  plain_target_.end();
  if (settings_.rays) cast(scene.renderer);
}

void Loffler::cast(const Renderer& renderer) {
  glBindFramebuffer(GL_FRAMEBUFFER, cast_target_.name());
  attach_range(renderer.names().range, cast_range_);
  glActiveTexture(GL_TEXTURE0 + shader::nodes_unit);
  glBindTexture(GL_TEXTURE_2D, surface_.name());
  glUseProgram(cast_.name());
  glBindVertexArray(empty_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Loffler::read_errors(std::span<float> errors) {
  RL_ASSERT(errors.size() == static_cast<std::size_t>(width_px_) * height_px_);
  glBindFramebuffer(GL_FRAMEBUFFER, surface_target_.name());
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  std::size_t out = 0;
  for (int row = 0; row < height_px_; ++row) {
    glReadPixels(0, row, width_px_, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, row_words_.data());
    for (std::size_t x = 0; x < row_words_.size(); x += 4) {
      errors[out++] = std::bit_cast<float>(row_words_[x]);
    }
  }
}

Outcome Loffler::use_counting(bool counting) {
  return counting_.use(
      counting, {"loffler_cast", shader::loffler_cast_vert, shader::loffler_cast_frag}, cast_);
}

MethodFacts Loffler::facts() {
  MethodFacts facts;
  facts.gpu_bytes = gpu_bytes_;
  facts.heap_bytes = relief_.bytes() + row_words_.capacity() * sizeof row_words_[0];
  if (!settings_.rays || width_px_ == 0) return facts;
  const std::size_t pixels = static_cast<std::size_t>(width_px_) * height_px_;
  std::vector<float> errors(pixels);
  read_errors(errors);
  const auto cast = std::count_if(errors.begin(), errors.end(), [](float e) { return e > 0; });
  facts.ray_cast_share = static_cast<double>(cast) / static_cast<double>(pixels);
  return facts;
}

LofflerSettings loffler_settings(const MethodSpec& spec, std::string& problem) {
  LofflerSettings settings;
  SettingReader reader(spec);
  const auto flag = [&](std::string_view word, bool& value) {
    int number = value ? 1 : 0;
    reader.whole(word, number, 0, 1);
    value = number == 1;
  };
  std::string from = "surface", earth = "curved";
  reader.grid("grid", settings.columns, settings.rows, 16, 4096);
  flag("warp", settings.warp);
  flag("rays", settings.rays);
  settings.lift = settings.rays;
  flag("lift", settings.lift);
  reader.number("gamma", settings.gamma_px, 1e-3, 64.0);
  reader.word("from", from, {"surface", "eye"});
  reader.word("earth", earth, {"curved", "flat"});
  settings.from_eye = from == "eye";
  settings.flat = earth == "flat";
  problem = reader.problem();
  return settings;
}

std::unique_ptr<Method> make_loffler(const MethodSpec& spec, std::string& problem) {
  const LofflerSettings settings = loffler_settings(spec, problem);
  if (!problem.empty()) return nullptr;
  return std::make_unique<Loffler>(settings);
}

}  // namespace ridgeline::sim
