#include "core/terrain/hgt_tile.hpp"

#include <array>

namespace ridgeline {
namespace {
// 3", 1" and 1/3" posts of one degree.
constexpr std::array<std::size_t, 3> posts_a_side = {1201, 3601, 10801};

constexpr std::size_t square_bytes(std::size_t posts) {
  return 2 * posts * posts;
}
}  // namespace

Result<PostGrid> hgt_grid(std::size_t size_bytes, TileLocation location) {
  if (location.south_deg < -90 || location.south_deg > 89 || location.west_deg < -180 ||
      location.west_deg > 179) {
    return Fault::tile_location_mismatch;
  }
  if (size_bytes < square_bytes(posts_a_side.front())) return Fault::tile_truncated;
  int posts = 0;
  for (const std::size_t side : posts_a_side) {
    if (size_bytes == square_bytes(side)) posts = static_cast<int>(side);
  }
  if (posts == 0) return Fault::tile_size_mismatch;
  const double step_deg = 1.0 / (posts - 1);
  return PostGrid{.south_deg = static_cast<double>(location.south_deg),
                  .west_deg = static_cast<double>(location.west_deg),
                  .latitude_step_deg = step_deg,
                  .longitude_step_deg = step_deg,
                  .rows = posts,
                  .columns = posts};
}

Result<HeightTile> parse_hgt(std::span<const std::byte> bytes, int south_deg, int west_deg) {
  const Result<PostGrid> grid = hgt_grid(bytes.size(), {south_deg, west_deg});
  if (!grid.ok()) return grid.fault();
  return HeightTile{grid.value(), TileLayout::hgt_int16_be, bytes};
}

}  // namespace ridgeline
