#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace ridgeline {

/// Pixels that one ray through their middle stands for.
struct BlockShape {
  int width = 1, height = 1;
  /// Distance of the farthest pixel from the ray, px.
  [[nodiscard]] double radius_px() const { return 0.5 * std::hypot(width - 1.0, height - 1.0); }
};

/// A rectangle of the picture whose pixels share rays in blocks of one shape, as the shaders read
/// it from a texture, by number. The rays of a tile stand in the targets as a small picture that
/// begins at a place of its own.
struct RayTile {
  std::int32_t origin = 0;           ///< first pixel: x, and y * 65536
  std::int32_t rays = 0;             ///< where its rays begin in the targets, likewise
  std::int32_t size = 0;             ///< width, and height * 65536
  std::int32_t block = 1 | 1 << 16;  ///< width and height of a block, likewise

  static constexpr std::int32_t pair(int low, int high) { return low | high << 16; }
  [[nodiscard]] int x() const { return origin & 0xFFFF; }
  [[nodiscard]] int y() const { return origin >> 16; }
  [[nodiscard]] int rays_x() const { return rays & 0xFFFF; }
  [[nodiscard]] int rays_y() const { return rays >> 16; }
  [[nodiscard]] int width() const { return size & 0xFFFF; }
  [[nodiscard]] int height() const { return size >> 16; }
  [[nodiscard]] BlockShape shape() const { return {block & 0xFFFF, block >> 16}; }
  /// Rays side by side, and above each other; blocks at its far edges may be cut.
  [[nodiscard]] int ray_columns() const { return (width() + shape().width - 1) / shape().width; }
  [[nodiscard]] int ray_rows() const { return (height() + shape().height - 1) / shape().height; }
  [[nodiscard]] int ray_count() const { return ray_columns() * ray_rows(); }
};
static_assert(sizeof(RayTile) == 16);

/// The tiles of one picture. From number `ground` on no ground shows in them: they have one ray,
/// and every pixel is sky.
struct RayTiles {
  std::span<const RayTile> tiles;
  int ground = 0;
};

inline constexpr int ray_tile_px = 32;  ///< a side, but for tiles at the borders

/// How one axis of a picture, from `first_px` on, is cut into tiles: a border of `ring` pixels at
/// either end, so many pixels each between. Domain: size - first > 2 ring, or ring = 0.
struct TileAxis {
  int size_px = 0, ring_px = 0;
  int first_px = 0;
  int first_rays = 0;  ///< tiles of the targets that are left out before the first

  [[nodiscard]] int inner() const {
    return (size_px - first_px - 2 * ring_px + ray_tile_px - 1) / ray_tile_px;
  }
  [[nodiscard]] int count() const { return inner() + (ring_px > 0 ? 2 : 0); }
  /// First pixel of tile k; of tile count(): the end of the picture.
  [[nodiscard]] int begin(int k) const {
    if (k >= count()) return size_px;
    if (ring_px == 0) return first_px + k * ray_tile_px;
    if (k == 0) return first_px;
    return std::min(first_px + ring_px + (k - 1) * ray_tile_px, size_px - ring_px);
  }
  [[nodiscard]] int tile_of(double px) const {
    const double inside =
        std::floor((px - first_px - ring_px) / ray_tile_px) + (ring_px > 0 ? 1 : 0);
    if (ring_px > 0 && px >= size_px - ring_px) return count() - 1;
    return static_cast<int>(std::clamp(inside, 0.0, count() - 1.0));
  }
};

/// Tiles of one axis at most, whatever the border.
constexpr int most_tiles(int size_px) {
  return (size_px + ray_tile_px - 1) / ray_tile_px + 2;
}

/// A side of targets that hold the rays of every tile at a multiple of the tile's side: software
/// rasterisers work in small squares, and a tile across their borders costs twice.
constexpr int ray_target_px(int size_px) {
  return most_tiles(size_px) * ray_tile_px;
}

/// Cuts a picture into tiles in which every pixel has its own ray; how many. Without a border the
/// rays stand where their pixels do.
/// Shape: tiles.size() >= most_tiles(width) * most_tiles(height).
int put_tiles(const TileAxis& across, const TileAxis& down, std::span<RayTile> tiles);

}  // namespace ridgeline
