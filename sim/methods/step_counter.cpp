#include "sim/methods/step_counter.hpp"

#include <array>
#include <utility>

#include "shaders/ray_cast_frag.hpp"
#include "shaders/ray_cast_vert.hpp"
#include "shaders/sweep_comp.hpp"
#include "sim/methods/raster_target.hpp"

namespace ridgeline::sim {
namespace {

/// Nodes and cells of rays, then of a grid, which has no cells.
constexpr std::size_t counter_count = 4, counters_a_program = 2;
using Counters = std::array<std::uint32_t, counter_count>;

GLint limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

std::string counting_source(std::string_view source, StepsOf steps) {
  const std::size_t version = source.find('\n') + 1;  // must stay the first line
  const std::size_t first = steps == StepsOf::rays ? 0 : counters_a_program;
  return std::string(source.substr(0, version)) + "#define count_steps " + std::to_string(first) +
         "\n" + std::string(source.substr(version));
}

Outcome CountingProgram::use(bool counting, const Sources& sources, Program& program) {
  if (counting == counting_) return {};
  if (other_.name() == 0) {
    const Outcome made = make_method_program(
        sources.name, sources.vertex, counting_source(sources.fragment, StepsOf::rays), other_);
    if (!made.ok()) return made;
  }
  std::swap(other_, program);
  counting_ = counting;
  return {};
}

bool StepCounter::possible() {
  return limit(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS) > 0 &&
         limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS) > shader::steps_buffer;
}

Outcome StepCounter::make(const Renderer& renderer) {
  if (buffer_.name() != 0) return {};
  const std::string_view defines = renderer.march_defines();
  Outcome made = make_method_program(
      "counting sweep", counting_source(shader::sweep_comp, StepsOf::grid), sweep_, defines);
  if (made.ok()) {
    made = make_method_program("counting ray_cast", shader::ray_cast_vert,
                               counting_source(shader::ray_cast_frag, StepsOf::rays), ray_cast_,
                               defines);
  }
  if (!made.ok()) return made;
  return make_method_buffer("step counter", GL_SHADER_STORAGE_BUFFER, sizeof(Counters),
                            GL_DYNAMIC_READ, buffer_);
}

void StepCounter::begin() {
  const Counters zeros{};
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shader::steps_buffer, buffer_.name());
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof zeros, zeros.data());
}

StepCounts StepCounter::end() {
  StepCounts result;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shader::steps_buffer, buffer_.name());
  const auto* counters = static_cast<const std::uint32_t*>(
      glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, sizeof(Counters), GL_MAP_READ_BIT));
  RL_ASSERT(counters != nullptr);
  result = {counters[0], counters[1], counters[counters_a_program]};
  glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shader::steps_buffer, 0);
  return result;
}

}  // namespace ridgeline::sim
