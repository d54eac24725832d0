// The pyramid of a block against every finer surface it must bound; the geoid; neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

constexpr double far_floor = 50.0;

/// How high every lattice-aligned post of a level is drawn: its height, or its floor.
class Tops {
 public:
  Tops(const TerrainSource& source, int level) : source_(source), level_(level) {}

  /// Units: posts of the level.
  [[nodiscard]] float at(int column, int row) {
    const int i = column >> 6, j = row >> 6;
    auto found = blocks_.find({i, j});
    if (found == blocks_.end()) {
      found = blocks_.emplace(std::pair(i, j), block_of(source_, {level_, i, j}, far_floor)).first;
    }
    const float post =
        found->second.posts[static_cast<std::size_t>((row & 63) * 64 + (column & 63))];
    return post < void_threshold_m ? post + void_offset_m : post;
  }

 private:
  const TerrainSource& source_;
  int level_;
  std::map<std::pair<int, int>, TerrainBlock> blocks_;
};

/// Every smallest node of a block is as high as all surfaces of a level within one cell of it.
void expect_nodes_over(const TerrainBlock& block, Tops& tops, int level) {
  const BlockId& id = block.id;
  const int finer = id.level - level;
  for (int j = 0; j < 32; ++j) {
    for (int i = 0; i < 32; ++i) {
      const int west = (id.column * 64 + 2 * i - 1) << finer;
      const int south = (id.row * 64 + 2 * j - 1) << finer;
      float highest = -1e9F;
      for (int r = south; r <= south + (4 << finer); ++r) {
        for (int c = west; c <= west + (4 << finer); ++c) {
          highest = std::max(highest, tops.at(c, r));
        }
      }
      ASSERT_GE(block.highest[static_cast<std::size_t>(j * 32 + i)], highest - 1e-3F)
          << "node " << i << ' ' << j << " of level " << id.level << " over level " << level;
    }
  }
}

Ground lands() {
  Ground ground(lattice_1s());
  ground.add({-900, -900, 1, 1, 901, 2401}, rough_with_voids(80));
  ground.add({0, -900, 3, 3, 501, 301}, rough_with_voids(81));
  ground.add({0, 0, 1, 1, 1501, 1501}, rough_with_voids(82));
  ground.finish();
  return ground;
}

TEST(Pyramid, a_node_bounds_every_finer_surface_within_one_cell_of_it) {
  const Ground ground = lands();
  const TerrainSource source = ground.source();
  std::vector<Tops> tops;
  for (int level = 0; level <= 4; ++level) tops.emplace_back(source, level);
  for (int level = 0; level <= 4; ++level) {
    for (const BlockId& id :
         {BlockId{level, 0, 0}, BlockId{level, -1, 0}, BlockId{level, -1, -1}}) {
      const TerrainBlock block = block_of(source, id, far_floor);
      for (int below = 0; below <= level; ++below) {
        expect_nodes_over(block, tops[static_cast<std::size_t>(below)], below);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(Pyramid, its_upper_nodes_are_the_maxima_of_the_four_below) {
  const Ground ground = lands();
  const TerrainBlock block = block_of(ground.source(), {1, 0, 0}, far_floor);
  std::size_t below = 0;
  for (int side = 16; side >= 1; side /= 2) {
    const std::size_t here = below + static_cast<std::size_t>(4 * side * side);
    for (int k = 0; k < side * side; ++k) {
      const int i = k % side, j = k / side;
      float highest = -1e9F;
      for (int q = 0; q < 4; ++q) {
        const int at = (2 * j + q / 2) * 2 * side + 2 * i + q % 2;
        highest = std::max(highest, block.highest[below + static_cast<std::size_t>(at)]);
      }
      ASSERT_EQ(block.highest[here + static_cast<std::size_t>(k)], highest);
    }
    below = here;
  }
  EXPECT_EQ(below + 1, block.highest.size());
  EXPECT_EQ(block.facts.highest_m, block.highest.back());
}

TEST(Pyramid, is_no_higher_than_what_stands_two_cells_round_a_node) {
  const Ground ground = lands();
  const TerrainSource source = ground.source();
  Tops fine(source, 0);
  for (const int level : {1, 2}) {
    const TerrainBlock block = block_of(source, {level, 0, 0}, far_floor);
    for (int k = 0; k < 32 * 32; ++k) {
      const int step = 1 << level;
      const int west = (2 * (k % 32) - 3) * step, south = (2 * (k / 32) - 3) * step;
      float highest = -1e9F;
      for (int r = south; r <= south + 8 * step; ++r) {
        for (int c = west; c <= west + 8 * step; ++c) highest = std::max(highest, fine.at(c, r));
      }
      ASSERT_LE(block.highest[static_cast<std::size_t>(k)], highest) << level << ' ' << k;
    }
  }
}

/// A smooth undulation, curved in both directions. Units: m.
double smooth_undulation(const void* /*context*/, double latitude_deg, double longitude_deg) {
  return 48 + 3 * (latitude_deg - 46) * (latitude_deg - 46) + 2 * (longitude_deg - 8);
}

TEST(Geoid, is_added_to_every_post_of_level_0) {
  const Ground ground = lands();
  TerrainSource source = ground.source();
  const Region raw = region_of(source, {0, 0, 64, 64});
  source.geoid = {smooth_undulation, nullptr};
  const TerrainBlock block = block_of(source, {0, 0, 0}, far_floor);
  for (int k = 0; k < 64 * 64; ++k) {
    const float post = raw.posts[static_cast<std::size_t>(k)];
    if (std::isnan(post)) continue;
    const double n = smooth_undulation(nullptr, ground.lattice().latitude_deg(k / 64),
                                       ground.lattice().longitude_deg(k % 64));
    ASSERT_NEAR(static_cast<double>(block.posts[static_cast<std::size_t>(k)]),
                static_cast<double>(post) + n, 1e-3);
  }
}

TEST(Geoid, is_asked_for_no_latitude_beyond_a_pole) {
  Ground ground({89.5, 8.0, 1.0 / 120, 1.0 / 120});
  ground.add({0, 0, 1, 1, 121, 61}, rough(83));
  ground.finish();
  TerrainSource source = ground.source();
  source.geoid = {[](const void*, double latitude_deg, double) {
                    EXPECT_LE(std::abs(latitude_deg), 90.0);
                    return 13.0;
                  },
                  nullptr};
  for (int level = 0; level <= 2; ++level) {
    EXPECT_GT(block_of(source, {level, 0, 0}, far_floor).facts.known_posts, 0);
  }
}

constexpr double grid_deg = 0.25;  ///< of a geoid file of the usual size

/// Undulation as a grid of a quarter of a degree has it: bilinear, with kinks of 1 m. Units: m.
double gridded_undulation(const void* /*context*/, double latitude_deg, double longitude_deg) {
  const auto node = [](int i, int j) { return 40 + 0.5 * (i % 2) + 0.5 * (j % 2); };
  const double x = (longitude_deg + 360) / grid_deg, y = (latitude_deg + 90) / grid_deg;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  return (1 - fy) * ((1 - fx) * node(i, j) + fx * node(i + 1, j)) +
         fy * ((1 - fx) * node(i, j + 1) + fx * node(i + 1, j + 1));
}

TEST(Geoid, coarse_levels_stay_within_their_residual_at_the_kinks_of_its_grid) {
  for (const double step_deg : {1.0 / 1200, 1.0 / 120}) {  // DTED level 1 and 0
    Ground ground({46.0, 8.0, step_deg, step_deg});
    ground.add({-1000, -1000, 1, 1, 2001, 2001}, [](int, int) { return 700.0F; });
    ground.finish();
    TerrainSource source = ground.source();
    source.geoid = {gridded_undulation, nullptr};
    for (int level = 1; level <= 3; ++level) {
      const TerrainBlock block = block_of(source, {level, 0, 0}, far_floor);
      double worst_m = 0;
      for (int k = 0; k < 63 * 63; ++k) {
        const int x = k % 63, y = k / 63, part = y / 16 * residual_parts + x / 16;
        const auto at = [&](int dx, int dy) {
          const auto index = static_cast<std::size_t>((y + dy) * 64 + x + dx);
          return static_cast<double>(block.posts[index]);
        };
        for (int q = 0; q <= 16; ++q) {
          const double fx = (q % 4) / 4.0, fy = (q / 4) / 4.0;
          const double surface = (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
                                 fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
          const double truth =
              700 + gridded_undulation(nullptr,
                                       ground.lattice().latitude_deg((y + fy) * (1 << level)),
                                       ground.lattice().longitude_deg((x + fx) * (1 << level)));
          const auto residual =
              static_cast<double>(block.facts.part_residual_m[static_cast<std::size_t>(part)]);
          worst_m = std::max(worst_m, std::abs(truth - surface) - residual);
        }
      }
      EXPECT_LE(worst_m, 1e-3) << "level " << level << ", posts of " << step_deg * 3600 << '"';
    }
  }
}

TEST(Geoid, a_floor_stays_over_the_posts_it_is_taken_from) {
  const Ground ground = lands();
  TerrainSource source = ground.source();
  source.geoid = {gridded_undulation, nullptr};
  const Region plain = region_of(source, {-64, -64, 256, 256});
  int checked = 0;
  for (int k = 0; k < 16; ++k) {
    const BlockId id{0, k % 4 - 1, k / 4 - 1};
    const TerrainBlock block = block_of(source, id, far_floor);
    for (int p = 0; p < 64 * 64; ++p) {
      const float post = block.posts[static_cast<std::size_t>(p)];
      if (post > void_threshold_m) continue;
      const int column = id.column * 64 + p % 64, row = id.row * 64 + p / 64;
      float highest = -1e9F;
      for (int q = 0; q < 64; ++q) {
        const float h = plain.at((column & ~7) + q % 8, (row & ~7) + q / 8);
        if (!std::isnan(h)) highest = std::max(highest, h);
      }
      if (highest < -1e8F) continue;
      ++checked;
      ASSERT_GE(post + void_offset_m, highest - 0.01F);
      ASSERT_LE(post + void_offset_m, highest + 0.2F);
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(Block, built_twice_in_dirty_memory_has_the_same_bits) {
  const Ground ground = lands();
  const TerrainSource source = ground.source();
  const auto side = static_cast<std::size_t>(region_side(4));
  std::vector<float> posts(side * side, unknown), rows(static_cast<std::size_t>(row_scratch(4)), 7);
  std::vector<float> rests(region_side(0) * region_side(0), unknown);
  TerrainBlock reused;
  for (int level = 4; level >= 0; --level) {
    const BlockId id{level, level - 2, -1};
    build_block(source, id, far_floor, {posts, rows, rests}, reused);
    const TerrainBlock fresh = block_of(source, id, far_floor);
    EXPECT_EQ(reused.posts, fresh.posts) << level;
    EXPECT_EQ(reused.highest, fresh.highest) << level;
    EXPECT_EQ(reused.facts.part_residual_m, fresh.facts.part_residual_m);
    EXPECT_EQ(reused.facts.mixed, fresh.facts.mixed);
    EXPECT_EQ(reused.facts.steepness, fresh.facts.steepness);
    EXPECT_EQ(reused.facts.known_posts, fresh.facts.known_posts);
    EXPECT_EQ(reused.facts.lowest_m, fresh.facts.lowest_m);
  }
}

TEST(Block, a_changed_post_changes_no_block_whose_neighbourhood_it_is_not_in) {
  for (const bool raised : {true, false}) {
    Ground ground(lattice_1s());
    ground.add({-900, -900, 1, 1, 901, 2401}, rough_with_voids(84));
    ground.add({0, -900, 3, 3, 801, 801}, rough_with_voids(85));
    ground.edit({-30, 60, 3, 3, 12, 1}, [raised](int, int) { return raised ? 6000.0F : unknown; });
    ground.finish();
    for (int level = 0; level <= 2; ++level) {
      int changed = 0;
      for (int k = 0; k < 11 * 11; ++k) {
        const BlockId id{level, k % 11 - 5, k / 11 - 5};
        const TerrainBlock before = block_of(ground.source(0), id, far_floor);
        const TerrainBlock after = block_of(ground.source(), id, far_floor);
        const bool same = before.posts == after.posts && before.highest == after.highest &&
                          before.facts.residual_m == after.facts.residual_m &&
                          before.facts.mixed == after.facts.mixed;
        if (same) continue;
        ++changed;
        // The coarse tile carries a post three lattice posts farther.
        const PostBox near = block_neighbourhood(id);
        EXPECT_TRUE(near.column <= 3 + 3 && near.column + near.columns > -33 && near.row <= 63 &&
                    near.row + near.rows > 57)
            << level << ' ' << id.column << ' ' << id.row;
      }
      EXPECT_GT(changed, 0);
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
