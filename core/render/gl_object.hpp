#pragma once
#include <GLES3/gl31.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/result.hpp"

namespace ridgeline {

/// A GL name that is deleted once. Move-only; made at boot, never in a frame.
template <void (*Delete)(GLuint)>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint name) : name_(name) {}
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      if (name_ != 0) Delete(name_);
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (name_ != 0) Delete(name_);
  }
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

void delete_texture(GLuint name);
void delete_buffer(GLuint name);
void delete_framebuffer(GLuint name);
void delete_program(GLuint name);
void delete_vertex_array(GLuint name);
void delete_sampler(GLuint name);

using Texture = GlObject<delete_texture>;
using Buffer = GlObject<delete_buffer>;
using Framebuffer = GlObject<delete_framebuffer>;
using Program = GlObject<delete_program>;
using VertexArray = GlObject<delete_vertex_array>;
using Sampler = GlObject<delete_sampler>;

/// Bytes of GL storage asked for since boot; what the report calls gpu_bytes.
[[nodiscard]] std::size_t gl_bytes_allocated();

/// Immutable 2-D texture, nearest filtering, clamped.
/// Errors: Fault::gl_out_of_memory.
Result<Texture> make_texture(GLenum internal_format, int width, int height, int levels,
                             std::size_t texel_bytes);

/// Immutable array of 2-D textures, nearest filtering, clamped.
/// Errors: Fault::gl_out_of_memory.
Result<Texture> make_texture_array(GLenum internal_format, int width, int height, int layers,
                                   std::size_t texel_bytes);

/// How a texture is read, whatever it says itself: clamped, one level.
Sampler make_sampler(GLint filter);

/// Buffer of fixed size with undefined contents.
/// Errors: Fault::gl_out_of_memory.
Result<Buffer> make_buffer(GLenum target, std::size_t size_bytes, GLenum usage);

/// Receives the compiler's or linker's log; called at boot only.
using ShaderLog = void (*)(std::string_view program, std::string_view log);

/// Program of one compute shader. Errors: Fault::gl_shader, after calling `log`.
/// `defines`: lines that come right after the first line of every source.
Result<Program> make_compute_program(std::string_view name, std::string_view source, ShaderLog log,
                                     std::string_view defines = "");

/// Program of a vertex and a fragment shader. Errors: Fault::gl_shader, after calling `log`.
Result<Program> make_draw_program(std::string_view name, std::string_view vertex,
                                  std::string_view fragment, ShaderLog log,
                                  std::string_view defines = "");

}  // namespace ridgeline
