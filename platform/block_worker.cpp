#include "platform/block_worker.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/assert.hpp"
#include "platform/heap_counter.hpp"

namespace ridgeline {
namespace {

constexpr int forget_after_blocks = 256;  ///< then the pages of raw tiles are let go

}  // namespace

BlockWorker::BlockWorker(TerrainFolder& folder, const Settings& settings)
    : folder_(folder), settings_(settings) {
  const auto side = static_cast<std::size_t>(region_side(settings.levels - 1));
  posts_.resize(side * side);
  rests_.resize(static_cast<std::size_t>(region_side(0)) * region_side(0));
  rows_.resize(static_cast<std::size_t>(row_scratch(settings.levels - 1)));
  if (settings.polar) {
    low_.resize(polar_cells(settings.levels - 1));
    high_.resize(polar_cells(settings.levels - 1));
  }
  jobs_.resize(slots);
  blocks_.resize(slots);
  thread_ = std::thread([this] { run(); });
}

BlockWorker::~BlockWorker() {
  {
    const std::lock_guard lock(queue_mutex_);
    stop_ = true;
  }
  work_.notify_all();
  thread_.join();
}

void BlockWorker::know_edits(std::span<const TerrainEdit> edits) {
  edits_ = edits;
}

int BlockWorker::room() {
  if (taking_) {
    const std::chrono::duration<double, std::milli> all = Clock::now() - take_start_;
    last_take_ = {all.count() - wait_ms_, wait_ms_};
    taking_ = false;
    taken_rounds_.push_back(in_round_);
    in_round_ = 0;
    ++round_;
  }
  const std::lock_guard lock(queue_mutex_);
  return static_cast<int>(slots - 1 - (ordered_ - taken_));
}

void BlockWorker::order(const BlockOrder& order) {
  {
    const std::lock_guard lock(queue_mutex_);
    RL_ASSERT(ordered_ - taken_ < slots - 1);
    jobs_[ordered_ % slots] = {order, focus_};
    ++ordered_;
  }
  work_.notify_one();
}

const TerrainBlock* BlockWorker::take() {
  if (!taking_) {
    taking_ = true;
    take_start_ = Clock::now();
    wait_ms_ = 0;
  }
  std::unique_lock lock(queue_mutex_);
  if (taken_ == ordered_) return nullptr;
  if (settings_.arrival == Arrival::as_recorded &&
      (round_ >= expected_rounds_.size() || in_round_ >= expected_rounds_[round_])) {
    return nullptr;
  }
  if (settings_.arrival != Arrival::as_ready && built_ == taken_) {
    const Clock::time_point before = Clock::now();
    done_.wait(lock, [this] { return built_ > taken_; });
    wait_ms_ += std::chrono::duration<double, std::milli>(Clock::now() - before).count();
  }
  if (built_ == taken_) return nullptr;
  ++in_round_;
  // The slot taken before this one is free from now on; this one stays the caller's.
  return &blocks_[taken_++ % slots];
}

BlockWorker::Rounds BlockWorker::taken_in_rounds() {
  const Rounds rounds = taken_rounds_;
  taken_rounds_.clear();
  return rounds;
}

void BlockWorker::expect(const Rounds& rounds) {
  expected_rounds_ = rounds;
  round_ = 0;
}

void BlockWorker::focus(const GeoBox& box) {
  const std::lock_guard lock(queue_mutex_);
  focus_ = box;
}

const TerrainBlock* BlockWorker::build(const BlockOrder& order) {
  Job job{order, {}};
  {
    const std::lock_guard lock(queue_mutex_);
    job.focus = focus_;
  }
  build_into(job, at_once_);
  return &at_once_;
}

void BlockWorker::build_into(const Job& job, TerrainBlock& block) {
  const std::lock_guard lock(folder_mutex_);
  if (!(job.focus == selected_)) folder_.select(job.focus);
  selected_ = job.focus;
  const BlockOrder& order = job.order;
  const TerrainSource source{lattice_in(order.chart, settings_.lattice), folder_.tiles(),
                             edits_.first(static_cast<std::size_t>(order.edits)), settings_.geoid};
  build_block(source, order.id, settings_.far_floor_m, {posts_, rows_, rests_, low_, high_}, block);
}

void BlockWorker::run() {
  int since_forgotten = 0;
  for (;;) {
    std::uint64_t slot = 0;
    Job job;
    {
      std::unique_lock lock(queue_mutex_);
      work_.wait(lock, [this] { return stop_ || built_ < ordered_; });
      if (stop_) return;
      slot = built_ % slots;
      job = jobs_[slot];
    }
    if (settings_.delay_us > 0) {
      std::this_thread::sleep_for(std::chrono::microseconds(settings_.delay_us));
    }
    {
      const HeapSection after_boot;
      build_into(job, blocks_[slot]);
    }
    bool idle = false;
    {
      const std::lock_guard lock(queue_mutex_);
      ++built_;
      idle = built_ == ordered_;
    }
    done_.notify_one();
    ++since_forgotten;
    if (idle && since_forgotten >= forget_after_blocks) {
      const std::lock_guard lock(folder_mutex_);
      folder_.forget_pages();
      since_forgotten = 0;
    }
  }
}

std::uint64_t BlockWorker::blocks_taken() const {
  const std::lock_guard lock(queue_mutex_);
  return taken_;
}

int BlockWorker::refused_count() const {
  const std::lock_guard lock(folder_mutex_);
  return static_cast<int>(folder_.refused().size());
}

std::vector<std::string> BlockWorker::new_problems() {
  const std::lock_guard lock(folder_mutex_);
  std::vector<std::string> messages;
  for (; problems_told_ < folder_.refused().size(); ++problems_told_) {
    messages.push_back(folder_.refused()[problems_told_].message);
  }
  return messages;
}

std::size_t BlockWorker::mapped_bytes() const {
  const std::lock_guard lock(folder_mutex_);
  return folder_.mapped_bytes();
}

std::size_t BlockWorker::buffer_bytes() const {
  return sizeof(float) *
             (posts_.size() + rows_.size() + rests_.size() + low_.size() + high_.size()) +
         blocks_.size() * sizeof(TerrainBlock) + jobs_.size() * sizeof(Job);
}

namespace {

constexpr double over_lowest_m = 100.0;
constexpr int samples = 16;  ///< a side of each tile

/// The lowest of a few posts of a tile; NaN when none of them is known.
double lowest_sample_m(const HeightTile& tile) {
  double lowest = std::nan("");
  float post = 0;
  for (int k = 0; k < samples * samples; ++k) {
    const int row = (tile.grid.rows - 1) * (k / samples) / (samples - 1);
    const int column = (tile.grid.columns - 1) * (k % samples) / (samples - 1);
    read_posts(tile, row, column, std::span(&post, 1));
    if (!std::isnan(post)) lowest = std::fmin(lowest, static_cast<double>(post));
  }
  return lowest;
}

/// The lowest post of a tile; NaN when none is known.
double lowest_post_of_m(const HeightTile& tile) {
  double lowest = std::nan("");
  std::vector<float> row(static_cast<std::size_t>(tile.grid.columns));
  for (int r = 0; r < tile.grid.rows; ++r) {
    read_posts(tile, r, 0, row);
    for (const float post : row) {
      if (!std::isnan(post)) lowest = std::fmin(lowest, static_cast<double>(post));
    }
  }
  return lowest;
}

}  // namespace

double far_floor_m(TerrainFolder& folder, const GeoBox& near) {
  const GeoBox everywhere{-90.0, -180.0, 90.0, 180.0};
  for (const GeoBox& box : {near, everywhere}) {
    folder.select(box);
    double lowest = std::nan("");
    for (const HeightTile& tile : folder.tiles()) lowest = std::fmin(lowest, lowest_sample_m(tile));
    if (std::isnan(lowest)) {  // a few posts between voids still count
      for (const HeightTile& tile : folder.tiles()) {
        lowest = std::fmin(lowest, lowest_post_of_m(tile));
      }
    }
    if (!std::isnan(lowest)) return std::min(lowest + over_lowest_m, limits::max_terrain_height_m);
  }
  return over_lowest_m;
}

}  // namespace ridgeline
