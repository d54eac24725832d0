#include "sim/methods/clipmap.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/clipmap_frag.hpp"
#include "shaders/clipmap_vert.hpp"
#include "sim/methods/clipmap_layout.hpp"
#include "sim/methods/footprint_view.hpp"
#include "sim/methods/post_pyramid.hpp"
#include "sim/methods/raster_target.hpp"
#include "sim/methods/setting_reader.hpp"

namespace ridgeline::sim {
namespace {

constexpr double high_eye = 0.4;  ///< of n steps: a finer level is left out
constexpr int most_clip_levels = 12;
constexpr int slack_posts = 2;  ///< that the coarsest level covers past the range

/// As clipmap.vert reads it.
struct Instance {
  std::int32_t column = 0, row = 0, level = 0, row_vertices = 0;
};
/// Of one footprint: the perimeters, or the blocks of all levels.
using Instances = FixedVector<Instance, 16 * most_clip_levels>;

class Clipmap final : public Method {
 public:
  explicit Clipmap(int n) : n_(n) {}
  [[nodiscard]] std::string_view name() const override { return "clipmap"; }
  [[nodiscard]] std::string params() const override {
    return "grid " + std::to_string(n_) + ", tent pyramid";
  }
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  [[nodiscard]] MethodFacts facts() override;

 private:
  Outcome make_objects();
  [[nodiscard]] int coarsest_level(const RangeScene& scene) const;
  [[nodiscard]] int finest_level(const RangeScene& scene, int coarsest) const;
  void place_level(const RangeScene& scene, const FootprintView& view, int level, bool finest);
  void draw_instances(Footprint footprint);

  int n_;
  Program program_;
  Buffer indices_, instance_buffer_;
  VertexArray vertices_;
  RasterTarget target_;
  PostPyramid pyramid_;
  CoarseGround ground_;
  std::array<std::size_t, footprint_count + 1> first_index_{};
  std::array<Instances, footprint_count> instances_;
  double lowest_m_ = 0, highest_m_ = 0;
  int coarsest_ = 0;
};

Outcome Clipmap::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  lowest_m_ = terrain.lowest_m;
  highest_m_ = terrain.highest_m;
  ground_.build(terrain);
  Outcome made = pyramid_.build(terrain.view, PostPyramid::Filter::tent);
  if (made.ok()) made = target_.make(sizes);
  if (made.ok() && program_.name() == 0) made = make_objects();
  return made;
}

Outcome Clipmap::make_objects() {
  std::vector<std::uint32_t> indices;
  for (int k = 0; k < footprint_count; ++k) {
    first_index_[k] = indices.size();
    const auto more = footprint_indices(static_cast<Footprint>(k), n_);
    indices.insert(indices.end(), more.begin(), more.end());
  }
  first_index_[footprint_count] = indices.size();
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  vertices_ = VertexArray(name);
  glBindVertexArray(name);
  const std::size_t bytes = indices.size() * sizeof indices[0];
  Outcome made =
      make_method_buffer("clipmap", GL_ELEMENT_ARRAY_BUFFER, bytes, GL_STATIC_DRAW, indices_);
  if (!made.ok()) return made;
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), indices.data());
  made = make_method_buffer("clipmap", GL_ARRAY_BUFFER,
                            sizeof(Instance) * Instances::capacity() * footprint_count,
                            GL_DYNAMIC_DRAW, instance_buffer_);
  if (!made.ok()) return made;
  glEnableVertexAttribArray(0);
  glVertexAttribDivisor(0, 1);
  glBindVertexArray(0);
  return make_method_program("clipmap", shader::clipmap_vert, shader::clipmap_frag, program_);
}

/// The first level that reaches past the range to every side.
int Clipmap::coarsest_level(const RangeScene& scene) const {
  constexpr int directions = 16;
  const PostLattice& lattice = scene.view.lattice;
  double reach_posts = 0;
  for (int k = 0; k < directions; ++k) {
    const double azimuth_rad = 6.283185307179586 * k / directions;
    const ChartPoint way = scene.map.offset(std::sin(azimuth_rad), std::cos(azimuth_rad));
    const double columns = std::abs(way.east_deg) / lattice.longitude_step_deg;
    const double rows = std::abs(way.north_deg) / lattice.latitude_step_deg;
    // A polar chart is turned against the eye's axes.
    const double posts = lattice.polar() ? std::hypot(columns, rows) : std::max(columns, rows);
    reach_posts = std::max(reach_posts, posts + slack_posts);
  }
  const int most =
      std::min(scene.view.sizes.levels - 1 + shader::node_levels, most_clip_levels - 1);
  int level = 0;
  // The eye stands up to one step off the middle.
  while (level < most && std::ldexp(0.5 * (n_ - 1) - 1.0, level) < reach_posts) ++level;
  return level;
}

int Clipmap::finest_level(const RangeScene& scene, int coarsest) const {
  constexpr double rad_per_deg = 0.017453292519943295;
  const double step_m =
      scene.view.lattice.latitude_step_deg * rad_per_deg * scene.report.local.meridian_radius_m;
  const double above_m =
      scene.report.local.eye.height_m - ground_.below_eye_m(scene.view, lowest_m_);
  int level = 0;
  while (level < coarsest && above_m > high_eye * n_ * std::ldexp(step_m, level)) ++level;
  return level;
}

void Clipmap::place_level(const RangeScene& scene, const FootprintView& view, int level,
                          bool finest) {
  const std::int64_t column = level_origin(n_, level, scene.view.eye_column);
  const std::int64_t row = level_origin(n_, level, scene.view.eye_row);
  Pieces pieces;
  if (finest) {
    pieces = full_pieces(n_);
  } else {
    const std::int64_t inner_column = level_origin(n_, level - 1, scene.view.eye_column) / 2;
    const std::int64_t inner_row = level_origin(n_, level - 1, scene.view.eye_row) / 2;
    pieces = ring_pieces(n_, {inner_column - column, inner_row - row});
  }
  if (level < coarsest_) pieces.push_back({Footprint::perimeter, {0, 0}});
  const auto eye_column = static_cast<std::int64_t>(std::floor(scene.view.eye_column)) >> level;
  const auto eye_row = static_cast<std::int64_t>(std::floor(scene.view.eye_row)) >> level;
  for (const Piece& piece : pieces) {
    const glm::ivec2 quads = footprint_quads(piece.footprint, n_);
    const std::int64_t west = column + piece.at.x, south = row + piece.at.y;
    const FootprintView::Box box{std::ldexp(west, level), std::ldexp(south, level),
                                 std::ldexp(west + quads.x, level),
                                 std::ldexp(south + quads.y, level)};
    if (!view.may_show(box)) continue;
    instances_[static_cast<std::size_t>(piece.footprint)].push_back(
        {static_cast<std::int32_t>(west - eye_column), static_cast<std::int32_t>(south - eye_row),
         level, quads.x + 1});
  }
}

void Clipmap::draw_instances(Footprint footprint) {
  const auto k = static_cast<std::size_t>(footprint);
  const Instances& instances = instances_[k];
  if (instances.empty()) return;
  const std::size_t first = k * Instances::capacity() * sizeof(Instance);
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(first),
                  static_cast<GLsizeiptr>(instances.size() * sizeof(Instance)),
                  instances.view().data());
  // NOLINTNEXTLINE: OpenGL takes the offset as a pointer
  glVertexAttribIPointer(0, 4, GL_INT, sizeof(Instance), reinterpret_cast<const void*>(first));
  // NOLINTNEXTLINE
  const auto* indices = reinterpret_cast<const void*>(first_index_[k] * sizeof(std::uint32_t));
  glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(first_index_[k + 1] - first_index_[k]),
                          GL_UNSIGNED_INT, indices, static_cast<GLsizei>(instances.size()));
}

void Clipmap::draw(const RangeScene& scene) {
  target_.begin(scene.renderer);
  for (Instances& instances : instances_) instances.clear();
  coarsest_ = coarsest_level(scene);
  const int finest = finest_level(scene, coarsest_);
  const FootprintView view(scene, lowest_m_, highest_m_);
  for (int level = finest; level <= coarsest_; ++level) {
    place_level(scene, view, level, level == finest);
  }
  glUseProgram(program_.name());
  glUniform2i(0, n_, coarsest_);
  pyramid_.bind();
  glBindVertexArray(vertices_.name());
  glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.name());
  for (int k = 0; k < footprint_count; ++k) draw_instances(static_cast<Footprint>(k));
  target_.end();
}

MethodFacts Clipmap::facts() {
  MethodFacts facts;
  facts.gpu_bytes = target_.gpu_bytes() + pyramid_.gpu_bytes() +
                    first_index_[footprint_count] * sizeof(std::uint32_t) +
                    footprint_count * Instances::capacity() * sizeof(Instance);
  facts.heap_bytes = ground_.heap_bytes();
  return facts;
}

}  // namespace

std::unique_ptr<Method> make_clipmap(const MethodSpec& spec, std::string& problem) {
  std::string grid = "255";
  SettingReader reader(spec);
  reader.word("grid", grid, {"63", "127", "255", "511"});
  problem = reader.problem();
  if (!problem.empty()) return nullptr;
  return std::make_unique<Clipmap>(std::stoi(grid));
}

}  // namespace ridgeline::sim
