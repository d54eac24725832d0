// Floors of unknown ground: the three rules, and what the contract asks of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/terrain/void_floor.hpp"
#include "platform/block_worker.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"
#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

constexpr float far_floor = 123.0F;

int aligned(int value, int size) {
  return static_cast<int>(std::floor(static_cast<double>(value) / size)) * size;
}

/// A region whose void posts got their floors.
Region floored(const TerrainSource& source, const PostBox& box) {
  Region region = region_of(source, box);
  put_floors(source, box, static_cast<double>(far_floor), region.posts);
  return region;
}

float floor_at(const Region& region, int column, int row) {
  EXPECT_LT(region.at(column, row), void_threshold_m);
  return region.at(column, row) + void_offset_m;
}

/// Lattice posts read once, with plain searches over rectangles of them.
class Plain {
 public:
  Region all;

  explicit Plain(const TerrainSource& source) : all(region_of(source, {-500, -500, 1500, 1500})) {}

  /// Highest (or lowest) known post of columns [column, column + width), NaN where there is none.
  [[nodiscard]] float extreme(int column, int row, int width, int height, bool highest) const {
    float best = unknown;
    for (int r = std::max(row, -500); r < std::min(row + height, 1000); ++r) {
      for (int c = std::max(column, -500); c < std::min(column + width, 1000); ++c) {
        const float h = all.at(c, r);
        if (std::isnan(h)) continue;
        if (std::isnan(best) || (highest ? h > best : h < best)) best = h;
      }
    }
    return best;
  }
  [[nodiscard]] float floor_m(int column, int row) {
    for (int size = 8; size <= 64; size *= 2) {
      const float h = extreme(aligned(column, size), aligned(row, size), size, size, true);
      if (!std::isnan(h)) return h;
    }
    const std::pair square(aligned(column, 64), aligned(row, 64));
    auto found = bare_.find(square);
    if (found == bare_.end()) {
      const float h = extreme(square.first - 128, square.second - 128, 320, 320, true);
      found = bare_.emplace(square, std::isnan(h) ? far_floor : h).first;
    }
    return found->second;
  }

 private:
  std::map<std::pair<int, int>, float> bare_;  ///< of squares without a known post
};

/// Two tiles of one step with voids of every size, between missing ones.
Ground holey(int seed) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 601, 601}, [seed](int column, int row) {
    const bool lake = column > 150 && column < 420 && row > 130 && row < 460;
    return lake ? unknown : rough_with_voids(seed)(column, row);
  });
  ground.add({600, 0, 1, 1, 151, 151}, rough_with_voids(seed + 1));
  ground.finish();
  return ground;
}

TEST(Floor, follows_the_three_rules_for_every_void_post_of_any_box) {
  const Ground ground = holey(50);
  Plain plain(ground.source());
  std::map<float, int> rules;
  std::mt19937 random(8);
  for (int k = 0; k < 12; ++k) {
    const int side = 30 + static_cast<int>(random() % 150U);
    const PostBox box{static_cast<int>(random() % 1000U) - 300,
                      static_cast<int>(random() % 1000U) - 300, side, side};
    const Region region = floored(ground.source(), box);
    for (int r = box.row; r < box.row + side; r += 1 + k % 3) {
      for (int c = box.column; c < box.column + side; c += 1 + k % 2) {
        const float raw = plain.all.at(c, r);
        if (!std::isnan(raw)) {
          ASSERT_EQ(region.at(c, r), raw);
          continue;
        }
        const float expected = plain.floor_m(c, r);
        ASSERT_NEAR(static_cast<double>(floor_at(region, c, r)), static_cast<double>(expected),
                    0.01)
            << c << ' ' << r;
        ++rules[expected == far_floor ? 2.0F : 1.0F];
      }
    }
  }
  EXPECT_GT(rules[1.0F], 1000);
  EXPECT_GT(rules[2.0F], 1000);
}

TEST(Floor, of_one_void_post_is_the_highest_of_its_eight_by_eight) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 301, 301}, [](int column, int row) {
    return column == 100 && row == 100 ? unknown : static_cast<float>(column + row);
  });
  ground.finish();
  const Region region = floored(ground.source(), {90, 90, 20, 20});
  EXPECT_NEAR(static_cast<double>(floor_at(region, 100, 100)), 103 + 103, 0.01);
}

TEST(Floor, far_from_all_posts_is_that_of_the_session) {
  Ground ground(lattice_3s());
  ground.add({0, 0, 1, 1, 61, 61}, [](int, int) { return 250.0F; });
  ground.finish();
  const Region region = floored(ground.source(), {-400, -400, 400, 400});
  EXPECT_NEAR(static_cast<double>(floor_at(region, -400, -400)), 123, 0.01);
  EXPECT_NEAR(static_cast<double>(floor_at(region, -1, -1)), 250, 0.01);
  EXPECT_NEAR(static_cast<double>(floor_at(region, -128, -1)), 250, 0.01);
  EXPECT_NEAR(static_cast<double>(floor_at(region, -129, -1)), 123, 0.01);
}

TEST(Floor, is_the_same_whichever_block_or_level_asks) {
  const Ground ground = holey(52);
  for (const int level : {0, 1, 2}) {
    for (int k = 0; k < 6; ++k) {
      const BlockId id{level, (k % 3) * 2 - 1, k - 2};
      const Region own = floored(ground.source(), block_region(id));
      const Region other = floored(
          ground.source(), {own.box.column - 37, own.box.row + 11, own.box.columns, own.box.rows});
      for (int r = other.box.row; r < own.box.row + own.box.rows; ++r) {
        for (int c = own.box.column; c < other.box.column + other.box.columns; ++c) {
          ASSERT_EQ(own.at(c, r), other.at(c, r)) << level << ' ' << c << ' ' << r;
        }
      }
    }
  }
}

/// The contract's threshold at a cell for one alignment of its blocks of 64 x 64 cells: the lowest
/// known post of 3 x 3 of them; NaN where they hold none. `ratio`: lattice posts a cell.
float must_be_over(const Plain& plain, int column, int row, int ratio, int shift_x, int shift_y) {
  const int size = 64 * ratio;
  const int west = aligned(column - shift_x * ratio, size) + shift_x * ratio - size;
  const int south = aligned(row - shift_y * ratio, size) + shift_y * ratio - size;
  return plain.extreme(west, south, 3 * size + 1, 3 * size + 1, false);
}

/// The floor of every void post is at or over the contract's threshold, for random alignments.
void expect_over_threshold(const Ground& ground, int ratio, int seed) {
  const Plain plain(ground.source());
  const PostBox box{-100, -100, 800, 800};
  const Region region = floored(ground.source(), box);
  std::mt19937 random(static_cast<unsigned>(seed));
  int checked = 0, below = 0;
  double worst_m = 0;
  for (int k = 0; k < 3000 && checked < 400; ++k) {
    const int column = box.column + static_cast<int>(random() % 800U);
    const int row = box.row + static_cast<int>(random() % 800U);
    if (!std::isnan(plain.all.at(column, row))) continue;
    const float threshold =
        must_be_over(plain, column, row, ratio, static_cast<int>(random() % 64U),
                     static_cast<int>(random() % 64U));
    if (std::isnan(threshold)) continue;
    ++checked;
    const float floor = floor_at(region, column, row);
    EXPECT_LE(floor, 9000.0F);
    if (floor < threshold - 0.01F) {
      ++below;
      worst_m = std::max(worst_m, static_cast<double>(threshold - floor));
    }
  }
  EXPECT_GT(checked, 100);
  EXPECT_EQ(below, 0) << "of " << checked << " void posts, by up to " << worst_m << " m";
}

TEST(Floor, is_never_under_the_lowest_post_of_the_contracts_blocks_in_any_alignment) {
  expect_over_threshold(holey(54), 1, 9);
}

// 2026-11-23: blocks of 64 x 64 cells of a tile coarser than the lattice reach farther than 5 x 5
// squares of 64 lattice posts; the far floor stood under the mountains round a large void.
TEST(Floor, is_never_under_it_where_the_tile_is_coarser_than_the_lattice) {
  Ground ground(lattice_1s());
  ground.add({-300, -300, 3, 3, 401, 401}, [](int column, int row) {
    const bool lake = column > 0 && column < 700 && row > 0 && row < 700;
    return lake ? unknown : 2000.0F;
  });
  ground.finish();
  expect_over_threshold(ground, 3, 10);
}

TerrainFolder folder_of(const TemporaryFolder& files) {
  auto folder = TerrainFolder::open(files.path());
  EXPECT_TRUE(folder);
  return std::move(folder).value();
}

TEST(FarFloor, is_100_m_over_the_lowest_sample_near_a_place) {
  const TemporaryFolder files;
  write_hgt(files.file("N46E008.hgt"), 1201, [](int row, int) { return 500 + row; });
  write_hgt(files.file("N40E008.hgt"), 1201, [](int, int) { return 30; });
  TerrainFolder folder = folder_of(files);
  EXPECT_EQ(far_floor_m(folder, {46.2, 8.2, 46.8, 8.8}), 600);
  EXPECT_EQ(far_floor_m(folder, {10, 8, 11, 9}), 130);  // no tile near: of all tiles
}

// 2026-11-23: posts between the samples did not count, so that the floor could be lower than all.
TEST(FarFloor, is_not_under_the_lowest_post_of_a_tile_with_few_known_posts) {
  const TemporaryFolder files;
  write_hgt(files.file("N46E008.hgt"), 1201, [](int row, int column) {
    const bool known = row > 601 && row < 635 && column > 602 && column < 634;
    return known ? std::optional<int>(3000) : std::nullopt;
  });
  TerrainFolder folder = folder_of(files);
  const double floor = far_floor_m(folder, {46, 8, 47, 9});
  EXPECT_GE(floor, 3000);
  EXPECT_LE(floor, 9000);
}

// 2026-11-23: ground over 9000 m may not be shown as unknown.
TEST(FarFloor, is_not_over_9000_m) {
  const TemporaryFolder files;
  write_hgt(files.file("N46E008.hgt"), 1201, [](int, int) { return 8950; });
  TerrainFolder folder = folder_of(files);
  EXPECT_LE(far_floor_m(folder, {46, 8, 47, 9}), 9000);
}

}  // namespace
}  // namespace ridgeline::test
