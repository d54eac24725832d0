#include "core/terrain/height_tile.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/base/assert.hpp"
#include "core/terrain/dted_tile.hpp"

namespace ridgeline {
namespace {

constexpr float unknown_m = std::numeric_limits<float>::quiet_NaN();

unsigned big_endian_16(const std::byte* at) {
  return (std::to_integer<unsigned>(at[0]) << 8U) | std::to_integer<unsigned>(at[1]);
}

float height_or_unknown(int height_m) {
  constexpr int lowest_m = static_cast<int>(lowest_post_m);
  constexpr int highest_m = static_cast<int>(highest_post_m);
  const bool known = height_m >= lowest_m && height_m <= highest_m;
  return known ? static_cast<float>(height_m) : unknown_m;
}

float hgt_height_m(const std::byte* at) {
  const int height_m = static_cast<std::int16_t>(big_endian_16(at));
  return height_m == hgt_extra_void_m ? unknown_m : height_or_unknown(height_m);
}

// DTED keeps the sign in the top bit; 0x8000 (minus zero) is 0 m, 0xFFFF is -32767, the void.
float dted_height_m(const std::byte* at) {
  const unsigned raw = big_endian_16(at);
  const int magnitude_m = static_cast<int>(raw & 0x7FFFU);
  return height_or_unknown((raw & 0x8000U) != 0 ? -magnitude_m : magnitude_m);
}

}  // namespace

void read_posts(const HeightTile& tile, int row, int column, std::span<float> out) {
  const PostGrid& grid = tile.grid;
  RL_ASSERT(row >= 0 && row < grid.rows);
  RL_ASSERT(column >= 0 && column <= grid.columns);
  RL_ASSERT(out.size() <= static_cast<std::size_t>(grid.columns - column));
  if (out.empty()) return;
  const auto columns = static_cast<std::size_t>(grid.columns);
  const auto first_column = static_cast<std::size_t>(column);
  const auto row_from_south = static_cast<std::size_t>(row);
  const std::byte* at = tile.bytes.data();
  switch (tile.layout) {
    case TileLayout::hgt_int16_be: {
      const auto row_from_north = static_cast<std::size_t>(grid.rows - 1 - row);
      at += 2 * (row_from_north * columns + first_column);
      for (float& height_m : out) {
        height_m = hgt_height_m(at);
        at += 2;
      }
      return;
    }
    case TileLayout::dted: {
      const std::size_t stride = dted_record_bytes(grid.rows);
      at += dted_header_bytes + first_column * stride + dted_record_head_bytes + 2 * row_from_south;
      for (float& height_m : out) {
        height_m = dted_height_m(at);
        at += stride;
      }
      return;
    }
    case TileLayout::float32_rows:
      at += sizeof(float) * (row_from_south * columns + first_column);
      std::memcpy(out.data(), at, out.size_bytes());
      return;
    case TileLayout::all_zero:
      std::fill(out.begin(), out.end(), 0.0F);
      return;
  }
}

}  // namespace ridgeline
