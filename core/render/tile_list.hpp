#pragma once
#include <span>

#include "core/render/gl_object.hpp"
#include "core/render/ray_tile.hpp"

namespace ridgeline {

/// Records of tiles as the vertex shaders read them (shaders/tile_list.glsl), and two triangles for
/// each. Not an instance a tile: software GPUs start over for every instance.
class TileList {
 public:
  TileList() = default;
  /// Errors: Fault::gl_out_of_memory.
  static Result<TileList> make(int capacity);

  /// Writes records from number `first` on. Domain: within the capacity.
  void write(int first, std::span<const RayTile> records) const;
  /// Binds the records for a shader.
  void bind() const;
  /// Draws the triangles of `count` records with the program in use.
  void draw(int first, int count) const;

 private:
  Texture records_;
  Buffer corners_;
  VertexArray vertices_;  ///< holds the corners, so that no other draw meets them
};

}  // namespace ridgeline
