#include "core/render/gl_object.hpp"

#include <algorithm>
#include <array>

namespace ridgeline {
namespace {

std::size_t bytes_allocated = 0;

Result<GLuint> compile(std::string_view name, GLenum stage, std::string_view source,
                       std::string_view defines, ShaderLog log) {
  const GLuint shader = glCreateShader(stage);
  const std::size_t version = source.find('\n') + 1;  // must stay the first line
  const std::array<const GLchar*, 3> text{source.data(), defines.data(), source.data() + version};
  const std::array<GLint, 3> length{static_cast<GLint>(version), static_cast<GLint>(defines.size()),
                                    static_cast<GLint>(source.size() - version)};
  glShaderSource(shader, 3, text.data(), length.data());
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<GLchar, 4096> message{};
  GLsizei count = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(message.size()), &count, message.data());
  if (log != nullptr) log(name, {message.data(), static_cast<std::size_t>(count)});
  glDeleteShader(shader);
  return Fault::gl_shader;
}

Result<Program> link(std::string_view name, std::span<const GLuint> shaders, ShaderLog log) {
  Program program(glCreateProgram());
  for (const GLuint shader : shaders) glAttachShader(program.name(), shader);
  glLinkProgram(program.name());
  for (const GLuint shader : shaders) glDeleteShader(shader);
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::array<GLchar, 4096> message{};
  GLsizei count = 0;
  glGetProgramInfoLog(program.name(), static_cast<GLsizei>(message.size()), &count, message.data());
  if (log != nullptr) log(name, {message.data(), static_cast<std::size_t>(count)});
  return Fault::gl_shader;
}

}  // namespace

void delete_texture(GLuint name) {
  glDeleteTextures(1, &name);
}
void delete_buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
void delete_framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
void delete_program(GLuint name) {
  glDeleteProgram(name);
}
void delete_vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}

void delete_sampler(GLuint name) {
  glDeleteSamplers(1, &name);
}

std::size_t gl_bytes_allocated() {
  return bytes_allocated;
}

Result<Texture> make_texture(GLenum internal_format, int width, int height, int levels,
                             std::size_t texel_bytes) {
  while (glGetError() != GL_NO_ERROR) {
  }
  GLuint name = 0;
  glGenTextures(1, &name);
  Texture texture(name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexStorage2D(GL_TEXTURE_2D, levels, internal_format, width, height);
  if (glGetError() != GL_NO_ERROR) return Fault::gl_out_of_memory;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                  levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  for (int level = 0; level < levels; ++level) {
    bytes_allocated += static_cast<std::size_t>(std::max(width >> level, 1)) *
                       static_cast<std::size_t>(std::max(height >> level, 1)) * texel_bytes;
  }
  return texture;
}

Sampler make_sampler(GLint filter) {
  GLuint name = 0;
  glGenSamplers(1, &name);
  for (const GLenum which : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glSamplerParameteri(name, which, filter);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glSamplerParameteri(name, wrap, GL_CLAMP_TO_EDGE);
  }
  return Sampler(name);
}

Result<Texture> make_texture_array(GLenum internal_format, int width, int height, int layers,
                                   std::size_t texel_bytes) {
  while (glGetError() != GL_NO_ERROR) {
  }
  GLuint name = 0;
  glGenTextures(1, &name);
  Texture texture(name);
  glBindTexture(GL_TEXTURE_2D_ARRAY, name);
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, internal_format, width, height, layers);
  if (glGetError() != GL_NO_ERROR) return Fault::gl_out_of_memory;
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D_ARRAY, filter, GL_NEAREST);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D_ARRAY, wrap, GL_CLAMP_TO_EDGE);
  }
  bytes_allocated += static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                     static_cast<std::size_t>(layers) * texel_bytes;
  return texture;
}

Result<Buffer> make_buffer(GLenum target, std::size_t size_bytes, GLenum usage) {
  while (glGetError() != GL_NO_ERROR) {
  }
  GLuint name = 0;
  glGenBuffers(1, &name);
  Buffer buffer(name);
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(size_bytes), nullptr, usage);
  if (glGetError() != GL_NO_ERROR) return Fault::gl_out_of_memory;
  bytes_allocated += size_bytes;
  return buffer;
}

Result<Program> make_compute_program(std::string_view name, std::string_view source, ShaderLog log,
                                     std::string_view defines) {
  const auto shader = compile(name, GL_COMPUTE_SHADER, source, defines, log);
  if (!shader) return shader.fault();
  return link(name, std::array{shader.value()}, log);
}

Result<Program> make_draw_program(std::string_view name, std::string_view vertex,
                                  std::string_view fragment, ShaderLog log,
                                  std::string_view defines) {
  const auto first = compile(name, GL_VERTEX_SHADER, vertex, defines, log);
  if (!first) return first.fault();
  const auto second = compile(name, GL_FRAGMENT_SHADER, fragment, defines, log);
  if (!second) {
    glDeleteShader(first.value());
    return second.fault();
  }
  return link(name, std::array{first.value(), second.value()}, log);
}

}  // namespace ridgeline
