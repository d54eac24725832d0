#include "core/render/ray_tile.hpp"

#include "core/base/assert.hpp"

namespace ridgeline {

int put_tiles(const TileAxis& across, const TileAxis& down, std::span<RayTile> tiles) {
  const int count = across.count() * down.count();
  RL_ASSERT(tiles.size() >= static_cast<std::size_t>(count));
  std::size_t k = 0;
  for (int j = 0; j < down.count(); ++j) {
    for (int i = 0; i < across.count(); ++i) {
      const int x = across.begin(i), y = down.begin(j);
      tiles[k++] = {
          RayTile::pair(x, y),
          RayTile::pair((across.first_rays + i) * ray_tile_px, (down.first_rays + j) * ray_tile_px),
          RayTile::pair(across.begin(i + 1) - x, down.begin(j + 1) - y), RayTile::pair(1, 1)};
    }
  }
  return count;
}

}  // namespace ridgeline
