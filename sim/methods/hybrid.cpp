#include "sim/methods/hybrid.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>

#include "shaders/hybrid_cast_frag.hpp"
#include "shaders/hybrid_cast_vert.hpp"
#include "shaders/hybrid_mesh_frag.hpp"
#include "shaders/hybrid_mesh_vert.hpp"
#include "sim/methods/hybrid_cells.hpp"
#include "sim/methods/raster_target.hpp"
#include "sim/methods/setting_reader.hpp"
#include "sim/methods/step_counter.hpp"

namespace ridgeline::sim {
namespace {

constexpr int side_location = 0, any_unknown_location = 1;  // as in the shaders
constexpr float sky = 1e30f;

struct HybridSettings {
  double t = 70, k = 1.3;
  int cell = 128;
};

/// As hybrid_mesh.vert and hybrid_cast.vert read it.
struct Instance {
  std::int32_t column = 0, row = 0, level = 0, steps = 0;
  float low_m = 0, high_m = 0;
  float distance_m = 0;  ///< for the order only
};

/// A program with its indices and one instance a cell.
struct CellPass {
  Program program;
  Buffer indices, instances;
  VertexArray vertices;
  GLsizei index_count = 0;
  std::size_t capacity = 0;
  std::vector<Instance> chosen;

  Outcome make_vertices(const std::vector<std::uint16_t>& list);
  Outcome make_instances(std::size_t most);
  void draw(int side) const;
};

Outcome CellPass::make_vertices(const std::vector<std::uint16_t>& list) {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  vertices = VertexArray(name);
  glBindVertexArray(name);
  const std::size_t bytes = list.size() * sizeof list[0];
  Outcome made =
      make_method_buffer("hybrid", GL_ELEMENT_ARRAY_BUFFER, bytes, GL_STATIC_DRAW, indices);
  if (!made.ok()) return made;
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), list.data());
  glBindVertexArray(0);
  index_count = static_cast<GLsizei>(list.size());
  return made;
}

Outcome CellPass::make_instances(std::size_t most) {
  chosen.clear();
  chosen.reserve(most);
  if (most <= capacity) return {};
  glBindVertexArray(vertices.name());
  Outcome made = make_method_buffer("hybrid", GL_ARRAY_BUFFER, most * sizeof(Instance),
                                    GL_DYNAMIC_DRAW, instances);
  if (!made.ok()) return made;
  capacity = most;
  const auto* const heights = static_cast<const std::byte*>(nullptr) + offsetof(Instance, low_m);
  glEnableVertexAttribArray(0);
  glVertexAttribIPointer(0, 4, GL_INT, sizeof(Instance), nullptr);
  glVertexAttribDivisor(0, 1);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Instance), heights);
  glVertexAttribDivisor(1, 1);
  glBindVertexArray(0);
  return made;
}

void CellPass::draw(int side) const {
  if (chosen.empty()) return;
  glBindBuffer(GL_ARRAY_BUFFER, instances.name());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(chosen.size() * sizeof(Instance)),
                  chosen.data());
  glUseProgram(program.name());
  glUniform1i(side_location, side);
  glBindVertexArray(vertices.name());
  glDrawElementsInstanced(GL_TRIANGLES, index_count, GL_UNSIGNED_SHORT, nullptr,
                          static_cast<GLsizei>(chosen.size()));
}

std::vector<std::uint16_t> mesh_indices(int side) {
  std::vector<std::uint16_t> indices;
  indices.reserve(6 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int sw = row * (side + 1) + column, se = sw + 1, nw = sw + side + 1, ne = nw + 1;
      for (const int index : {sw, se, ne, sw, ne, nw}) {
        indices.push_back(static_cast<std::uint16_t>(index));
      }
    }
  }
  return indices;
}

/// Corners as hybrid_cast.vert numbers them; seen from outside, faces turn counterclockwise.
std::vector<std::uint16_t> box_indices() {
  std::vector<std::uint16_t> indices;
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    for (const int i : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(face[i]));
  }
  return indices;
}

class Hybrid final : public Method {
 public:
  explicit Hybrid(const HybridSettings& settings) : settings_(settings) {}
  [[nodiscard]] std::string_view name() const override { return "hybrid"; }
  [[nodiscard]] std::string params() const override;
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  void warm_up(const RangeScene& scene) override;
  [[nodiscard]] RaySteps ray_steps() const override { return RaySteps::counted; }
  Outcome use_counting(bool counting) override {
    return counting_.use(counting,
                         {"hybrid_cast", shader::hybrid_cast_vert, shader::hybrid_cast_frag},
                         cast_.program);
  }
  [[nodiscard]] MethodFacts facts() override;

 private:
  Outcome make_programs();
  void choose(const RangeScene& scene);
  void draw_chosen(const RangeScene& scene);

  HybridSettings settings_;
  RasterTarget target_;
  CellPass mesh_, cast_;
  CountingProgram counting_;
  Framebuffer read_back_;
  GLuint range_ = 0;
  RenderSizes sizes_;
  double relief_m_ = 0;
  std::vector<HybridCell> cells_;
};

std::string Hybrid::params() const {
  char text[96];
  std::snprintf(text, sizeof text, "T %.4g, k %.4g, cells of %d x %d posts", settings_.t,
                settings_.k, settings_.cell, settings_.cell);
  return text;
}

Outcome Hybrid::make_programs() {
  Outcome made = make_method_program("hybrid_mesh", shader::hybrid_mesh_vert,
                                     shader::hybrid_mesh_frag, mesh_.program);
  if (made.ok()) {
    made = make_method_program("hybrid_cast", shader::hybrid_cast_vert, shader::hybrid_cast_frag,
                               cast_.program);
  }
  if (made.ok()) made = mesh_.make_vertices(mesh_indices(settings_.cell));
  if (made.ok()) made = cast_.make_vertices(box_indices());
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  read_back_ = Framebuffer(name);
  return made;
}

Outcome Hybrid::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  sizes_ = sizes;
  relief_m_ = terrain.highest_m - terrain.lowest_m;
  cells_ = hybrid_cells(terrain, settings_.cell);
  Outcome made = target_.make(sizes);
  if (made.ok() && read_back_.name() == 0) made = make_programs();
  const std::size_t most = std::max<std::size_t>(cells_.size(), 1);
  if (made.ok()) made = mesh_.make_instances(most);
  if (made.ok()) made = cast_.make_instances(most);
  return made;
}

void Hybrid::choose(const RangeScene& scene) {
  const CellView view{scene.report.camera, scene.report.local, scene.report.range_m, relief_m_,
                      settings_.cell,      settings_.t,        settings_.k};
  const auto column = static_cast<std::int32_t>(std::floor(scene.view.eye_column));
  const auto row = static_cast<std::int32_t>(std::floor(scene.view.eye_row));
  mesh_.chosen.clear();
  cast_.chosen.clear();
  for (const HybridCell& cell : cells_) {
    const CellChoice choice = choice_of(cell, view);
    if (choice.kind == CellChoice::Kind::hidden) continue;
    const Precision steps = precisions[static_cast<std::size_t>(choice.precision)];
    const Instance instance{cell.column - column,
                            cell.row - row,
                            cell.level,
                            steps.linear << 8 | steps.binary,
                            cell.low_m,
                            cell.high_m,
                            static_cast<float>(choice.distance_m)};
    (choice.kind == CellChoice::Kind::mesh ? mesh_ : cast_).chosen.push_back(instance);
  }
  for (CellPass* pass : {&mesh_, &cast_}) {
    std::sort(pass->chosen.begin(), pass->chosen.end(), [](const Instance& a, const Instance& b) {
      return std::pair(a.distance_m, std::pair(a.column, a.row)) <
             std::pair(b.distance_m, std::pair(b.column, b.row));
    });
  }
}

void Hybrid::draw(const RangeScene& scene) {
  choose(scene);
  draw_chosen(scene);
}

void Hybrid::warm_up(const RangeScene& scene) {
  choose(scene);
  // One cell more than there may be to see, drawn in both ways.
  for (CellPass* pass : {&mesh_, &cast_}) {
    if (pass->chosen.empty() && pass->capacity > 0) pass->chosen.push_back({0, 0, 0, 1 << 8 | 1});
  }
  draw_chosen(scene);
}

void Hybrid::draw_chosen(const RangeScene& scene) {
  range_ = scene.renderer.names().range;
  target_.begin(scene.renderer);
  glUseProgram(mesh_.program.name());
  glUniform1i(any_unknown_location, scene.report.window.void_posts > 0 ? 1 : 0);
  mesh_.draw(settings_.cell);
  glEnable(GL_CULL_FACE);  // the target's rows run downwards: a near face turns clockwise
  glFrontFace(GL_CW);
  glCullFace(GL_FRONT);
  cast_.draw(settings_.cell);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glDisable(GL_CULL_FACE);
  target_.end();
}

MethodFacts Hybrid::facts() {
  MethodFacts facts;
  facts.gpu_bytes = target_.gpu_bytes() + (mesh_.capacity + cast_.capacity) * sizeof(Instance) +
                    static_cast<std::size_t>(mesh_.index_count + cast_.index_count) * 2;
  facts.heap_bytes = cells_.capacity() * sizeof(HybridCell) +
                     (mesh_.chosen.capacity() + cast_.chosen.capacity()) * sizeof(Instance);
  if (range_ == 0) return facts;
  const auto pixels =
      static_cast<std::size_t>(sizes_.width_px) * static_cast<std::size_t>(sizes_.height_px);
  std::vector<std::uint32_t> words(4 * pixels);
  glBindFramebuffer(GL_FRAMEBUFFER, read_back_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, range_, 0);
  glReadPixels(0, 0, sizes_.width_px, sizes_.height_px, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
               words.data());
  std::size_t cast = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t word = words[4 * i];
    cast += std::bit_cast<float>(word) < sky && (word & 1u) != 0 ? 1 : 0;
  }
  facts.ray_cast_share = static_cast<double>(cast) / static_cast<double>(pixels);
  return facts;
}

}  // namespace

std::unique_ptr<Method> make_hybrid(const MethodSpec& spec, std::string& problem) {
  HybridSettings settings;
  SettingReader reader(spec);
  reader.number("t", settings.t, 0.0, 1.0e9);
  reader.number("k", settings.k, 1.0e-3, 1.0e3);
  reader.whole("cell", settings.cell, 8, 254);
  problem = reader.problem();
  if (!problem.empty()) return nullptr;
  return std::make_unique<Hybrid>(settings);
}

}  // namespace ridgeline::sim
