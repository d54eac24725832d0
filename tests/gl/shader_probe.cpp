#include "tests/gl/shader_probe.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "shaders/ray_cast_frag.hpp"

namespace ridgeline::test {
namespace {

[[noreturn]] void give_up(std::string_view what) {
  std::fprintf(stderr, "shader_probe: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

void cut(std::string& text, std::string_view what) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) give_up("the ray cast pass has changed: " + std::string(what));
  text.erase(at, what.size());
}

/// Members of uniform blocks that reach the pass as inputs are read from the blocks again.
void take_from_blocks(std::string& text) {
  const std::string_view sent = "uniform_", declared = "flat in ";
  for (std::size_t at = text.find(sent); at != std::string::npos; at = text.find(sent, at)) {
    text.erase(at, sent.size());
  }
  for (std::size_t at = text.find(declared); at != std::string::npos;
       at = text.find(declared, at)) {
    text.erase(at, text.find(';', at) + 1 - at);
  }
}

/// The pass as a compute shader: its functions, none of its inputs and outputs.
std::string source_of(std::string_view body) {
  std::string text(shader::ray_cast_frag);
  const std::size_t end = text.find("void main()");
  if (end == std::string::npos) give_up("the ray cast pass has no main()");
  text.resize(end);
  cut(text, "layout(location = 0) out highp uint range_bits;");
  take_from_blocks(text);
  const std::string_view head = "precision highp int;\n";
  const std::size_t after = text.find(head);
  if (after == std::string::npos) give_up("the ray cast pass has no precision line");
  text.insert(after + head.size(),
              "layout(local_size_x = 64) in;\nconst ivec4 tile = ivec4(0, 0, 0, 65537);\n");
  text +=
      "layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };\n"
      "void main() {\n"
      "  int i = 2 * int(gl_GlobalInvocationID.x);\n"
      "  if (i >= inputs.length()) return;\n"
      "  vec4 in_a = inputs[i], in_b = inputs[i + 1], out_a = vec4(0.0), out_b = vec4(0.0);\n";
  text += body;
  text += "\n  outputs[i] = out_a;\n  outputs[i + 1] = out_b;\n}\n";
  return text;
}

void print_log(std::string_view name, std::string_view log) {
  std::fprintf(stderr, "%.*s: %.*s\n", static_cast<int>(name.size()), name.data(),
               static_cast<int>(log.size()), log.data());
}

EglContext& context() {
  static Result<EglContext> made = EglContext::make();
  if (!made) give_up("no OpenGL ES 3.1 context");
  return made.value();
}

template <typename T>
T taken(Result<T> result) {
  if (!result) give_up("an OpenGL object could not be made");
  return std::move(result).value();
}

template <typename Block>
void put(Buffer& buffer, const Block& block, int binding) {
  if (buffer.name() == 0) {
    buffer = taken(make_buffer(GL_UNIFORM_BUFFER, sizeof block, GL_DYNAMIC_DRAW));
  }
  glBindBuffer(GL_UNIFORM_BUFFER, buffer.name());
  glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), buffer.name());
}

}  // namespace

ShaderProbe::ShaderProbe(std::string_view body) {
  context();
  program_ = taken(make_compute_program("probe", source_of(body), print_log));
}

const char* ShaderProbe::driver() {
  return context().description();
}

void ShaderProbe::set_blocks(const FrameBlocks& blocks) {
  shown_ = blocks;
  put(frame_, blocks.frame, shader::frame_block_binding);
  put(grid_, blocks.grid, shader::grid_block_binding);
}

void ShaderProbe::set_posts(const ProbePosts& posts) {
  // As the renderer keeps them: the first column and row behind the last once more.
  const int columns = posts.columns + 1, rows = posts.rows + 1;
  std::vector<float> kept;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      kept.push_back(posts.heights_m[static_cast<std::size_t>(y % posts.rows * posts.columns +
                                                              x % posts.columns)]);
    }
  }
  posts_ = taken(make_texture_array(GL_R32F, columns, rows, 1, 4));
  glActiveTexture(GL_TEXTURE0 + shader::posts_unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, posts_.name());
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, columns, rows, 1, GL_RED, GL_FLOAT, kept.data());
}

void ShaderProbe::number_nodes(int planes, int rows) {
  shown_.frame.ray_target.z = 1.0F / static_cast<float>(planes);
  shown_.frame.ray_target.w = 1.0F / static_cast<float>(rows);
  set_blocks(shown_);
  std::vector<float> numbers(static_cast<std::size_t>(planes) * static_cast<std::size_t>(rows));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<float>(i);
  nodes_ = taken(make_texture(GL_R32F, planes, rows, 1, 4));
  glActiveTexture(GL_TEXTURE0 + shader::nodes_unit);
  glBindTexture(GL_TEXTURE_2D, nodes_.name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, planes, rows, GL_RED, GL_FLOAT, numbers.data());
}

std::vector<ShaderProbe::Call> ShaderProbe::run(std::span<const Call> inputs) {
  constexpr GLenum ssbo = GL_SHADER_STORAGE_BUFFER;
  const std::size_t bytes = inputs.size_bytes();
  Buffer in = taken(make_buffer(ssbo, bytes, GL_STATIC_DRAW));
  glBindBuffer(ssbo, in.name());
  glBufferSubData(ssbo, 0, static_cast<GLsizeiptr>(bytes), inputs.data());
  Buffer out = taken(make_buffer(ssbo, bytes, GL_DYNAMIC_READ));
  glBindBufferBase(ssbo, 0, in.name());
  glBindBufferBase(ssbo, 1, out.name());
  glUseProgram(program_.name());
  glDispatchCompute(static_cast<GLuint>((inputs.size() + 63) / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<Call> outputs(inputs.size());
  glBindBuffer(ssbo, out.name());
  const void* data = glMapBufferRange(ssbo, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
  if (data == nullptr || glGetError() != GL_NO_ERROR) give_up("the results cannot be read");
  std::memcpy(outputs.data(), data, bytes);
  glUnmapBuffer(ssbo);
  return outputs;
}

}  // namespace ridgeline::test
