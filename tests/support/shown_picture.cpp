#include "tests/support/shown_picture.hpp"

#include <cstdlib>
#include <utility>

namespace ridgeline::test {
namespace {

constexpr std::string_view whole_vertex = R"(#version 310 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

constexpr std::string_view known_fragment = R"(#version 310 es
precision highp float;
layout(location = 0) uniform uint frame;
layout(location = 1) uniform uint height;
layout(location = 0) out vec4 colour;
void main() {
  uint x = uint(gl_FragCoord.x), y = height - 1u - uint(gl_FragCoord.y);
  uvec3 c = uvec3(x * 7u + frame * 31u, y * 5u + x / 256u + frame, (x ^ y) + y / 256u + frame * 3u);
  colour = vec4(vec3(c & 255u) / 255.0, 0.5);
}
)";

constexpr std::string_view slow_fragment = R"(#version 310 es
precision highp float;
layout(location = 0) uniform uint steps;
layout(location = 0) out vec4 colour;
void main() {
  uint x = uint(gl_FragCoord.x) + 1u;
  for (uint i = 0u; i < steps; ++i) x = x * 1664525u + 1013904223u;
  colour = vec4(float(x & 255u) / 255.0);
}
)";

Program program(std::string_view fragment) {
  auto made = make_draw_program("picture", whole_vertex, fragment, nullptr);
  if (!made) std::abort();
  return std::move(made).value();
}

}  // namespace

ShownPicture::ShownPicture(int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px), program_(program(known_fragment)) {
  auto colour = make_texture(GL_RGBA8, width_px, height_px, 1, 4);
  if (!colour) std::abort();
  colour_ = std::move(colour).value();
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  target_ = Framebuffer(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
  glGenVertexArrays(1, &name);
  none_ = VertexArray(name);
}

void ShownPicture::draw(std::uint32_t frame) {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, width_px_, height_px_);
  glUseProgram(program_.name());
  glUniform1ui(0, frame);
  glUniform1ui(1, static_cast<GLuint>(height_px_));
  glBindVertexArray(none_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

std::uint32_t ShownPicture::pixel(std::uint32_t frame, int column, int row) {
  const auto x = static_cast<std::uint32_t>(column);
  const auto y = static_cast<std::uint32_t>(row);
  const std::uint32_t red = (x * 7 + frame * 31) & 255;
  const std::uint32_t green = (y * 5 + x / 256 + frame) & 255;
  const std::uint32_t blue = ((x ^ y) + y / 256 + frame * 3) & 255;
  return red << 16 | green << 8 | blue;
}

int ShownPicture::wrong_pixels(std::uint32_t frame, const std::uint32_t* shown, std::size_t stride,
                               int width_px, int height_px) {
  int wrong = 0;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const std::uint32_t seen =
          shown[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
      wrong += (seen & 0xFFFFFF) != pixel(frame, x, y) ? 1 : 0;
    }
  }
  return wrong;
}

void draw_slowly(const ShownPicture& picture, int steps) {
  GLuint target = 0;
  glGenFramebuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.texture(), 0);
  glViewport(0, 0, picture.width_px(), picture.height_px());
  const Program slow = program(slow_fragment);
  GLuint vertices = 0;
  glGenVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glUseProgram(slow.name());
  glUniform1ui(0, static_cast<GLuint>(steps));
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDeleteVertexArrays(1, &vertices);
  glDeleteFramebuffers(1, &target);
}

}  // namespace ridgeline::test
