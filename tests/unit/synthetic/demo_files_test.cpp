#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/output/image_file.hpp"
#include "tests/unit/synthetic/demo_fixture.hpp"

namespace ridgeline::test {
namespace {

constexpr int last_post = 2 * (Demo::posts - 1);
constexpr int unknown = -32768;

TEST(DemoFiles, are_the_committed_bytes) {
  // Changed numbers here mean that every picture of the demo changes: say so in the commit.
  const Demo& demo = Demo::instance();
  constexpr std::array<std::uint32_t, 4> tile_crcs = {0x4C38E692U, 0x2B6CC4AFU, 0xD87F35C3U,
                                                      0xDFD5BC77U};
  for (std::size_t tile = 0; tile < 4; ++tile) {
    EXPECT_EQ(sim::crc32_of(demo.tile_bytes(tile)), tile_crcs[tile])
        << std::hex << Demo::tiles[tile];
  }
  EXPECT_EQ(sim::crc32_of(bytes_of(demo.file("demo.log"))), 0x6AF457B6U) << std::hex;
}

TEST(DemoFiles, come_out_alike_twice) {
  const ScratchFolder second("demo_second");
  ASSERT_TRUE(sim::make_demo(second.path()).ok());
  for (const char* name : {"S49W124.hgt", "S48W123.hgt", "demo.log", "README.txt"}) {
    EXPECT_EQ(bytes_of(second.file(name)), bytes_of(Demo::instance().file(name))) << name;
  }
}

TEST(DemoFiles, say_that_they_are_synthetic) {
  const std::vector<unsigned char> readme = bytes_of(Demo::instance().file("README.txt"));
  EXPECT_NE(std::string(readme.begin(), readme.end()).find("SYNTHETIC"), std::string::npos);
  EXPECT_EQ(Demo::instance().log().rfind(
                "# ridgeline: SYNTHETIC terrain and flight, not a real place\n", 0),
            0U);
}

TEST(DemoFiles, tiles_share_their_edges) {
  const Demo& demo = Demo::instance();
  for (int k = 0; k < Demo::posts; ++k) {
    for (const std::size_t south : {0U, 2U}) {
      ASSERT_EQ(demo.tile_post(south, k, Demo::posts - 1), demo.tile_post(south + 1, k, 0));
    }
    for (const std::size_t west : {0U, 1U}) {
      ASSERT_EQ(demo.tile_post(west, Demo::posts - 1, k), demo.tile_post(west + 2, 0, k));
    }
  }
}

TEST(DemoFiles, unwritable_folder_is_a_fault_that_names_it) {
  const ScratchFolder folder("demo_fault");
  ASSERT_TRUE(std::ofstream(folder.file("plain")).good());
  const sim::Outcome outcome = sim::make_demo(folder.file("plain"));
  EXPECT_EQ(outcome.fault, Fault::file_unwritable);
  EXPECT_NE(outcome.message.find("plain"), std::string::npos);
}

TEST(DemoRelief, has_sea_lowland_and_high_mountains_in_believable_shares) {
  int highest_m = 0;
  int sea = 0;
  int high = 0;
  int below_zero = 0;
  for (int row = 0; row <= last_post; ++row) {
    for (int column = 0; column <= last_post; ++column) {
      const int height_m = Demo::instance().post(row, column);
      if (height_m == unknown) continue;
      highest_m = std::max(highest_m, height_m);
      sea += height_m == 0 ? 1 : 0;
      high += height_m > 1500 ? 1 : 0;
      below_zero += height_m < 0 ? 1 : 0;
    }
  }
  constexpr double posts = (last_post + 1.0) * (last_post + 1.0);
  EXPECT_GT(highest_m, 3300);
  EXPECT_LT(highest_m, 3700);
  EXPECT_GT(sea / posts, 0.2);
  EXPECT_LT(sea / posts, 0.6);
  EXPECT_GT(high / posts, 0.05);
  EXPECT_LT(high / posts, 0.3);
  EXPECT_EQ(below_zero, 0);
}

TEST(DemoRelief, drains_like_a_landscape_and_not_like_noise) {
  // In noise every ninth post or so is a pit; water that has cut its way out leaves hardly any.
  int land = 0;
  int pits = 0;
  for (int row = 1; row < last_post; ++row) {
    for (int column = 1; column < last_post; ++column) {
      const int here = Demo::instance().post(row, column);
      if (here <= 0) continue;
      ++land;
      bool lowest = true;
      for (int r = row - 1; r <= row + 1 && lowest; ++r) {
        for (int c = column - 1; c <= column + 1 && lowest; ++c) {
          if ((r != row || c != column) && Demo::instance().post(r, c) <= here) lowest = false;
        }
      }
      pits += lowest ? 1 : 0;
    }
  }
  RecordProperty("pits_per_thousand", std::to_string(1000.0 * pits / land));
  EXPECT_LT(static_cast<double>(pits) / land, 0.01);
}

TEST(DemoRelief, slopes_are_those_of_rock) {
  std::vector<double> slopes;
  for (int row = 1; row < last_post; row += 3) {
    for (int column = 1; column < last_post; column += 3) {
      const Demo& demo = Demo::instance();
      const std::array<int, 4> around = {demo.post(row, column - 1), demo.post(row, column + 1),
                                         demo.post(row - 1, column), demo.post(row + 1, column)};
      if (*std::min_element(around.begin(), around.end()) <= 0) continue;
      const double east = (around[1] - around[0]) / (2 * 62.0);
      const double north = (around[3] - around[2]) / (2 * 92.7);
      slopes.push_back(std::sqrt(east * east + north * north));
    }
  }
  std::sort(slopes.begin(), slopes.end());
  ASSERT_GT(slopes.size(), 10'000U);
  EXPECT_GT(slopes[slopes.size() / 2], 0.15);
  EXPECT_LT(slopes[slopes.size() / 2], 0.8);
  EXPECT_LT(slopes[slopes.size() * 999 / 1000], 2.0);
}

TEST(DemoRelief, has_one_small_patch_without_data) {
  int count = 0;
  int first_row = last_post;
  int last_row = 0;
  int first_column = last_post;
  int last_column = 0;
  for (int row = 0; row <= last_post; ++row) {
    for (int column = 0; column <= last_post; ++column) {
      if (Demo::instance().post(row, column) != unknown) continue;
      ++count;
      first_row = std::min(first_row, row);
      last_row = std::max(last_row, row);
      first_column = std::min(first_column, column);
      last_column = std::max(last_column, column);
    }
  }
  EXPECT_GT(count, 40);
  EXPECT_LT(count, 400);
  EXPECT_LT(last_row - first_row, 20);
  EXPECT_LT(last_column - first_column, 30);
}

}  // namespace
}  // namespace ridgeline::test
