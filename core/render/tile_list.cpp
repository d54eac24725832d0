#include "core/render/tile_list.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/base/assert.hpp"
#include "core/base/fixed_vector.hpp"
#include "core/render/squares.hpp"
#include "shaders/frame_block.h"

namespace ridgeline {
namespace {

/// A square as the vertex shaders read it: number of its tile; place in it and side.
struct Square {
  std::uint32_t tile = 0;
  std::uint32_t place = 0;  ///< x, y * 2^12, side * 2^24
};

constexpr std::size_t written_at_once = 256;

struct FaceSize {
  int width = 0, height = 0;
};

FaceSize face_size(const RayTile& tile, TileFace face) {
  if (face == TileFace::pixels) return {tile.width(), tile.height()};
  return {tile.ray_columns(), tile.ray_rows()};
}

}  // namespace

int square_count(const RayTile& tile, TileFace face) {
  const FaceSize size = face_size(tile, face);
  int count = 0;
  cut_into_squares(size.width, size.height, [&](int, int, int) { ++count; });
  return count;
}

Result<TileList> TileList::make(int records, int squares) {
  static_assert(sizeof(RayTile) == 4 * sizeof(GLint));
  TileList list;
  const int rows = (records + shader::tile_list_width - 1) / shader::tile_list_width;
  auto texture = make_texture(GL_RGBA32I, shader::tile_list_width, rows, 1, sizeof(RayTile));
  if (!texture) return texture.fault();
  list.records_ = std::move(texture).value();
  list.capacity_ = squares;
  for (std::size_t face = 0; face < 2; ++face) {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    list.vertices_[face] = VertexArray(name);
    glBindVertexArray(name);
    auto buffer = make_buffer(GL_ARRAY_BUFFER, static_cast<std::size_t>(squares) * sizeof(Square),
                              GL_DYNAMIC_DRAW);
    if (!buffer) return buffer.fault();
    list.squares_[face] = std::move(buffer).value();
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 2, GL_UNSIGNED_INT, sizeof(Square), nullptr);
  }
  glBindVertexArray(0);
  return list;
}

void TileList::bind() const {
  glActiveTexture(GL_TEXTURE0 + shader::tiles_unit);
  glBindTexture(GL_TEXTURE_2D, records_.name());
}

void TileList::write(int first, std::span<const RayTile> records) {
  write_squares(first, records, TileFace::rays);
  write_squares(first, records, TileFace::pixels);
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

void TileList::write_squares(int first, std::span<const RayTile> records, TileFace face) {
  int& count = count_[index(face)];
  if (first == 0) count = 0;
  FixedVector<Square, written_at_once> waiting;
  glBindBuffer(GL_ARRAY_BUFFER, squares_[index(face)].name());
  const auto put = [&] {
    RL_ASSERT(count + static_cast<int>(waiting.size()) <= capacity_);
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(count * sizeof(Square)),
                    static_cast<GLsizeiptr>(waiting.size() * sizeof(Square)),
                    waiting.view().data());
    count += static_cast<int>(waiting.size());
    waiting.clear();
  };
  for (const RayTile& tile : records) {
    const FaceSize size = face_size(tile, face);
    cut_into_squares(size.width, size.height, [&](int x, int y, int side) {
      if (waiting.size() == written_at_once) put();
      waiting.push_back({static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(x | y << 12 | side << 24)});
    });
    ++first;
  }
  put();
}

void TileList::draw(TileFace face, int first, int count) const {
  bind();
  glBindVertexArray(vertices_[index(face)].name());
  glDrawArrays(GL_POINTS, first, count);
  glBindVertexArray(0);
}

}  // namespace ridgeline
