// Which blocks the window holds and wants, over random flights with blocks that arrive late.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "core/terrain/terrain_levels.hpp"

namespace ridgeline {
namespace {

using Key = std::array<int, 3>;

Key key(const BlockId& id) {
  return {id.level, id.column, id.row};
}

bool inside(const PostRect& a, const PostRect& b) {
  return a.empty() ||
         (a.west >= b.west && a.south >= b.south && a.east <= b.east && a.north <= b.north);
}

/// A window, the blocks on their way to it, and what must be true of it at any time.
class Flight {
 public:
  explicit Flight(const LevelSizes& sizes)
      : memory_(static_cast<std::size_t>(sizes.levels * sizes.blocks())), levels(sizes, memory_) {}

  void follow(double column, double row) {
    column_ = column;
    row_ = row;
    levels.follow(column, row);
    for (auto it = waiting_.begin(); it != waiting_.end();) {
      it = wanted_here(*it) ? std::next(it) : waiting_.erase(it);
    }
  }

  /// Orders up to `count` blocks; how many were wanted.
  int order(int count) {
    std::vector<BlockId> ids(static_cast<std::size_t>(count));
    const int wanted = levels.next_wanted(ids);
    EXPECT_LE(wanted, count);
    for (int k = 0; k < wanted; ++k) {
      const BlockId& id = ids[static_cast<std::size_t>(k)];
      EXPECT_TRUE(wanted_here(key(id))) << id.level << ' ' << id.column << ' ' << id.row;
      EXPECT_EQ(levels.find(id), nullptr) << "held already";
      EXPECT_TRUE(waiting_.insert(key(id)).second) << "ordered twice";
      on_its_way_.push_back(id);
    }
    return wanted;
  }

  void arrive(int count) {
    for (; count > 0 && !on_its_way_.empty(); --count) {
      block_->id = on_its_way_.front();
      on_its_way_.pop_front();
      block_->facts.highest_m = static_cast<float>(block_->id.column * 31 + block_->id.row);
      const bool held = levels.accept(*block_);
      EXPECT_EQ(held, wanted_here(key(block_->id)));
      EXPECT_EQ(levels.find(block_->id) != nullptr, held);
      waiting_.erase(key(block_->id));
    }
  }

  void lose_first() {
    if (on_its_way_.empty()) return;
    levels.release(on_its_way_.front());
    waiting_.erase(key(on_its_way_.front()));
    on_its_way_.pop_front();
  }

  void check() const {
    for (int l = 0; l < levels.sizes().levels; ++l) {
      check_valid(l);
      const PostRect drawn = levels.drawable(l);
      EXPECT_TRUE(inside(drawn, levels.target(l)));
      if (l + 1 < levels.sizes().levels) {
        EXPECT_TRUE(inside(drawn, levels.drawable(l + 1))) << l;
      }
    }
  }

  [[nodiscard]] bool eye_drawn(int level) const {
    const PostRect r = levels.drawable(level);
    return column_ >= r.west && column_ < r.east && row_ >= r.south && row_ < r.north;
  }

 private:
  [[nodiscard]] bool wanted_here(const Key& id) const {
    const PostRect t = levels.target(id[0]);
    const int span = block_posts << id[0];
    return id[1] * span >= t.west && (id[1] + 1) * span <= t.east && id[2] * span >= t.south &&
           (id[2] + 1) * span <= t.north;
  }

  /// The valid part is a full rectangle of blocks that are held and were told to be these.
  void check_valid(int level) const {
    std::set<Key> ids;
    std::set<std::pair<int, int>> slots;
    int west = 1 << 30, east = -west, south = west, north = -west;
    levels.over_valid(level, [&](const HeldBlock& block) {
      EXPECT_TRUE(block.held);
      EXPECT_EQ(block.id.level, level);
      EXPECT_EQ(block.facts.highest_m, static_cast<float>(block.id.column * 31 + block.id.row));
      EXPECT_TRUE(wanted_here(key(block.id)));
      EXPECT_EQ(levels.find(block.id), &block);
      ids.insert(key(block.id));
      const BlockSlot slot = levels.slot(block.id);
      EXPECT_TRUE(slots.insert({slot.column, slot.row}).second) << "two blocks in one place";
      west = std::min(west, block.id.column);
      east = std::max(east, block.id.column);
      south = std::min(south, block.id.row);
      north = std::max(north, block.id.row);
    });
    const PostRect drawn = levels.drawable(level);
    if (ids.empty()) {
      EXPECT_TRUE(drawn.empty());
      return;
    }
    EXPECT_EQ(ids.size(), static_cast<std::size_t>((east - west + 1) * (north - south + 1)));
    const double span = block_posts << level;
    EXPECT_TRUE(column_ >= west * span && column_ <= (east + 1) * span);
    EXPECT_TRUE(row_ >= south * span && row_ <= (north + 1) * span);
    const int whole = block_posts << level;
    EXPECT_TRUE(
        inside(drawn, {west * whole, south * whole, (east + 1) * whole, (north + 1) * whole}));
  }

  std::vector<HeldBlock> memory_;
  std::deque<BlockId> on_its_way_;
  std::set<Key> waiting_;  ///< ordered, and in the window ever since
  std::unique_ptr<TerrainBlock> block_ = std::make_unique<TerrainBlock>();
  double column_ = 0, row_ = 0;

 public:
  TerrainLevels levels;
};

int settle(Flight& flight) {
  int turns = 0;
  while (!flight.levels.complete() && turns < 2000) {
    flight.arrive(64);
    flight.order(64);
    ++turns;
  }
  return turns;
}

TEST(Levels, keep_their_promises_on_random_flights_with_late_blocks) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const auto share = [&] { return static_cast<double>(random()) * 0x1p-32; };
    const LevelSizes sizes{1 + static_cast<int>(seed % 5U), 4 + 2 * static_cast<int>(seed % 3U),
                           4 + 2 * static_cast<int>(seed % 2U)};
    Flight flight(sizes);
    double column = 1e5 * (share() - 0.5), row = 1e5 * (share() - 0.5), heading = 0;
    for (int k = 0; k < 1500; ++k) {
      heading += 0.3 * (share() - 0.5);
      const double speed = 40.0 * static_cast<double>(1 + seed % 4U);
      column += speed * std::sin(heading);
      row += speed * std::cos(heading);
      const double event = share();
      if (event < 0.004) column += 1e6 * (share() - 0.5), row += 1e5 * (share() - 0.5);
      if (event > 0.99) heading += 3.14;
      flight.follow(column, row);
      flight.arrive(static_cast<int>(random() % 9U));
      if (event > 0.97) flight.lose_first();
      flight.order(static_cast<int>(random() % 12U));
      flight.check();
      if (testing::Test::HasFailure()) FAIL() << "seed " << seed << " step " << k;
    }
    EXPECT_LT(settle(flight), 2000) << seed;
    flight.check();
    for (int l = 0; l < sizes.levels; ++l) EXPECT_TRUE(flight.eye_drawn(l)) << seed << ' ' << l;
    EXPECT_EQ(flight.order(64), 0) << "complete, and still wants";
  }
}

TEST(Levels, a_jump_there_and_back_with_nothing_arriving_ends_complete) {
  Flight flight({3, 4, 4});
  flight.follow(100, 100);
  settle(flight);
  for (int k = 0; k < 20; ++k) {
    flight.follow(100 + (k % 2) * 137'000.0, 100 - (k % 2) * 51'000.0);
    flight.order(10);
    if (k % 3 == 0) flight.arrive(7);
    flight.check();
  }
  EXPECT_LT(settle(flight), 100);
  flight.check();
}

TEST(Levels, an_eye_at_rest_or_going_round_within_a_block_orders_nothing_new) {
  Flight flight({4, 6, 6});
  flight.follow(32, 32);
  settle(flight);
  for (int k = 0; k < 200; ++k) {
    flight.follow(32 + 10 * std::sin(k), 32 + 10 * std::cos(k));
    EXPECT_TRUE(flight.levels.complete());
    EXPECT_EQ(flight.order(64), 0);
  }
}

TEST(Levels, an_eye_swinging_over_a_border_of_blocks_orders_no_block_again) {
  Flight flight({4, 6, 6});
  int ordered = 0;
  for (int k = 0; k < 400; ++k) {
    flight.follow(2048 + 20 * std::sin(0.7 * k), -4096 + 20 * std::cos(0.3 * k));
    flight.arrive(64);
    ordered += flight.order(64);
  }
  EXPECT_LE(ordered, 4 * 36 + 4 * 12);
}

TEST(Levels, a_released_block_is_wanted_again) {
  Flight flight({1, 4, 4});
  flight.follow(0, 0);
  EXPECT_EQ(flight.order(16), 16);
  EXPECT_EQ(flight.order(16), 0);
  flight.lose_first();
  EXPECT_EQ(flight.order(16), 1);
  flight.arrive(16);
  EXPECT_TRUE(flight.levels.complete());
}

TEST(Levels, the_first_blocks_are_those_below_the_eye_coarsest_first) {
  Flight flight({3, 6, 6});
  flight.follow(1000.5, -2000.5);
  std::array<BlockId, 3> ids;
  ASSERT_EQ(flight.levels.next_wanted(ids), 3);
  for (int k = 0; k < 3; ++k) {
    const int level = 2 - k, span = 64 << level;
    const BlockId& id = ids[static_cast<std::size_t>(k)];
    EXPECT_EQ(id, (BlockId{level, static_cast<int>(std::floor(1000.5 / span)),
                           static_cast<int>(std::floor(-2000.5 / span))}));
  }
}

TEST(Levels, cleared_they_hold_nothing) {
  Flight flight({2, 4, 4});
  flight.follow(10, 10);
  settle(flight);
  flight.levels.clear();
  EXPECT_FALSE(flight.levels.complete());
  EXPECT_TRUE(flight.levels.drawable(0).empty());
  int held = 0;
  flight.levels.over_held([&](const HeldBlock&) { ++held; });
  EXPECT_EQ(held, 0);
}

TEST(LevelSizes, a_complete_window_reaches_as_far_as_was_asked_wherever_the_eye_stands) {
  std::mt19937 random(20);
  for (int k = 0; k < 40; ++k) {
    const auto half_columns = static_cast<double>(100 + random() % 3000U);
    const auto half_rows = static_cast<double>(100 + random() % 3000U);
    const std::int64_t budget = 2'000'000 + static_cast<std::int64_t>(random() % 20'000'000U);
    const LevelSizes sizes = level_sizes(half_columns, half_rows, budget);
    EXPECT_LE(sizes.posts(), budget);
    EXPECT_LE(sizes.levels, max_levels);
    EXPECT_EQ(sizes.column_blocks % 2 + sizes.row_blocks % 2, 0);
    Flight flight(sizes);
    double column = 0, row = 0;
    for (int step = 0; step < 12; ++step) {
      column += static_cast<double>(random() % 4000U) - 1500;
      row += static_cast<double>(random() % 4000U) - 2500;
      flight.follow(column, row);
      settle(flight);
      const PostRect r = flight.levels.drawable(sizes.levels - 1);
      EXPECT_LE(r.west, column - half_columns);
      EXPECT_GE(r.east, column + half_columns);
      EXPECT_LE(r.south, row - half_rows);
      EXPECT_GE(r.north, row + half_rows);
    }
  }
}

TEST(LevelSizes, take_no_more_levels_than_they_need_and_use_the_budget) {
  EXPECT_EQ(level_sizes(1000, 1000, 1'000'000'000).levels, 1);
  const LevelSizes two = level_sizes(1000, 1000, 3'000'000);
  EXPECT_EQ(two.levels, 2);
  EXPECT_GT(two.posts(), 2'000'000);
  const LevelSizes wide = level_sizes(4000, 1000, 8'000'000);
  EXPECT_GT(wide.column_blocks, wide.row_blocks);
}

TEST(LevelSizes, stay_within_the_budget_where_the_range_does_not_fit) {
  for (const std::int64_t budget : {200'000, 2'000'000, 18'000'000}) {
    for (const double half : {50'000.0, 400'000.0}) {
      const LevelSizes sizes = level_sizes(half, half / 3, budget);
      EXPECT_EQ(sizes.levels, max_levels);
      EXPECT_LE(sizes.posts(), budget);
      EXPECT_GT(sizes.posts(), budget / 3);
      EXPECT_GE(std::min(sizes.column_blocks, sizes.row_blocks), 2);
    }
  }
}

}  // namespace
}  // namespace ridgeline
