#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "core/render/renderer.hpp"
#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// Steps of the marches of one frame over the terrain.
struct StepCounts {
  std::uint64_t nodes = 0;       ///< of a pyramid, looked at by rays
  std::uint64_t cells = 0;       ///< surfaces that rays were met with, or points of them
  std::uint64_t grid_nodes = 0;  ///< looked at by the planes of a projected grid
};

/// Which of the counters a program adds to.
enum class StepsOf : std::uint8_t { rays, grid };

/// The source of a pass as a variant that counts its steps: count_node and count_cell of
/// shaders/terrain.glsl then mean something.
[[nodiscard]] std::string counting_source(std::string_view source, StepsOf steps);

/// The counting variant of a method's draw program, and which of the two is in use.
class CountingProgram {
 public:
  struct Sources {
    std::string_view name, vertex, fragment;
  };
  /// Puts the variant (made when first asked for) into `program`, or what was there back.
  /// Outcome: gl_shader.
  Outcome use(bool counting, const Sources& sources, Program& program);

 private:
  Program other_;
  bool counting_ = false;
};

/// Counts the steps of frames in variants of their programs, so that those that are timed are
/// exactly those that fly. Frames drawn while it counts take several times as long and show the
/// same picture.
/// A context must be current whenever a member is called.
class StepCounter {
 public:
  /// Whether fragments of this driver may count.
  [[nodiscard]] static bool possible();
  /// Makes the buffer and the counting variants of the module's own passes; later calls do nothing.
  /// Outcome: gl_shader, gl_out_of_memory.
  Outcome make(const Renderer& renderer);
  /// Puts the counting variants into the renderer, or the others back.
  void exchange(Renderer& renderer) { renderer.exchange_marches(sweep_, ray_cast_); }

  /// Counts from here on, from 0.
  void begin();
  /// Ends it. Waits for the GPU.
  [[nodiscard]] StepCounts end();

 private:
  Buffer buffer_;
  Program sweep_, ray_cast_;
};

}  // namespace ridgeline::sim
