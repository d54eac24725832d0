// The thread that builds blocks: order, arrival, repeatability, refused tiles, its end.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "platform/block_worker.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"
#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

constexpr int most = limits::blocks_in_flight;

/// Two 3" tiles far apart, and a worker over them.
class Worker : public testing::Test {
 protected:
  Worker() {
    write_hgt(files_.file("N46E008.hgt"), 1201,
              [](int row, int column) { return height(row, column, 0); });
    write_hgt(files_.file("N46E020.hgt"), 1201,
              [](int row, int column) { return height(row, column, 1000); });
  }

  static int height(int row, int column, int more) {
    return more + static_cast<int>(300 * lottery(column, row, 90)) + row / 4;
  }

  void open() {
    auto folder = TerrainFolder::open(files_.path());
    ASSERT_TRUE(folder);
    folder_.emplace(std::move(folder).value());
    settings_.lattice = lattice_3s();
    settings_.levels = 3;
  }
  void start(BlockWorker::Arrival arrival, int delay_us) {
    settings_.arrival = arrival;
    settings_.delay_us = delay_us;
    worker_.reset();
    worker_ = std::make_unique<BlockWorker>(*folder_, settings_);
  }
  /// Blocks over the first tile.
  static BlockId id(int k) { return {k % 3, k % 7 + 1, k % 5 + 1}; }
  /// The next block, however long it takes; null only where nothing was ordered.
  const TerrainBlock* wait_for_block() {
    for (int k = 0; k < 30'000; ++k) {
      if (const TerrainBlock* block = worker_->take()) return block;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return nullptr;
  }

  TemporaryFolder files_;
  std::optional<TerrainFolder> folder_;
  BlockWorker::Settings settings_;
  std::unique_ptr<BlockWorker> worker_;
  static constexpr GeoBox first_{45.5, 7.5, 47.5, 9.5}, second_{45.5, 19.5, 47.5, 21.5};
};

void expect_same(const TerrainBlock& a, const TerrainBlock& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.edits, b.edits);
  EXPECT_EQ(a.posts, b.posts);
  EXPECT_EQ(a.highest, b.highest);
  EXPECT_EQ(a.facts.part_residual_m, b.facts.part_residual_m);
  EXPECT_EQ(a.facts.known_posts, b.facts.known_posts);
  EXPECT_EQ(a.facts.steepness, b.facts.steepness);
  EXPECT_EQ(a.facts.centre.xyz, b.facts.centre.xyz);
}

TEST_F(Worker, gives_the_same_bits_in_the_same_order_however_slow_it_is) {
  open();
  std::vector<TerrainBlock> fast;
  for (const int delay_us : {0, 3000}) {
    for (const auto arrival : {BlockWorker::Arrival::in_step, BlockWorker::Arrival::as_ready}) {
      start(arrival, delay_us);
      worker_->focus(first_);
      for (int k = 0; k < 30; ++k) worker_->order({id(k), 0});
      for (int k = 0; k < 30; ++k) {
        const TerrainBlock* block = wait_for_block();
        ASSERT_NE(block, nullptr);
        EXPECT_EQ(block->id, id(k)) << k;
        if (fast.size() < 30) fast.push_back(*block);
        expect_same(*block, fast[static_cast<std::size_t>(k)]);
      }
      EXPECT_EQ(worker_->take(), nullptr);
    }
  }
  const TerrainSource source{settings_.lattice, folder_->tiles(), {}, {}};
  for (int k = 0; k < 30; ++k)
    expect_same(fast[static_cast<std::size_t>(k)], block_of(source, id(k)));
}

TEST_F(Worker, waits_for_its_blocks_in_step_only) {
  open();
  start(BlockWorker::Arrival::in_step, 100'000);
  EXPECT_EQ(worker_->take(), nullptr);  // nothing ordered, nothing to wait for
  worker_->focus(first_);
  worker_->order({id(0), 0});
  ASSERT_NE(worker_->take(), nullptr);
  EXPECT_EQ(worker_->take(), nullptr);
  start(BlockWorker::Arrival::as_ready, 300'000);
  worker_->focus(first_);
  worker_->order({id(0), 0});
  EXPECT_EQ(worker_->take(), nullptr);
  ASSERT_NE(wait_for_block(), nullptr);
}

TEST_F(Worker, has_room_for_as_many_orders_as_may_be_in_flight) {
  open();
  start(BlockWorker::Arrival::in_step, 0);
  worker_->focus(first_);
  EXPECT_EQ(worker_->room(), most);
  for (int k = 0; k < most; ++k) {
    worker_->order({id(k), 0});
    EXPECT_EQ(worker_->room(), most - 1 - k);
  }
  for (int k = 0; k < most; ++k) {
    ASSERT_NE(worker_->take(), nullptr);
    EXPECT_EQ(worker_->room(), k + 1);
  }
}

TEST_F(Worker, leaves_the_block_last_taken_alone_while_it_builds_all_others) {
  open();
  start(BlockWorker::Arrival::in_step, 0);
  worker_->focus(first_);
  int ordered = 0;
  for (int round = 0; round < 200; ++round) {
    while (worker_->room() > 0) worker_->order({id(ordered++), 0});
    const TerrainBlock* block = worker_->take();
    ASSERT_NE(block, nullptr);
    ASSERT_EQ(block->id, id(round));
    if (round % 40 != 0) continue;
    const TerrainBlock copy = *block;
    while (worker_->room() > 0) worker_->order({id(ordered++), 0});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    expect_same(copy, *block);
  }
}

TEST_F(Worker, builds_at_once_beside_what_is_ordered) {
  open();
  start(BlockWorker::Arrival::in_step, 500);
  worker_->focus(first_);
  for (int k = 0; k < 20; ++k) worker_->order({id(k), 0});
  const TerrainBlock* now = worker_->build({id(33), 0});
  ASSERT_NE(now, nullptr);
  const TerrainBlock copy = *now;
  for (int k = 0; k < 20; ++k) {
    const TerrainBlock* block = worker_->take();
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->id, id(k));
  }
  expect_same(copy, block_of({settings_.lattice, folder_->tiles(), {}, {}}, id(33)));
}

TEST_F(Worker, puts_as_many_edits_into_a_block_as_its_order_says) {
  open();
  const std::vector<float> peak{7000}, hole{unknown};
  const PostGrid post{46 + 100 / 1200.0, 8 + 100 / 1200.0, 1 / 1200.0, 1 / 1200.0, 1, 1};
  const std::vector<TerrainEdit> edits{{post, peak}, {post, hole}};
  start(BlockWorker::Arrival::in_step, 0);
  worker_->know_edits(edits);
  worker_->focus(first_);
  for (int k = 0; k < 3; ++k) worker_->order({{0, 1, 1}, k});
  float heights[3] = {};
  for (int k = 0; k < 3; ++k) {
    const TerrainBlock* block = worker_->take();
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->edits, k);
    heights[k] = block->posts[36 * 64 + 36];
  }
  EXPECT_EQ(heights[0], static_cast<float>(height(100, 100, 0)));
  EXPECT_EQ(heights[1], 7000);
  EXPECT_LT(heights[2], void_threshold_m);
}

TEST_F(Worker, reads_the_tiles_its_focus_moves_to) {
  open();
  start(BlockWorker::Arrival::in_step, 0);
  const BlockId far{0, 12 * 1200 / 64 + 2, 3};
  for (int k = 0; k < 4; ++k) {
    worker_->focus(k % 2 == 0 ? first_ : second_);
    worker_->order({k % 2 == 0 ? id(0) : far, 0});
    const TerrainBlock* block = worker_->take();
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->facts.known_posts, 64 * 64) << k;
    EXPECT_EQ(block->facts.lowest_m >= 1000, k % 2 == 1);
  }
}

// 2026-11-23: one wrong position moved the focus away and back; blocks ordered before were built
// without their tiles, arrived unknown, and stayed in the window.
TEST_F(Worker, builds_a_block_from_the_tiles_that_were_in_focus_when_it_was_ordered) {
  open();
  start(BlockWorker::Arrival::as_ready, 20'000);
  worker_->focus(first_);
  worker_->order({id(0), 0});
  worker_->order({id(1), 0});
  worker_->focus(second_);
  for (int k = 0; k < 2; ++k) {
    const TerrainBlock* block = wait_for_block();
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->facts.known_posts, 64 * 64) << k;
  }
}

TEST_F(Worker, tells_once_of_a_tile_found_corrupt_on_the_way_and_leaves_it_unknown) {
  auto bytes = dted_bytes(1, 46, 10, [](int, int) { return 900; });
  bytes[bytes.size() - 1] ^= std::byte{1};  // the checksum of the last record
  write_bytes(files_.file("n46_e010.dt1"), bytes);
  open();
  start(BlockWorker::Arrival::in_step, 0);
  worker_->focus(first_);
  worker_->order({id(0), 0});
  ASSERT_NE(worker_->take(), nullptr);
  EXPECT_EQ(worker_->refused_count(), 0);
  EXPECT_TRUE(worker_->new_problems().empty());
  worker_->focus({46.2, 9.2, 46.8, 10.8});
  const BlockId there{0, 2 * 1200 / 64 + 2, 3};
  for (int k = 0; k < 3; ++k) {
    worker_->order({there, 0});
    const TerrainBlock* block = worker_->take();
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->facts.known_posts, 0);
    EXPECT_EQ(worker_->refused_count(), 1);
    const std::vector<std::string> problems = worker_->new_problems();
    EXPECT_EQ(problems.size(), k == 0 ? 1U : 0U);
    if (k == 0) {
      EXPECT_NE(problems.at(0).find("n46_e010.dt1"), std::string::npos) << problems[0];
    }
  }
}

TEST_F(Worker, ends_with_orders_pending_taken_or_not) {
  open();
  for (int k = 0; k < 30; ++k) {
    start(k % 2 == 0 ? BlockWorker::Arrival::in_step : BlockWorker::Arrival::as_ready,
          k % 3 == 0 ? 2000 : 0);
    worker_->focus(first_);
    for (int n = 0; n < (k * 7) % (most + 1); ++n) worker_->order({id(n), 0});
    if (k % 4 == 0) static_cast<void>(worker_->take());
    worker_.reset();
  }
}

TEST_F(Worker, adds_up_its_buffers) {
  open();
  start(BlockWorker::Arrival::in_step, 0);
  const auto side = static_cast<std::size_t>(region_side(2));
  EXPECT_GE(worker_->buffer_bytes(), 4 * side * side + (most + 1) * sizeof(TerrainBlock));
  EXPECT_LE(worker_->buffer_bytes(), 4 * side * side + (most + 3) * sizeof(TerrainBlock));
  EXPECT_EQ(worker_->mapped_bytes(), 0U);
  worker_->focus(first_);
  worker_->order({id(0), 0});
  ASSERT_NE(worker_->take(), nullptr);
  EXPECT_EQ(worker_->mapped_bytes(), std::size_t{1201 * 1201 * 2});
}

}  // namespace
}  // namespace ridgeline::test
