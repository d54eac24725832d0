#include "core/terrain/hgt_tile.hpp"

namespace ridgeline {
namespace {
constexpr std::size_t posts_3_arc_seconds = 1201;
constexpr std::size_t posts_1_arc_second = 3601;

constexpr std::size_t square_bytes(std::size_t posts) {
  return 2 * posts * posts;
}
}  // namespace

Result<PostGrid> hgt_grid(std::size_t size_bytes, TileLocation location) {
  if (location.south_deg < -90 || location.south_deg > 89 || location.west_deg < -180 ||
      location.west_deg > 179) {
    return Fault::tile_location_mismatch;
  }
  if (size_bytes < square_bytes(posts_3_arc_seconds)) return Fault::tile_truncated;
  const bool coarse = size_bytes == square_bytes(posts_3_arc_seconds);
  if (!coarse && size_bytes != square_bytes(posts_1_arc_second)) return Fault::tile_size_mismatch;
  const int posts = static_cast<int>(coarse ? posts_3_arc_seconds : posts_1_arc_second);
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
