#include "sim/methods/pgm.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/ground_frag.hpp"
#include "shaders/pgm_vert.hpp"
#include "sim/methods/post_pyramid.hpp"
#include "sim/methods/raster_target.hpp"
#include "sim/methods/sampling_camera.hpp"
#include "sim/methods/setting_reader.hpp"

namespace ridgeline::sim {
namespace {

constexpr int least_side = 16, most_side = 2048;
constexpr double least_depth_m = 10.0;   ///< of the base plane under the eye
constexpr double clamped_range = 1.004;  ///< no vertex stands beyond it; past the last row's rays
constexpr int band = 63;                 ///< quads across a band of the index buffer
constexpr int vertex_slots = 64;         ///< a row's vertex numbers, modulo 256

struct PgmSettings {
  int columns = 512, rows = 256;
};

/// Vertex numbers a row. Drivers keep the last vertices in a small table by their number; with 64
/// modulo 256 four rows of a band of 64 columns fit one of 256 without pushing each other out.
int row_stride(int columns) {
  const int rest = columns % 256;
  return columns + (rest <= vertex_slots ? vertex_slots - rest : 256 + vertex_slots - rest);
}

/// Two triangles a quad, in bands of columns, so that a vertex is shaded about once.
std::vector<std::uint32_t> grid_indices(int columns, int rows) {
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(6) * (columns - 1) * (rows - 1));
  const auto stride = static_cast<std::uint32_t>(row_stride(columns));
  for (int first = 0; first < columns - 1; first += band) {
    for (int row = 0; row < rows - 1; ++row) {
      for (int column = first; column < std::min(first + band, columns - 1); ++column) {
        const std::uint32_t a = static_cast<std::uint32_t>(row) * stride + column;
        const std::uint32_t b = a + 1, c = a + stride, d = c + 1;
        indices.insert(indices.end(), {a, c, b, b, c, d});
      }
    }
  }
  return indices;
}

class Pgm final : public Method {
 public:
  explicit Pgm(const PgmSettings& settings) : settings_(settings) {}
  [[nodiscard]] std::string_view name() const override { return "pgm"; }
  [[nodiscard]] std::string params() const override {
    return "grid " + std::to_string(settings_.columns) + "x" + std::to_string(settings_.rows);
  }
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  [[nodiscard]] MethodFacts facts() override;

 private:
  Outcome make_objects();
  [[nodiscard]] BasePlane base_plane(const RangeScene& scene) const;
  [[nodiscard]] std::size_t index_count() const {
    return static_cast<std::size_t>(6) * (settings_.columns - 1) * (settings_.rows - 1);
  }

  PgmSettings settings_;
  Program program_;
  Buffer indices_;
  VertexArray vertices_;
  RasterTarget target_;
  PostPyramid pyramid_;
  CoarseGround ground_;
  double lowest_m_ = 0, highest_m_ = 0;
};

Outcome Pgm::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  lowest_m_ = terrain.lowest_m;
  highest_m_ = terrain.highest_m;
  ground_.build(terrain);
  Outcome made = pyramid_.build(terrain.view, PostPyramid::Filter::box);
  if (made.ok()) made = target_.make(sizes);
  if (made.ok() && program_.name() == 0) made = make_objects();
  return made;
}

Outcome Pgm::make_objects() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  vertices_ = VertexArray(name);
  glBindVertexArray(name);
  const std::vector<std::uint32_t> indices = grid_indices(settings_.columns, settings_.rows);
  const std::size_t bytes = indices.size() * sizeof indices[0];
  Outcome made =
      make_method_buffer("pgm", GL_ELEMENT_ARRAY_BUFFER, bytes, GL_STATIC_DRAW, indices_);
  if (!made.ok()) return made;
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), indices.data());
  glBindVertexArray(0);
  return make_method_program("pgm", shader::pgm_vert, shader::ground_frag, program_);
}

BasePlane Pgm::base_plane(const RangeScene& scene) const {
  const double most_m = scene.report.local.eye.height_m - least_depth_m;
  return {std::min({0.0, lowest_m_, most_m}), ground_.below_eye_m(scene.view, lowest_m_), lowest_m_,
          highest_m_, scene.report.range_m};
}

void Pgm::draw(const RangeScene& scene) {
  target_.begin(scene.renderer);
  const SamplingCamera sampling =
      sampling_camera(scene.report.camera, scene.report.local.eye.height_m, base_plane(scene),
                      settings_.columns, settings_.rows);
  if (!sampling.empty) {
    glUseProgram(program_.name());
    const auto put = [](GLint location, const glm::dvec3& v) {
      glUniform3f(location, static_cast<float>(v.x), static_cast<float>(v.y),
                  static_cast<float>(v.z));
    };
    put(0, sampling.corner);
    put(1, sampling.across);
    put(2, sampling.down);
    glUniform2f(3, static_cast<float>(sampling.depth_m),
                static_cast<float>(clamped_range * scene.report.range_m));
    glUniform1i(4, row_stride(settings_.columns));
    pyramid_.bind();
    glBindVertexArray(vertices_.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(index_count()), GL_UNSIGNED_INT, nullptr);
  }
  target_.end();
}

MethodFacts Pgm::facts() {
  MethodFacts facts;
  facts.gpu_bytes =
      target_.gpu_bytes() + pyramid_.gpu_bytes() + index_count() * sizeof(std::uint32_t);
  facts.heap_bytes = ground_.heap_bytes();
  return facts;
}

}  // namespace

std::unique_ptr<Method> make_pgm(const MethodSpec& spec, std::string& problem) {
  PgmSettings settings;
  SettingReader reader(spec);
  reader.grid("grid", settings.columns, settings.rows, least_side, most_side);
  problem = reader.problem();
  if (!problem.empty()) return nullptr;
  return std::make_unique<Pgm>(settings);
}

}  // namespace ridgeline::sim
