#pragma once
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/render/frame_blocks.hpp"
#include "core/render/gl_object.hpp"
#include "platform/egl_context.hpp"

namespace ridgeline::test {

/// Posts of a window of one level, row by row from the texture's first row.
struct ProbePosts {
  int columns = 0, rows = 0;
  std::vector<float> heights_m;
};

/// Runs functions of the ray cast pass itself on the GL driver, many calls at once.
///
/// The program is the embedded text of that pass up to its main(), then `body`: statements that
/// read `in_a`, `in_b` and write `out_a`, `out_b` (vec4). So what is measured is the arithmetic
/// that draws, not a copy of it.
class ShaderProbe {
 public:
  explicit ShaderProbe(std::string_view body);

  void set_blocks(const FrameBlocks& blocks);
  void set_posts(const ProbePosts& posts);
  /// Node (plane, row) holds `plane + row * planes`: what proven_empty() returns then names it.
  /// Domain: planes * rows < 2^24; after set_blocks().
  void number_nodes(int planes, int rows);

  struct Call {
    glm::vec4 a{}, b{};
  };
  /// One invocation for each input, in order.
  std::vector<Call> run(std::span<const Call> inputs);

  [[nodiscard]] static const char* driver();

 private:
  Program program_;
  FrameBlocks shown_;
  Buffer frame_, grid_;
  Texture posts_, nodes_;
};

}  // namespace ridgeline::test
