#include "sim/methods/raster_target.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>

namespace ridgeline::sim {
namespace {

constexpr float sky = 1e30f;

void print_log(std::string_view program, std::string_view log) {
  std::fprintf(stderr, "shader %.*s: %.*s\n", static_cast<int>(program.size()), program.data(),
               static_cast<int>(log.size()), log.data());
}

template <typename T>
Outcome take(std::string_view name, Result<T> made, T& target) {
  if (!made) return failed(made.fault(), "method " + std::string(name));
  target = std::move(made).value();
  return {};
}

}  // namespace

Outcome RasterTarget::make(const RenderSizes& sizes) {
  if (sizes.width_px == width_px_ && sizes.height_px == height_px_) return {};
  Outcome made = take(
      "depth", make_texture(GL_DEPTH_COMPONENT32F, sizes.width_px, sizes.height_px, 1, 4), depth_);
  if (!made.ok()) return made;
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  target_ = Framebuffer(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  attached_ = 0;
  width_px_ = sizes.width_px;
  height_px_ = sizes.height_px;
  return {};
}

void RasterTarget::begin(const Renderer& renderer) {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  if (const GLuint range = renderer.names().range; range != attached_) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, range, 0);
    attached_ = range;
  }
  glViewport(0, 0, width_px_, height_px_);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DITHER);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  const auto word = std::bit_cast<std::uint32_t>(sky);
  const GLuint words[4] = {word, word, word, word};
  const GLfloat far = 1.0f;
  glClearBufferuiv(GL_COLOR, 0, words);
  glClearBufferfv(GL_DEPTH, 0, &far);
}

void RasterTarget::end() {
  glDisable(GL_DEPTH_TEST);
}

std::size_t RasterTarget::gpu_bytes() const {
  return sizeof(float) * static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
}

Outcome make_method_program(std::string_view name, std::string_view vertex,
                            std::string_view fragment, Program& program, std::string_view defines) {
  return take(name, make_draw_program(name, vertex, fragment, print_log, defines), program);
}

Outcome make_method_program(std::string_view name, std::string_view compute, Program& program,
                            std::string_view defines) {
  return take(name, make_compute_program(name, compute, print_log, defines), program);
}

Outcome make_method_buffer(std::string_view name, GLenum target, std::size_t size_bytes,
                           GLenum usage, Buffer& buffer) {
  return take(name, make_buffer(target, size_bytes, usage), buffer);
}

}  // namespace ridgeline::sim
