#include "core/render/squares.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/render/tile_list.hpp"

namespace ridgeline::test {
namespace {

TEST(Squares, cover_every_place_once) {
  for (int width = 1; width <= 45; ++width) {
    for (int height = 1; height <= 45; ++height) {
      std::vector<int> covered(static_cast<std::size_t>(width * height));
      cut_into_squares(width, height, [&](int x, int y, int side) {
        ASSERT_GT(side, 0);
        ASSERT_LE(x + side, width);
        ASSERT_LE(y + side, height);
        for (int row = y; row < y + side; ++row) {
          for (int column = x; column < x + side; ++column) {
            ++covered[static_cast<std::size_t>(row * width + column)];
          }
        }
      });
      for (const int times : covered) ASSERT_EQ(times, 1) << width << " x " << height;
    }
  }
}

TEST(Squares, nothing_has_none) {
  int count = 0;
  const auto put = [&](int, int, int) { ++count; };
  cut_into_squares(0, 5, put);
  cut_into_squares(5, 0, put);
  EXPECT_EQ(count, 0);
}

/// Squares of a whole picture, cut as it is for these blocks and this border.
int squares_of_picture(int width, int height, int ring_px, const BlockShape& block, TileFace face) {
  std::vector<RayTile> tiles(static_cast<std::size_t>(most_tiles(width) * most_tiles(height)));
  const int count = put_tiles({width, ring_px}, {height, ring_px}, tiles);
  int squares = 0;
  for (int k = 0; k < count; ++k) {
    RayTile& tile = tiles[static_cast<std::size_t>(k)];
    tile.block = RayTile::pair(block.width, block.height);
    squares += square_count(tile, face);
  }
  return squares;
}

TEST(Squares, of_any_picture_fit_their_list) {
  for (const int width : {16, 33, 63, 319, 1024, 1025}) {
    for (const int height : {16, 31, 65, 240, 799, 800}) {
      const int most = most_squares(most_tiles(width), most_tiles(height));
      for (const int ring_px : {0, 1, 3, 7}) {
        if (2 * ring_px >= std::min(width, height)) continue;
        for (const int across : {1, 2, 4, 8}) {
          for (const int down : {1, 2, 4, 8}) {
            for (const TileFace face : {TileFace::rays, TileFace::pixels}) {
              EXPECT_LE(squares_of_picture(width, height, ring_px, {across, down}, face), most)
                  << width << " x " << height << ", ring " << ring_px;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
