#include "sim/methods/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/mesh_frag.hpp"
#include "shaders/mesh_vert.hpp"
#include "sim/methods/raster_target.hpp"
#include "sim/methods/setting_reader.hpp"

namespace ridgeline::sim {
namespace {

constexpr int side = block_posts + 1;  ///< posts a side of a block's mesh
constexpr int indices_a_block = 6 * block_posts * block_posts;
constexpr double largest_corner_m = 1.5;  ///< of a block's half diagonal: the Earth bends it little

/// One block of the window: where it is, for the shader and for culling.
struct MeshBlock {
  std::int32_t column = 0, row = 0;  ///< lattice posts
  int level = 0;
  Vec3<Ecef> centre;
  double radius_m = 0;
};

/// As mesh.vert reads it.
struct Instance {
  std::int32_t column = 0, row = 0, level = 0;
};

class Mesh final : public Method {
 public:
  [[nodiscard]] std::string_view name() const override { return "mesh"; }
  [[nodiscard]] std::string params() const override { return "2 triangles a cell"; }
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  [[nodiscard]] MethodFacts facts() override;

 private:
  Outcome make_objects(std::size_t most_blocks);
  void choose_visible(const RangeScene& scene);

  Program program_;
  Buffer indices_, instances_;
  VertexArray vertices_;
  RasterTarget target_;
  std::vector<MeshBlock> blocks_;
  std::vector<Instance> visible_;
  std::size_t capacity_ = 0;
};

std::vector<std::uint16_t> block_indices() {
  std::vector<std::uint16_t> indices;
  indices.reserve(indices_a_block);
  for (int row = 0; row < block_posts; ++row) {
    for (int column = 0; column < block_posts; ++column) {
      const int sw = row * side + column, se = sw + 1, nw = sw + side, ne = nw + 1;
      for (const int index : {sw, se, ne, sw, ne, nw}) {
        indices.push_back(static_cast<std::uint16_t>(index));
      }
    }
  }
  return indices;
}

/// A ball round the ground of one block, any height between the window's lowest and highest.
MeshBlock block_at(const MethodTerrain& terrain, std::int32_t column, std::int32_t row, int level) {
  const PostLattice& lattice = terrain.view.lattice;
  const double span = block_posts << level;
  const double height_m = 0.5 * (terrain.lowest_m + terrain.highest_m);
  const auto point = [&](double c, double r, double h) {
    const GroundPlace place = lattice.place_of(c, r);
    return ecef_from_geodetic({place.latitude_deg, place.longitude_deg, h});
  };
  MeshBlock block{column, row, level, point(column + 0.5 * span, row + 0.5 * span, height_m), 0};
  for (const double c : {column + 0.0, column + span}) {
    for (const double r : {row + 0.0, row + span}) {
      for (const double h : {terrain.lowest_m, terrain.highest_m}) {
        const glm::dvec3 offset = point(c, r, h).xyz - block.centre.xyz;
        block.radius_m = std::max(block.radius_m, largest_corner_m * glm::length(offset));
      }
    }
  }
  return block;
}

bool inside(const PostRect& outer, std::int32_t west, std::int32_t south, std::int32_t span) {
  return west >= outer.west && south >= outer.south && west + span <= outer.east &&
         south + span <= outer.north;
}

Outcome Mesh::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  blocks_.clear();
  for (int level = 0; level < terrain.view.sizes.levels; ++level) {
    const PostRect& rect = terrain.view.drawable[static_cast<std::size_t>(level)];
    if (rect.empty()) continue;
    const std::int32_t span = block_posts << level;
    const auto first = [&](std::int32_t post) { return (post >> (block_levels + level)) * span; };
    for (std::int32_t row = first(rect.south); row < rect.north; row += span) {
      for (std::int32_t column = first(rect.west); column < rect.east; column += span) {
        const bool finer =
            level > 0 &&
            inside(terrain.view.drawable[static_cast<std::size_t>(level - 1)], column, row, span);
        if (!finer) blocks_.push_back(block_at(terrain, column, row, level));
      }
    }
  }
  visible_.reserve(blocks_.size());
  if (Outcome made = target_.make(sizes); !made.ok()) return made;
  return make_objects(blocks_.size());
}

Outcome Mesh::make_objects(std::size_t most_blocks) {
  if (program_.name() == 0) {
    Outcome made = make_method_program("mesh", shader::mesh_vert, shader::mesh_frag, program_);
    if (!made.ok()) return made;
  }
  if (capacity_ >= most_blocks && capacity_ > 0) return {};
  capacity_ = std::max<std::size_t>(most_blocks, 1);
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  vertices_ = VertexArray(name);
  glBindVertexArray(name);
  const std::vector<std::uint16_t> indices = block_indices();
  const std::size_t index_bytes = indices.size() * sizeof indices[0];
  Outcome made =
      make_method_buffer("mesh", GL_ELEMENT_ARRAY_BUFFER, index_bytes, GL_STATIC_DRAW, indices_);
  if (!made.ok()) return made;
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(index_bytes), indices.data());
  made = make_method_buffer("mesh", GL_ARRAY_BUFFER, capacity_ * sizeof(Instance), GL_DYNAMIC_DRAW,
                            instances_);
  if (!made.ok()) return made;
  glEnableVertexAttribArray(0);
  glVertexAttribIPointer(0, 3, GL_INT, sizeof(Instance), nullptr);
  glVertexAttribDivisor(0, 1);
  glBindVertexArray(0);
  return {};
}

/// Blocks whose ball touches the cone round the picture and the display range.
void Mesh::choose_visible(const RangeScene& scene) {
  const Camera& camera = scene.report.camera;
  const LocalFrame& local = scene.report.local;
  const double half_rad = camera.half_diagonal_rad(1.0);
  const glm::dvec3 ahead =
      (local.ecef_from_enu * camera.enu_from_camera * Vec3<CameraAxes>{{0, 0, 1}}).xyz;
  const auto column = static_cast<std::int32_t>(std::floor(scene.view.eye_column));
  const auto row = static_cast<std::int32_t>(std::floor(scene.view.eye_row));
  visible_.clear();
  for (const MeshBlock& block : blocks_) {
    const glm::dvec3 way = block.centre.xyz - local.eye_ecef.xyz;
    const double distance_m = glm::length(way);
    if (distance_m - block.radius_m > scene.report.range_m) continue;
    if (distance_m > block.radius_m) {
      const double off_rad = std::acos(std::clamp(glm::dot(way, ahead) / distance_m, -1.0, 1.0));
      if (off_rad > half_rad + std::asin(block.radius_m / distance_m)) continue;
    }
    visible_.push_back({block.column - column, block.row - row, block.level});
  }
}

void Mesh::draw(const RangeScene& scene) {
  choose_visible(scene);
  target_.begin(scene.renderer);
  if (!visible_.empty()) {
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(visible_.size() * sizeof(Instance)),
                    visible_.data());
    glUseProgram(program_.name());
    glBindVertexArray(vertices_.name());
    glDrawElementsInstanced(GL_TRIANGLES, indices_a_block, GL_UNSIGNED_SHORT, nullptr,
                            static_cast<GLsizei>(visible_.size()));
  }
  target_.end();
}

MethodFacts Mesh::facts() {
  MethodFacts facts;
  facts.gpu_bytes =
      target_.gpu_bytes() + indices_a_block * sizeof(std::uint16_t) + capacity_ * sizeof(Instance);
  facts.heap_bytes =
      blocks_.capacity() * sizeof(MeshBlock) + visible_.capacity() * sizeof(Instance);
  return facts;
}

}  // namespace

std::unique_ptr<Method> make_mesh(const MethodSpec& spec, std::string& problem) {
  problem = SettingReader(spec).problem();
  if (!problem.empty()) return nullptr;
  return std::make_unique<Mesh>();
}

}  // namespace ridgeline::sim
