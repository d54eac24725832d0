#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

#include "platform/display/duration_histogram.hpp"
#include "platform/latest_value.hpp"
#include "platform/spsc_ring.hpp"

namespace ridgeline {
namespace {

/// Large enough that a torn copy is seen: every word has the same number.
struct Block {
  std::array<std::uint64_t, 256> words{};
};

Block block_of(std::uint64_t number) {
  Block block;
  block.words.fill(number);
  return block;
}

bool whole(const Block& block) {
  for (const std::uint64_t word : block.words) {
    if (word != block.words[0]) return false;
  }
  return true;
}

TEST(LatestValue, the_newest_value_is_read_once_as_new) {
  LatestValue<int> value;
  int read = -1;
  EXPECT_FALSE(value.read(read));
  EXPECT_EQ(read, 0);
  value.write(1);
  value.write(2);
  EXPECT_TRUE(value.read(read));
  EXPECT_EQ(read, 2);
  EXPECT_FALSE(value.read(read));
  EXPECT_EQ(read, 2);
  value.write(3);
  EXPECT_TRUE(value.read(read));
  EXPECT_EQ(read, 3);
}

TEST(LatestValue, a_reader_beside_a_writer_sees_whole_values_in_order) {
  constexpr std::uint64_t last = 20'000;
  LatestValue<Block> value;
  std::thread writer([&] {
    for (std::uint64_t number = 1; number <= last; ++number) value.write(block_of(number));
  });
  std::uint64_t before = 0;
  while (before < last) {
    Block read;
    const bool is_new = value.read(read);
    const std::uint64_t now = read.words[0];
    const bool in_order = is_new ? now > before : now == before;
    if (!whole(read) || !in_order) {
      ADD_FAILURE() << "after " << before << " came " << now;
      break;
    }
    before = now;
  }
  writer.join();
}

TEST(SpscRing, what_does_not_fit_is_refused_and_counted) {
  SpscRing<int, 4> ring;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(ring.push(i), i < 4);
  EXPECT_EQ(ring.refused_count(), 2u);
  int item = -1;
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(ring.pop(item));
    EXPECT_EQ(item, i);
  }
  EXPECT_FALSE(ring.pop(item));
  EXPECT_TRUE(ring.push(7));
  EXPECT_TRUE(ring.pop(item));
  EXPECT_EQ(item, 7);
}

TEST(SpscRing, a_reader_beside_a_writer_gets_every_item_that_was_taken_in) {
  constexpr std::uint64_t count = 20'000;
  SpscRing<Block, 8> ring;
  std::uint64_t taken_in = 0;
  std::thread writer([&] {
    for (std::uint64_t number = 1; number <= count; ++number) {
      if (ring.push(block_of(number))) ++taken_in;
    }
    while (!ring.push(block_of(count + 1))) std::this_thread::yield();
  });
  std::uint64_t got = 0, before = 0;
  Block block;
  while (before <= count) {
    if (!ring.pop(block)) {
      std::this_thread::yield();
      continue;
    }
    if (!whole(block) || block.words[0] <= before) {
      ADD_FAILURE() << "after " << before << " came " << block.words[0];
      break;
    }
    before = block.words[0];
    ++got;
  }
  writer.join();
  EXPECT_EQ(got, taken_in + 1);  // and the last one, which was tried until it fitted
  EXPECT_GE(ring.refused_count(), count - taken_in);
}

TEST(DurationHistogram, quantiles_are_upper_edges_and_never_above_the_largest) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
  for (int i = 1; i <= 100; ++i) histogram.add(i * 1'000'000 - 1);
  EXPECT_EQ(histogram.count(), 100u);
  EXPECT_EQ(histogram.quantile_ns(0.5), 50'000'000);
  EXPECT_EQ(histogram.quantile_ns(0.99), 99'000'000);
  EXPECT_EQ(histogram.quantile_ns(1.0), 99'999'999);
  EXPECT_EQ(histogram.largest_ns(), 99'999'999);
}

TEST(DurationHistogram, what_is_longer_than_its_scale_counts_as_the_largest) {
  DurationHistogram histogram;
  histogram.add(5'000'000'000);
  histogram.add(-1);
  EXPECT_EQ(histogram.quantile_ns(1.0), 5'000'000'000);
  EXPECT_LE(histogram.quantile_ns(0.5), DurationHistogram::step_ns);
}

}  // namespace
}  // namespace ridgeline
