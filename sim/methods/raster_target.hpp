#pragma once
#include <string>
#include <string_view>

#include "core/render/renderer.hpp"
#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// The renderer's range picture as a target of geometry, with a depth buffer of its own. Shared by
/// every method that draws triangles; their fragments end in put_ground() of raster.glsl.
/// A context must be current whenever a member is called.
class RasterTarget {
 public:
  /// Makes the depth buffer (32-bit float) once; later calls for the same size do nothing.
  /// Outcome: gl_out_of_memory.
  Outcome make(const RenderSizes& sizes);
  /// Binds it for drawing with depth test, no culling, no blending, and clears it to sky.
  void begin(const Renderer& renderer);
  /// Ends it: the depth test is off again.
  void end();
  [[nodiscard]] std::size_t gpu_bytes() const;

 private:
  Framebuffer target_;
  Texture depth_;
  GLuint attached_ = 0;
  int width_px_ = 0, height_px_ = 0;
};

/// Makes a draw program of a method; the compiler's log goes to standard error.
/// `defines`: as make_draw_program() takes them. Outcome: gl_shader naming the program.
Outcome make_method_program(std::string_view name, std::string_view vertex,
                            std::string_view fragment, Program& program,
                            std::string_view defines = "");
/// The same of one compute shader.
Outcome make_method_program(std::string_view name, std::string_view compute, Program& program,
                            std::string_view defines = "");

/// Makes a buffer; `size_bytes` > 0. Outcome: gl_out_of_memory naming what it is for.
Outcome make_method_buffer(std::string_view name, GLenum target, std::size_t size_bytes,
                           GLenum usage, Buffer& buffer);

}  // namespace ridgeline::sim
