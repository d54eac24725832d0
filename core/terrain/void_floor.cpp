#include "core/terrain/void_floor.hpp"

#include <algorithm>
#include <cmath>

#include "core/terrain/terrain_block.hpp"

namespace ridgeline {
namespace {

constexpr int side = block_posts;
constexpr float none_known = -1e9F;
constexpr float geoid_slack_m = 0.05F;  ///< floors are read with a coarser undulation
constexpr int bare_reach = 2;           ///< squares on every side of one without a known post

/// Square (i, j) of 64 x 64 lattice posts, with the highest known posts of its parts.
struct Square {
  std::array<float, side * side> posts{};
  /// By size 8, 16, 32: row-major, 8 x 8, 4 x 4, 2 x 2 of them.
  std::array<std::array<float, 64>, 3> parts{};
  float highest = none_known;
};

int floor_div(int a) {
  return a >> 6;  // squares are 64 posts wide
}

void read_square(const TerrainSource& source, int i, int j, Square& square) {
  std::array<float, 4 * side + 8> rows{};
  const PostBox box{i * side, j * side, side, side};
  read_region(source, box, side, square.posts, rows);
  square.highest = none_known;
  for (auto& of_size : square.parts) of_size.fill(none_known);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float h = square.posts[static_cast<std::size_t>(y * side + x)];
      if (std::isnan(h)) continue;
      for (int k = 0; k < 3; ++k) {
        const int part = (y >> (3 + k)) * (8 >> k) + (x >> (3 + k));
        float& highest = square.parts[static_cast<std::size_t>(k)][static_cast<std::size_t>(part)];
        highest = std::max(highest, h);
      }
      square.highest = std::max(square.highest, h);
    }
  }
}

/// The floor of a square without a known post.
float bare_floor(const TerrainSource& source, int i, int j, double far_floor_m) {
  const PostBox round{(i - bare_reach) * side, (j - bare_reach) * side, (2 * bare_reach + 1) * side,
                      (2 * bare_reach + 1) * side};
  const GeoBox place = geo_box(source.lattice, round);
  const bool any = std::any_of(source.tiles.begin(), source.tiles.end(),
                               [&](const HeightTile& t) { return overlaps(place, t.grid); });
  float highest = none_known;
  Square square;
  for (int b = j - bare_reach; any && b <= j + bare_reach; ++b) {
    for (int a = i - bare_reach; a <= i + bare_reach; ++a) {
      if (a == i && b == j) continue;
      read_square(source, a, b, square);
      highest = std::max(highest, square.highest);
    }
  }
  return highest > none_known ? highest : static_cast<float>(far_floor_m);
}

/// The part of one square that lies in the box.
struct Part {
  int row0, row1, column0, column1;  ///< lattice posts, end excluded
};

bool has_void(const PostBox& box, const Part& part, std::span<const float> region) {
  for (int r = part.row0; r < part.row1; ++r) {
    for (int c = part.column0; c < part.column1; ++c) {
      const auto at =
          static_cast<std::size_t>(r - box.row) * static_cast<std::size_t>(box.columns) +
          static_cast<std::size_t>(c - box.column);
      if (std::isnan(region[at])) return true;
    }
  }
  return false;
}

void put_square(const TerrainSource& source, const PostBox& box, const Part& part, int i, int j,
                double far_floor_m, std::span<float> region) {
  Square square;
  read_square(source, i, j, square);
  const bool bare = !(square.highest > none_known);
  const float outer = bare ? bare_floor(source, i, j, far_floor_m) : square.highest;
  const float slack = source.geoid.undulation_m == nullptr ? 0.0F : geoid_slack_m;
  for (int r = part.row0; r < part.row1; ++r) {
    for (int c = part.column0; c < part.column1; ++c) {
      float& post =
          region[static_cast<std::size_t>(r - box.row) * static_cast<std::size_t>(box.columns) +
                 static_cast<std::size_t>(c - box.column)];
      if (!std::isnan(post)) continue;
      const int y = r - j * side, x = c - i * side;
      float floor = none_known;
      for (int k = 0; k < 3 && !(floor > none_known); ++k) {
        const int at = (y >> (3 + k)) * (8 >> k) + (x >> (3 + k));
        floor = square.parts[static_cast<std::size_t>(k)][static_cast<std::size_t>(at)];
      }
      post = (floor > none_known ? floor : outer) + slack - void_offset_m;
    }
  }
}

}  // namespace

void put_floors(const TerrainSource& source, const PostBox& box, double far_floor_m,
                std::span<float> region) {
  const int i1 = floor_div(box.column + box.columns - 1), j1 = floor_div(box.row + box.rows - 1);
  for (int j = floor_div(box.row); j <= j1; ++j) {
    for (int i = floor_div(box.column); i <= i1; ++i) {
      const Part part{std::max(j * side, box.row), std::min((j + 1) * side, box.row + box.rows),
                      std::max(i * side, box.column),
                      std::min((i + 1) * side, box.column + box.columns)};
      if (has_void(box, part, region)) put_square(source, box, part, i, j, far_floor_m, region);
    }
  }
}

}  // namespace ridgeline
