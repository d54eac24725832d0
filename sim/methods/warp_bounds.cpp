#include "sim/methods/warp_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace ridgeline::sim {
namespace {

constexpr float void_threshold = -50000.0f;  // as in shaders/terrain.glsl
constexpr float void_offset = 100000.0f;

/// The posts of the finest level, addressed round the torus.
class Posts {
 public:
  explicit Posts(const MethodTerrain& terrain)
      : posts_(terrain.posts),
        columns_(terrain.view.sizes.columns()),
        rows_(terrain.view.sizes.rows()) {}
  [[nodiscard]] float stored(int column, int row) const {
    const int c = column < columns_ ? column : column - columns_;
    const int r = row < rows_ ? row : row - rows_;
    return posts_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(c)];
  }

 private:
  std::span<const float> posts_;
  int columns_, rows_;
};

/// Slopes of one cell along its edges, averaged; false where it is unknown.
bool cell_slope(const Posts& posts, int column, int row, glm::vec2& slope) {
  const float a = posts.stored(column, row), b = posts.stored(column + 1, row);
  const float c = posts.stored(column, row + 1), d = posts.stored(column + 1, row + 1);
  if (std::min(std::min(a, b), std::min(c, d)) < void_threshold) return false;
  slope = {0.5f * (b - a + d - c), 0.5f * (c - a + d - b)};
  return true;
}

void add_block(const Posts& posts, int west, int south, SurfaceBounds& bounds) {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (int row = south; row <= south + bound_block_posts; ++row) {
    for (int column = west; column <= west + bound_block_posts; ++column) {
      const float stored = posts.stored(column, row);
      const float height = stored < void_threshold ? stored + void_offset : stored;
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  glm::vec2 mean(0);
  glm::vec3 squares(0);
  int cells = 0;
  const auto over_cells = [&](const auto& use) {
    for (int row = south; row < south + bound_block_posts; ++row) {
      for (int column = west; column < west + bound_block_posts; ++column) {
        if (glm::vec2 slope; cell_slope(posts, column, row, slope)) use(slope);
      }
    }
  };
  over_cells([&](const glm::vec2& s) {
    mean += s;
    squares += glm::vec3(s.x * s.x, s.y * s.y, s.x * s.y);
    ++cells;
  });
  const float share = 1.0f / static_cast<float>(std::max(cells, 1));
  mean *= share;
  squares *= share;
  float spread = 0;
  over_cells([&](const glm::vec2& s) { spread = std::max(spread, glm::length(s - mean)); });
  bounds.heights.emplace_back(low, high, mean.x, mean.y);
  bounds.slopes.emplace_back(squares, spread);
}

}  // namespace

SurfaceBounds surface_bounds(const MethodTerrain& terrain) {
  SurfaceBounds bounds;
  bounds.columns = terrain.view.sizes.columns() / bound_block_posts;
  bounds.rows = terrain.view.sizes.rows() / bound_block_posts;
  const auto blocks =
      static_cast<std::size_t>(bounds.columns) * static_cast<std::size_t>(bounds.rows);
  bounds.heights.reserve(blocks);
  bounds.slopes.reserve(blocks);
  const Posts posts(terrain);
  for (int row = 0; row < bounds.rows; ++row) {
    for (int column = 0; column < bounds.columns; ++column) {
      add_block(posts, column * bound_block_posts, row * bound_block_posts, bounds);
    }
  }
  return bounds;
}

}  // namespace ridgeline::sim
