// What a block says of the ground it stands for: residual, class, slope, ball.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "core/geo/local_frame.hpp"
#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

constexpr float far_floor = 50.0F;

bool is_void(float post) {
  return post < void_threshold_m;
}

/// A block and its neighbours to the east, north and north-east: all posts of its own cells.
struct Cells {
  TerrainBlock own, east, north, corner;

  Cells(const TerrainSource& source, const BlockId& id)
      : own(block_of(source, id, far_floor_of())),
        east(block_of(source, {id.level, id.column + 1, id.row}, far_floor_of())),
        north(block_of(source, {id.level, id.column, id.row + 1}, far_floor_of())),
        corner(block_of(source, {id.level, id.column + 1, id.row + 1}, far_floor_of())) {}

  static double far_floor_of() { return static_cast<double>(far_floor); }
  [[nodiscard]] float post(int x, int y) const {
    const TerrainBlock& block = x < 64 ? (y < 64 ? own : north) : (y < 64 ? east : corner);
    return block.posts[static_cast<std::size_t>((y % 64) * 64 + x % 64)];
  }
  [[nodiscard]] bool known(int x, int y) const {
    return !is_void(post(x, y)) && !is_void(post(x + 1, y)) && !is_void(post(x, y + 1)) &&
           !is_void(post(x + 1, y + 1));
  }
  /// Surface of a known cell; fx, fy in 0..1.
  [[nodiscard]] double surface_m(int x, int y, double fx, double fy) const {
    const auto at = [&](int dx, int dy) { return static_cast<double>(post(x + dx, y + dy)); };
    return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
           fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
  }
};

/// Rough ground with voids, partly of coarser tiles, around lattice post 0, 0.
Ground mixed_ground(int seed, const Ground::Height& height) {
  Ground ground(lattice_1s());
  ground.add({-600, -600, 1, 1, 601, 1201}, height);
  ground.add({0, -600, 3, 3, 401, 201}, height);
  ground.add({0, 0, 1, 1, 901, 901}, rough_with_voids(seed));
  ground.finish();
  return ground;
}

std::vector<BlockId> some_blocks(int level) {
  std::vector<BlockId> ids;
  for (int column = -2; column <= 1; ++column) {
    for (int row = -2; row <= 1; ++row) ids.push_back({level, column, row});
  }
  return ids;
}

/// Whether all ground of a cell of a block is known.
bool whole(const Ground& ground, const BlockId& id, int x, int y) {
  const int step = 1 << id.level;
  bool known = true;
  for (int k = 0; k < step * step; ++k) {
    known = known && ground.cell_known((id.column * 64 + x) * step + k % step,
                                       (id.row * 64 + y) * step + k / step);
  }
  return known;
}

void expect_residual(const Ground& ground, const BlockId& id, std::mt19937& random) {
  const Cells cells(ground.source(), id);
  const BlockFacts& facts = cells.own.facts;
  const int step = 1 << id.level;
  const auto share = [&] { return static_cast<double>(random()) * 0x1p-32; };
  for (int k = 0; k < 4000; ++k) {
    const int x = static_cast<int>(random() % 64U), y = static_cast<int>(random() % 64U);
    // A fine post of the cell seen from just inside, or any place.
    double fx = share(), fy = share();
    if (k % 2 == 0) {
      fx = std::clamp(std::floor(fx * (step + 1)) / step, 1e-7, 1 - 1e-7);
      fy = std::clamp(std::floor(fy * (step + 1)) / step, 1e-7, 1 - 1e-7);
    }
    const double truth =
        ground.height_m((id.column * 64 + x + fx) * step, (id.row * 64 + y + fy) * step);
    if (std::isnan(truth) == cells.known(x, y)) {
      // A place on the border of two fine cells counts for both; inside there is no excuse.
      if (k % 2 == 1) {
        ASSERT_TRUE(facts.mixed) << id.level << ' ' << id.column << ' ' << id.row;
      }
      continue;
    }
    if (std::isnan(truth)) continue;
    if (facts.mixed && !whole(ground, id, x, y)) continue;  // never drawn, and not all known
    const int part = y / 16 * residual_parts + x / 16;
    const auto residual =
        static_cast<double>(facts.part_residual_m[static_cast<std::size_t>(part)]);
    ASSERT_LE(std::abs(truth - cells.surface_m(x, y, fx, fy)), residual + 1e-3)
        << id.level << ' ' << id.column << ' ' << id.row << " at " << x << ' ' << y;
    ASSERT_LE(residual, static_cast<double>(facts.residual_m));
  }
}

TEST(Block, the_truth_lies_within_the_residual_of_its_surface) {
  const Ground ground = mixed_ground(60, rough(61));
  std::mt19937 random(12);
  for (int level = 0; level <= 4; ++level) {
    for (const BlockId& id : some_blocks(level)) {
      expect_residual(ground, id, random);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Block, the_truth_lies_within_the_residual_where_tiles_have_voids) {
  const Ground ground = mixed_ground(62, rough_with_voids(63));
  std::mt19937 random(13);
  for (int level = 0; level <= 3; ++level) {
    for (const BlockId& id : some_blocks(level)) {
      expect_residual(ground, id, random);
      if (HasFatalFailure()) return;
    }
  }
}

// 2026-11-23: a block's region ends two posts beyond it, within a cell of a tile six times coarser.
TEST(Block, the_truth_lies_within_the_residual_beside_a_tile_six_times_coarser) {
  std::mt19937 random(14);
  for (int shift = -6; shift <= 6; ++shift) {
    Ground ground(lattice_1s());
    ground.add({-300 + shift, -300, 1, 1, 301, 601}, [](int, int) { return 900.0F; });
    ground.add({shift, -300, 6, 6, 51, 101}, [](int, int) { return 100.0F; });
    ground.finish();
    for (const BlockId& id : {BlockId{0, 0, 0}, BlockId{0, -1, 0}, BlockId{1, 0, 0}}) {
      expect_residual(ground, id, random);
    }
    if (HasFatalFailure()) return;
  }
}

TEST(Block, level_0_is_the_region_bit_for_bit) {
  const Ground ground = mixed_ground(64, rough_with_voids(65));
  int known = 0, voids = 0;
  for (const BlockId& id : some_blocks(0)) {
    const TerrainBlock block = block_of(ground.source(), id);
    const Region region = region_of(ground.source(), {id.column * 64, id.row * 64, 64, 64});
    for (std::size_t k = 0; k < block.posts.size(); ++k) {
      if (std::isnan(region.posts[k])) {
        ASSERT_TRUE(is_void(block.posts[k]));
        ++voids;
      } else {
        ASSERT_EQ(block.posts[k], region.posts[k]);
        ++known;
      }
    }
  }
  EXPECT_GT(known, 10'000);
  EXPECT_GT(voids, 100);
}

TEST(Block, level_0_over_one_step_is_exact) {
  Ground ground(lattice_3s());
  ground.add({-300, -300, 1, 1, 301, 601}, rough_with_voids(66));
  ground.add({0, -300, 1, 1, 301, 601}, rough_with_voids(67));
  ground.finish();
  for (const BlockId& id : some_blocks(0)) {
    const BlockFacts facts = block_of(ground.source(), id).facts;
    EXPECT_EQ(facts.residual_m, 0);
    EXPECT_FALSE(facts.mixed);
  }
}

/// Whether some cell of the block is drawn otherwise than one of its fine cells is.
bool differs(const Ground& ground, const Cells& cells, const BlockId& id) {
  const int step = 1 << id.level;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int k = 0; k < step * step; ++k) {
        const int column = (id.column * 64 + x) * step + k % step;
        const int row = (id.row * 64 + y) * step + k / step;
        if (ground.cell_known(column, row) != cells.known(x, y)) return true;
      }
    }
  }
  return false;
}

TEST(Block, is_mixed_exactly_where_a_cell_hides_another_class) {
  Ground ground(lattice_3s());
  ground.add({-600, -600, 1, 1, 601, 1201}, [](int column, int row) {
    const bool speck = lottery(column, row, 68) > 0.99995;
    const bool lake = column >= -400 && column < -300 && row > -400 && row < -200;
    return speck || lake ? unknown : 500.0F;
  });
  ground.add({0, -600, 1, 1, 601, 601}, [](int, int) { return 700.0F; });
  ground.finish();
  int mixed = 0, plain = 0;
  for (int level = 0; level <= 3; ++level) {
    for (const BlockId& id : some_blocks(level)) {
      const Cells cells(ground.source(), id);
      EXPECT_EQ(cells.own.facts.mixed, differs(ground, cells, id))
          << level << ' ' << id.column << ' ' << id.row;
      ++(cells.own.facts.mixed ? mixed : plain);
    }
  }
  EXPECT_GT(mixed, 5);
  EXPECT_GT(plain, 5);
}

TEST(Block, the_edge_of_a_missing_tile_on_its_own_posts_mixes_nothing) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 1201, 1201}, rough(69));
  ground.finish();
  for (int level = 0; level <= 4; ++level) {
    const int past = 1200 >> (level + 6);
    for (const BlockId& id : {BlockId{level, -1, 0}, BlockId{level, 0, 0}, BlockId{level, past, 0},
                              BlockId{level, past, past}, BlockId{level, past + 1, past}}) {
      EXPECT_FALSE(block_of(ground.source(), id).facts.mixed) << level << ' ' << id.column;
    }
  }
}

/// Metres from post to post at a latitude.
glm::dvec2 post_m(const PostLattice& lattice, double latitude_deg) {
  constexpr double a = 6'378'137.0, e2 = 6.69437999014e-3, rad = std::numbers::pi / 180;
  const double w = 1 - e2 * std::pow(std::sin(latitude_deg * rad), 2);
  return {lattice.longitude_step_deg * rad * a / std::sqrt(w) * std::cos(latitude_deg * rad),
          lattice.latitude_step_deg * rad * a * (1 - e2) / std::pow(w, 1.5)};
}

TEST(Block, no_slope_of_the_truth_is_steeper_than_it_says) {
  for (const double south_deg : {46.0, -0.02, -46.0, 89.3, -89.95}) {
    Ground ground({south_deg, 8.0, 1.0 / 1200, 1.0 / 1200});
    ground.add({0, 0, 1, 1, 601, 601}, rough_with_voids(70));
    ground.finish();
    for (int level = 1; level <= 3; ++level) {
      const BlockId id{level, 0, 0};
      const auto said = static_cast<double>(block_of(ground.source(), id).facts.steepness);
      const int last = std::min(64 << level, 600);
      double steepest = 0;
      for (int r = 0; r < last; ++r) {
        for (int c = 0; c < last; ++c) {
          if (!ground.cell_known(c, r)) continue;
          const double south = ground.lattice().latitude_deg(r);
          if (south + ground.lattice().latitude_step_deg > 90) continue;
          const glm::dvec2 post =
              post_m(ground.lattice(), south + (south > 0) / 1200.0);  // the narrower edge
          constexpr double in = 1e-6;
          const double sw = ground.height_m(c + in, r + in);
          const double se = ground.height_m(c + 1 - in, r + in);
          const double nw = ground.height_m(c + in, r + 1 - in);
          const double ne = ground.height_m(c + 1 - in, r + 1 - in);
          for (const double east : {se - sw, ne - nw}) {
            for (const double north : {nw - sw, ne - se}) {
              steepest = std::max(steepest, std::hypot(east / post.x, north / post.y));
            }
          }
        }
      }
      EXPECT_GE(said, steepest * (1 - 1e-4)) << south_deg << ' ' << level;
    }
  }
}

// 2026-11-23: the last row and column of cells end on posts of the next block, and true posts stand
// between those of the level; neither counted for the lowest ground.
TEST(Block, its_ball_holds_all_its_ground) {
  for (const double south_deg : {46.0, -0.02, 70.0, 88.9}) {
    Ground ground({south_deg, 8.0, 1.0 / 1200, 1.0 / 1200});
    ground.add({0, 0, 1, 1, 1101, 1101}, [](int column, int row) {
      const bool gorge = (column / 8) % 16 == 8 || (row / 8) % 16 == 8;
      const float high = lottery(column / 8, row / 8, 71) > 0.95 ? 5000.0F : 4000.0F;
      return gorge ? -300.0F : high;
    });
    ground.finish();
    std::mt19937 random(15);
    for (int level = 0; level <= 4; ++level) {
      const BlockId id{level, 0, 0};
      const BlockFacts facts = block_of(ground.source(), id).facts;
      const double span = 64 << level;
      double worst_m = 0;
      for (int k = 0; k < 20'000; ++k) {
        const double x = std::clamp(static_cast<double>(random()) * 0x1p-32 * 1.1 - 0.05, 0.0, 1.0);
        const double y = std::clamp(static_cast<double>(random()) * 0x1p-32 * 1.1 - 0.05, 0.0, 1.0);
        const double height = ground.height_m(x * span, y * span);
        if (std::isnan(height)) continue;
        const Vec3<Ecef> place =
            ecef_from_geodetic({ground.lattice().latitude_deg(y * span),
                                ground.lattice().longitude_deg(x * span), height});
        EXPECT_LE(height, static_cast<double>(facts.highest_m));
        worst_m = std::max(worst_m, glm::length((place - facts.centre).xyz) - facts.radius_m);
      }
      EXPECT_LE(worst_m, 0) << south_deg << ' ' << level;
    }
  }
}

TEST(Block, counts_its_own_posts_and_its_lowest_ground) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 33, 201}, rough(72));
  ground.finish();
  const BlockFacts facts = block_of(ground.source(), {0, 0, 0}).facts;
  EXPECT_EQ(facts.known_posts, 33 * 64);
  EXPECT_EQ(facts.void_posts, 31 * 64);
  float lowest = 1e9F;
  for (int r = 0; r <= 64; ++r) {  // the last cells end on the posts of the next block
    for (int c = 0; c <= 32; ++c) lowest = std::min(lowest, rough(72)(c, r));
  }
  EXPECT_EQ(facts.lowest_m, lowest);
  const BlockFacts nothing = block_of(ground.source(), {0, 40, 40}, 321.0).facts;
  EXPECT_EQ(nothing.known_posts, 0);
  EXPECT_NEAR(static_cast<double>(nothing.highest_m), 321, 0.01);
  EXPECT_FALSE(nothing.mixed);
}

}  // namespace
}  // namespace ridgeline::test
