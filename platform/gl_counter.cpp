#include "platform/gl_counter.hpp"

#include <GLES3/gl31.h>

#include <atomic>

namespace {
std::atomic<std::uint64_t> seen{0};
std::atomic<std::uint64_t> counted{0};
thread_local bool counting = false;

void count() {
  seen.fetch_add(1, std::memory_order_relaxed);
  if (counting) counted.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// The linker sends our objects' calls here: -Wl,--wrap=glGenTextures and so on.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier)
void __real_glGenTextures(GLsizei n, GLuint* names);
void __real_glGenBuffers(GLsizei n, GLuint* names);
void __real_glGenFramebuffers(GLsizei n, GLuint* names);
void __real_glGenVertexArrays(GLsizei n, GLuint* names);
void __real_glGenSamplers(GLsizei n, GLuint* names);
GLuint __real_glCreateShader(GLenum type);
GLuint __real_glCreateProgram();
void __real_glBufferData(GLenum target, GLsizeiptr size, const void* data, GLenum usage);
void __real_glTexStorage2D(GLenum target, GLsizei levels, GLenum format, GLsizei w, GLsizei h);
void __real_glTexStorage3D(GLenum target, GLsizei levels, GLenum format, GLsizei w, GLsizei h,
                           GLsizei d);

void __wrap_glGenTextures(GLsizei n, GLuint* names) {
  count();
  __real_glGenTextures(n, names);
}
void __wrap_glGenBuffers(GLsizei n, GLuint* names) {
  count();
  __real_glGenBuffers(n, names);
}
void __wrap_glGenFramebuffers(GLsizei n, GLuint* names) {
  count();
  __real_glGenFramebuffers(n, names);
}
void __wrap_glGenVertexArrays(GLsizei n, GLuint* names) {
  count();
  __real_glGenVertexArrays(n, names);
}
void __wrap_glGenSamplers(GLsizei n, GLuint* names) {
  count();
  __real_glGenSamplers(n, names);
}
GLuint __wrap_glCreateShader(GLenum type) {
  count();
  return __real_glCreateShader(type);
}
GLuint __wrap_glCreateProgram() {
  count();
  return __real_glCreateProgram();
}
void __wrap_glBufferData(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
  count();
  __real_glBufferData(target, size, data, usage);
}
void __wrap_glTexStorage2D(GLenum target, GLsizei levels, GLenum format, GLsizei w, GLsizei h) {
  count();
  __real_glTexStorage2D(target, levels, format, w, h);
}
void __wrap_glTexStorage3D(GLenum target, GLsizei levels, GLenum format, GLsizei w, GLsizei h,
                           GLsizei d) {
  count();
  __real_glTexStorage3D(target, levels, format, w, h, d);
}
// NOLINTEND(bugprone-reserved-identifier)
}

namespace ridgeline {

GlSection::GlSection() {
  counting = true;
}
GlSection::~GlSection() {
  counting = false;
}
std::uint64_t gl_creations_counted() {
  return counted.load(std::memory_order_relaxed);
}
std::uint64_t gl_creations_seen() {
  return seen.load(std::memory_order_relaxed);
}

}  // namespace ridgeline
