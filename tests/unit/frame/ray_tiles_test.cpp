// Tiles of shared rays: they cut a picture without gap or overlap, and the slope that a block of
// pixels is good for leaves every pixel a witness on either side, whatever the ground so steep.
#include "core/frame/ray_tiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/frame/ray_witness.hpp"

namespace ridgeline {
namespace {

constexpr double most = 1e3;  ///< what steepest_for_block() says where any slope will do

TEST(RayTile, packs_two_numbers) {
  const RayTile tile{RayTile::pair(5, 4000), RayTile::pair(4096, 7), RayTile::pair(32, 17),
                     RayTile::pair(6, 3)};
  EXPECT_EQ(tile.x(), 5);
  EXPECT_EQ(tile.y(), 4000);
  EXPECT_EQ(tile.rays_x(), 4096);
  EXPECT_EQ(tile.rays_y(), 7);
  EXPECT_EQ(tile.width(), 32);
  EXPECT_EQ(tile.height(), 17);
  EXPECT_EQ(tile.shape().width, 6);
  EXPECT_EQ(tile.shape().height, 3);
  EXPECT_DOUBLE_EQ((BlockShape{4, 5}.radius_px()), 2.5);
  EXPECT_EQ((BlockShape{1, 1}.radius_px()), 0.0);
}

void expect_cut_once(int width_px, int height_px, int ring_px) {
  SCOPED_TRACE(testing::Message() << width_px << " x " << height_px << ", ring " << ring_px);
  const TileAxis across{width_px, ring_px}, down{height_px, ring_px};
  std::vector<RayTile> tiles(static_cast<std::size_t>(most_tiles(width_px)) *
                             static_cast<std::size_t>(most_tiles(height_px)));
  const int count = put_tiles(across, down, tiles);
  std::vector<int> covered(static_cast<std::size_t>(width_px) *
                           static_cast<std::size_t>(height_px));
  for (int k = 0; k < count; ++k) {
    const RayTile& tile = tiles[static_cast<std::size_t>(k)];
    EXPECT_EQ(tile.block, RayTile::pair(1, 1));
    EXPECT_GT(tile.width(), 0);
    EXPECT_GT(tile.height(), 0);
    for (int y = tile.y(); y < tile.y() + tile.height(); ++y) {
      for (int x = tile.x(); x < tile.x() + tile.width(); ++x) {
        ASSERT_LT(x, width_px);
        ASSERT_LT(y, height_px);
        ++covered[static_cast<std::size_t>(y * width_px + x)];
        EXPECT_EQ(down.tile_of(y + 0.5) * across.count() + across.tile_of(x + 0.5), k);
      }
    }
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), std::ssize(covered));
}

TEST(TileAxis, tiles_cover_every_pixel_once) {
  for (const int ring_px : {0, 1, 2, 3, 9}) {
    for (int size_px = std::max(32, 4 * ring_px); size_px < 140; size_px += 3) {
      expect_cut_once(size_px, 4 * ring_px + 33, ring_px);
      expect_cut_once(35, size_px, std::min(ring_px, 8));
    }
  }
}

TEST(TileAxis, points_beside_the_picture_are_in_its_border) {
  for (const int ring_px : {0, 1, 9}) {
    const TileAxis axis{100, ring_px};
    EXPECT_EQ(axis.tile_of(-1e6), 0);
    EXPECT_EQ(axis.tile_of(1e6), axis.count() - 1);
    EXPECT_EQ(axis.begin(axis.count()), 100);
  }
}

/// Crests one behind the other, each nowhere steeper than `slope` in the picture.
class Crests {
 public:
  Crests(double slope, std::mt19937& random) {
    for (int k = 0; k < crests; ++k) {
      std::vector<double> heights{0.0};
      for (int i = 1; i < posts; ++i) heights.push_back(heights.back() + step(slope, random));
      // All are about equally high in the middle, where the pixels are.
      const double raised = 0.7 * k + spread(random) - 0.35 * crests - heights[posts / 2];
      for (double& h : heights) h += raised;
      heights_.push_back(heights);
    }
  }
  /// Which crest a ray meets first; their number: none.
  [[nodiscard]] int first_hit(double above, double beside) const {
    const double at = beside / post_px + posts / 2;
    const int i = std::clamp(static_cast<int>(std::floor(at)), 0, posts - 2);
    for (int k = 0; k < crests; ++k) {
      const auto& h = heights_[static_cast<std::size_t>(k)];
      const auto j = static_cast<std::size_t>(i);
      if (h[j] + (at - i) * (h[j + 1] - h[j]) >= above) return k;
    }
    return crests;
  }

 private:
  static constexpr int crests = 40, posts = 161;
  static constexpr double post_px = 0.4;

  static double spread(std::mt19937& random) {
    return std::uniform_real_distribution<double>(-1, 1)(random);
  }
  static double step(double slope, std::mt19937& random) {
    return (spread(random) < 0 ? -slope : slope) * post_px;
  }
  std::vector<std::vector<double>> heights_;
};

/// Two tiles side by side, each with a lattice of blocks of its own. The border is at x or y = 0.
struct TwoTiles {
  BlockShape own, other;
  bool beside_in_x = true;
  int shift_x = 0, shift_y = 0;  ///< of the lattice of the other

  [[nodiscard]] glm::dvec2 ray_of(int x, int y) const {
    const bool is_other = (beside_in_x ? x : y) >= 0;
    const BlockShape& shape = is_other ? other : own;
    const int left = is_other ? shift_x : 0, top = is_other ? shift_y : 0;
    const auto middle = [](int at, int from, int size) {
      return from + size * std::floor(static_cast<double>(at - from) / size) + 0.5 * (size - 1);
    };
    return {middle(x, left, shape.width), middle(y, top, shape.height)};
  }
};

/// How many pixels of the own tile lack a witness on one side.
int bare_pixels(const TwoTiles& tiles, const Crests& ground, const glm::dvec2& way,
                double reach_px) {
  const auto hit = [&](const glm::dvec2& p) {
    return ground.first_hit(p.x * way.x + p.y * way.y, p.x * way.y - p.y * way.x);
  };
  const int reach = static_cast<int>(reach_px);
  int bare = 0;
  for (int k = -9; k < 0; ++k) {
    for (int along = -4; along < 5; ++along) {
      const int x = tiles.beside_in_x ? k : along, y = tiles.beside_in_x ? along : k;
      const int truth = hit({x, y});
      bool near = false, far = false;
      for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
          if (std::hypot(i, j) > reach_px) continue;
          const int shown = hit(tiles.ray_of(x + i, y + j));
          near = near || shown <= truth;
          far = far || shown >= truth;
        }
      }
      bare += near && far ? 0 : 1;
    }
  }
  return bare;
}

/// Of random directions, shapes and grounds, all `share` times as steep as a block is good for.
int bare_pixels_at(double share, unsigned seed) {
  constexpr BlockShape shapes[] = {{8, 8}, {6, 6}, {4, 4}, {3, 3}, {2, 2}, {1, 2}, {2, 1}, {1, 1}};
  std::mt19937 random(seed);
  const auto whole = [&](int count) { return static_cast<int>(random() % unsigned(count)); };
  int bare = 0;
  for (int scene = 0; scene < 2000; ++scene) {
    TwoTiles tiles{shapes[whole(7)], shapes[whole(8)], whole(2) == 0, whole(8), whole(8)};
    const double angle =
        whole(8) == 0 ? 0.25 * std::numbers::pi * whole(8) : 2e-3 * std::numbers::pi * whole(1000);
    const glm::dvec2 way{std::cos(angle), std::sin(angle)};
    const double radius_px = std::max(tiles.own.radius_px(), tiles.other.radius_px());
    const double reach_px = 0.7071 + radius_px + 0.25 * whole(8);
    const double steepest = std::min(steepest_for_block({tiles.own, tiles.own}, way, {reach_px}),
                                     steepest_for_block({tiles.own, tiles.other}, way, {reach_px}));
    if (steepest <= 0) continue;
    const Crests ground(share * std::min(steepest, 20.0), random);
    bare += bare_pixels(tiles, ground, way, reach_px);
  }
  return bare;
}

TEST(SteepestForBlock, every_pixel_has_a_witness_on_either_side) {
  for (const unsigned seed : {1U, 2U, 3U}) EXPECT_EQ(bare_pixels_at(0.999, seed), 0);
}

TEST(SteepestForBlock, steeper_ground_leaves_pixels_bare) {
  EXPECT_GT(bare_pixels_at(5.0, 1), 0);
}

TEST(SteepestForBlock, single_pixels_allow_any_slope) {
  for (int k = 0; k < 32; ++k) {
    const double angle = std::numbers::pi * k / 32;
    const glm::dvec2 way{std::cos(angle), std::sin(angle)};
    const double alone = steepest_for_block({{1, 1}, {1, 1}}, way, {1.7071, 0.0});
    EXPECT_GE(alone, 0.0);
    EXPECT_LE(alone, most);
    // What rounding may move is never a gain, and neither is a shorter reach.
    const double wide = steepest_for_block({{2, 2}, {2, 2}}, way, {2.7071, 0.0});
    EXPECT_LE(steepest_for_block({{2, 2}, {2, 2}}, way, {2.7071, 0.1}), wide);
    EXPECT_LE(steepest_for_block({{2, 2}, {2, 2}}, way, {1.7071, 0.0}), wide);
    EXPECT_LE(steepest_for_block({{2, 2}, {4, 4}}, way, {2.7071, 0.0}), wide);
  }
}

TEST(SteepestForBlock, no_ground_will_do_where_no_ray_is_in_reach) {
  EXPECT_EQ(steepest_for_block({{8, 8}, {8, 8}}, {0, 1}, {0.9, 0.0}), 0.0);
  EXPECT_EQ(steepest_for_block({{2, 2}, {2, 2}}, {0, 1}, {1.7071, 5.0}), 0.0);
}

}  // namespace
}  // namespace ridgeline
