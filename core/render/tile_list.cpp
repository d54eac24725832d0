#include "core/render/tile_list.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "shaders/frame_block.h"

namespace ridgeline {

Result<TileList> TileList::make(int capacity) {
  static_assert(sizeof(RayTile) == 4 * sizeof(GLint));
  constexpr GLenum indices = GL_ELEMENT_ARRAY_BUFFER;
  TileList list;
  const int rows = (capacity + shader::tile_list_width - 1) / shader::tile_list_width;
  auto records = make_texture(GL_RGBA32I, shader::tile_list_width, rows, 1, sizeof(RayTile));
  if (!records) return records.fault();
  list.records_ = std::move(records).value();
  const auto count = static_cast<std::uint32_t>(capacity);
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  list.vertices_ = VertexArray(name);
  glBindVertexArray(name);
  auto corners = make_buffer(indices, count * 6 * sizeof(std::uint32_t), GL_STATIC_DRAW);
  if (!corners) return corners.fault();
  list.corners_ = std::move(corners).value();
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t v = 4 * k;
    const std::array<std::uint32_t, 6> two{v, v + 1, v + 2, v + 2, v + 1, v + 3};
    glBufferSubData(indices, static_cast<GLintptr>(k * sizeof two), sizeof two, two.data());
  }
  glBindVertexArray(0);
  return list;
}

void TileList::bind() const {
  glActiveTexture(GL_TEXTURE0 + shader::tiles_unit);
  glBindTexture(GL_TEXTURE_2D, records_.name());
}

void TileList::write(int first, std::span<const RayTile> records) const {
  bind();
  while (!records.empty()) {
    const int x = first % shader::tile_list_width, y = first / shader::tile_list_width;
    const auto count =
        std::min(records.size(), static_cast<std::size_t>(shader::tile_list_width - x));
    glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, static_cast<GLsizei>(count), 1, GL_RGBA_INTEGER, GL_INT,
                    records.data());
    records = records.subspan(count);
    first += static_cast<int>(count);
  }
}

void TileList::draw(int first, int count) const {
  bind();
  glBindVertexArray(vertices_.name());
  const std::size_t offset = 6 * sizeof(std::uint32_t) * static_cast<std::size_t>(first);
  glDrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset));
  glBindVertexArray(0);
}

}  // namespace ridgeline
