#pragma once
#include <span>

#include "core/render/gl_object.hpp"
#include "core/render/ray_tile.hpp"

namespace ridgeline {

/// What of its tiles a pass draws: their rays, or the pixels of the picture.
enum class TileFace { rays, pixels };

/// Largest point a driver must draw: a square is one.
inline constexpr int largest_square_px = ray_tile_px;

/// Squares that a face of a tile is cut into (core/render/squares.hpp).
/// Domain: the shorter side is at most largest_square_px.
int square_count(const RayTile& tile, TileFace face);

/// Squares at most of so many by so many tiles, whatever their blocks: of a whole tile 32 x 4 rays,
/// of a tile at the border 32 x 1.
constexpr int most_squares(int across, int down) {
  return 8 * across * down + 2 * ray_tile_px * (across + down);
}

/// Records of tiles as the vertex shaders read them (shaders/tile_list.glsl), and the squares of
/// both faces. Squares are points: of two triangles a software GPU shades what their common edge
/// crosses twice, which is a quarter of 16 x 16 rays (docs/performance.md).
class TileList {
 public:
  TileList() = default;
  /// Errors: Fault::gl_out_of_memory.
  static Result<TileList> make(int records, int squares);

  /// Writes records from number `first` on, and their squares behind those of the records before.
  /// Domain: `first` is 0 or what has been written; within both capacities.
  void write(int first, std::span<const RayTile> records);
  /// Binds the records for a shader.
  void bind() const;
  /// Squares of the records that have been written.
  [[nodiscard]] int squares(TileFace face) const { return count_[index(face)]; }
  /// Draws `count` squares from number `first` on with the program in use.
  void draw(TileFace face, int first, int count) const;

 private:
  static std::size_t index(TileFace face) { return static_cast<std::size_t>(face); }
  void write_squares(int first, std::span<const RayTile> records, TileFace face);

  Texture records_;
  Buffer squares_[2];
  VertexArray vertices_[2];  ///< one a face, so that no other draw meets their buffers
  int capacity_ = 0;
  int count_[2] = {0, 0};
};

}  // namespace ridgeline
