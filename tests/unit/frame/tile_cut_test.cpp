// A picture whose lower part is planned again: both parts cover it once, and the rays of both have
// their own places in the targets, wherever the cut lies.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/frame/ray_tiles.hpp"
#include "core/frame/ray_witness.hpp"

namespace ridgeline {
namespace {

/// Marks what tiles cover; how often each place of the picture and of the targets is taken.
struct Covered {
  int width_px, height_px;
  std::vector<int> pixels, places;

  Covered(int width, int height) : width_px(width), height_px(height) {
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    places.resize(static_cast<std::size_t>(most_tiles(width)) *
                  static_cast<std::size_t>(most_tiles(height)));
  }
  void add(const RayTile& tile) {
    for (int y = tile.y(); y < tile.y() + tile.height(); ++y) {
      for (int x = tile.x(); x < tile.x() + tile.width(); ++x) {
        ++pixels.at(static_cast<std::size_t>(y * width_px + x));
      }
    }
    EXPECT_EQ(tile.rays_x() % ray_tile_px, 0);
    EXPECT_EQ(tile.rays_y() % ray_tile_px, 0);
    const int column = tile.rays_x() / ray_tile_px, row = tile.rays_y() / ray_tile_px;
    ASSERT_LT(column, most_tiles(width_px));
    ASSERT_LT(row, most_tiles(height_px));
    ++places.at(static_cast<std::size_t>(row * most_tiles(width_px) + column));
  }
};

void expect_covered_once(int width_px, int height_px, int ring_px, int kept_rows) {
  const TileAxis across{width_px, ring_px}, down{height_px, ring_px};
  std::vector<RayTile> above(static_cast<std::size_t>(most_tiles(width_px)) *
                             static_cast<std::size_t>(most_tiles(height_px)));
  std::vector<RayTile> below = above;
  put_tiles(across, down, above);
  const int from_px = down.begin(kept_rows);
  const TileAxis across_below{width_px, cut_ring_px};
  const TileAxis down_below{height_px, cut_ring_px, from_px, kept_rows};
  const int count = put_tiles(across_below, down_below, below);
  Covered covered(width_px, height_px);
  const int kept = kept_rows * across.count();
  for (int k = 0; k < kept; ++k) covered.add(above[static_cast<std::size_t>(k)]);
  for (int k = 0; k < count; ++k) covered.add(below[static_cast<std::size_t>(k)]);
  EXPECT_LE(kept + count, most_tiles(width_px) * most_tiles(height_px));
  for (const int times : covered.pixels) ASSERT_EQ(times, 1);
  for (const int times : covered.places) ASSERT_LE(times, 1);
  for (int px = from_px; px < height_px; ++px) {
    const int row = down_below.tile_of(px);
    ASSERT_LE(down_below.begin(row), px);
    ASSERT_LT(px, down_below.begin(row + 1));
  }
}

TEST(TileCut, leaves_every_pixel_one_tile_and_every_tile_a_place) {
  for (const int height_px : {96, 100, 127, 128, 129, 200, 223, 800}) {
    for (const int ring_px : {0, 2, 3, 5, 11}) {
      const TileAxis down{height_px, ring_px};
      for (int kept = 1; height_px - down.begin(kept) >= 4 * cut_ring_px; ++kept) {
        SCOPED_TRACE(testing::Message() << height_px << " ring " << ring_px << " kept " << kept);
        expect_covered_once(130, height_px, ring_px, kept);
      }
    }
  }
}

/// What a block bears in the middle of a direction's bin, as the plan asks it.
double bears(const BlockPair& blocks, int bin, double reach_px) {
  const double angle = (bin + 0.5) * std::numbers::pi / 64;
  return steepest_for_block(blocks, {std::cos(angle), std::sin(angle)}, {reach_px, 0.05, 0.003});
}

TEST(TileCut, single_pixels_beside_a_block_bear_what_any_other_shape_there_bears) {
  for (const BlockShape shape : {BlockShape{2, 2}, BlockShape{1, 2}, BlockShape{4, 4}}) {
    for (const BlockShape other : {BlockShape{1, 2}, BlockShape{2, 2}, BlockShape{3, 3}}) {
      for (int bin = 0; bin < 64; ++bin) {
        for (const double reach_px : {1.7, 2.7, 4.7}) {
          const double beside_other = bears({shape, other, false}, bin, reach_px);
          EXPECT_GE(bears({shape, {1, 1}, false}, bin, reach_px), beside_other);
          EXPECT_GE(bears({shape, other, false}, bin, 8.7), beside_other)
              << "a larger reach takes nothing away";
        }
      }
    }
  }
}

/// Why a frame that may be cut asks for both: its own lattice going on can be the better neighbour.
TEST(TileCut, single_pixels_beside_a_block_may_bear_less_than_its_own_lattice_going_on) {
  int worse = 0, worse_at_one_pixel = 0;
  for (int bin = 0; bin < 64; ++bin) {
    const BlockPair going_on{{1, 2}, {1, 2}, true}, cut{{1, 2}, {1, 1}, false};
    worse += bears(cut, bin, 4.7) < 0.5 * bears(going_on, bin, 4.7) ? 1 : 0;
    worse_at_one_pixel += bears(cut, bin, 1.7) < 0.99 * bears(going_on, bin, 1.7) ? 1 : 0;
  }
  EXPECT_GT(worse, 0);
  EXPECT_EQ(worse_at_one_pixel, 0);
}

}  // namespace
}  // namespace ridgeline
