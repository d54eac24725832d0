#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "config/limits.hpp"
#include "core/base/fixed_vector.hpp"
#include "core/terrain/block_port.hpp"
#include "core/terrain/terrain_levels.hpp"
#include "platform/terrain_folder.hpp"

namespace ridgeline {

/// Reads raw tiles and builds the blocks of the terrain window on one background thread, in buffers
/// made once. Blocks come back in the order in which they were ordered.
class BlockWorker final : public BlockPort {
 public:
  enum class Arrival : std::uint8_t {
    in_step,      ///< take() waits for what was ordered: deterministic runs
    as_ready,     ///< take() never waits: live use
    as_recorded,  ///< take() hands out, and waits for, as many as expect() says
  };
  struct Settings {
    PostLattice lattice;
    int levels = 1;
    double far_floor_m = 0;
    GeoidLookup geoid;
    Arrival arrival = Arrival::in_step;
    bool polar = false;  ///< orders in polar charts may come: takes three times the posts
    int delay_us = 0;    ///< before every block; to show that late data changes nothing but time
  };

  /// Starts the thread. `folder` outlives the worker and is used by nobody else meanwhile.
  /// Cost: allocates all buffers: 26 KiB a block in flight, (68 * 2^(levels - 1))^2 posts, and
  ///       twice as many numbers again for polar charts.
  BlockWorker(TerrainFolder& folder, const Settings& settings);
  ~BlockWorker() override;
  BlockWorker(const BlockWorker&) = delete;
  BlockWorker& operator=(const BlockWorker&) = delete;

  /// Every edit the run will know; an order says how many of them count. Call before the first
  /// order.
  void know_edits(std::span<const TerrainEdit> edits);

  [[nodiscard]] int room() override;
  void order(const BlockOrder& order) override;
  const TerrainBlock* take() override;
  void focus(const GeoBox& box) override;
  const TerrainBlock* build(const BlockOrder& order) override;
  [[nodiscard]] int refused_count() const override;

  /// Rounds of take() that one frame may have: two where the chart changes.
  static constexpr std::size_t rounds_a_frame = 4;
  using Rounds = FixedVector<int, rounds_a_frame>;
  /// Blocks handed out in each round since the last call.
  Rounds taken_in_rounds();
  /// How many blocks the next rounds are to hand out (Arrival::as_recorded); none after those.
  void expect(const Rounds& rounds);

  /// What taking blocks cost the frame that took them.
  struct TakeTimes {
    double upload_ms = 0;  ///< between the first take() and the end of the taking, waits left out
    double wait_ms = 0;    ///< for blocks not finished; 0 with Arrival::as_ready
  };
  [[nodiscard]] TakeTimes last_take() const { return last_take_; }
  [[nodiscard]] std::uint64_t blocks_taken() const;

  /// Messages about tiles refused since the last call.
  std::vector<std::string> new_problems();
  [[nodiscard]] std::size_t mapped_bytes() const;
  /// Bytes of the buffers made at boot.
  [[nodiscard]] std::size_t buffer_bytes() const;

 private:
  static constexpr std::uint64_t slots = limits::blocks_in_flight + 1;  ///< one is the taker's

  /// What is ordered, and the focus at that time: it may have moved on before the block is built.
  struct Job {
    BlockOrder order;
    GeoBox focus;
  };

  void run();
  void build_into(const Job& job, TerrainBlock& block);

  TerrainFolder& folder_;
  Settings settings_;
  std::span<const TerrainEdit> edits_;
  std::vector<float> posts_, rows_, rests_, low_, high_;
  std::vector<Job> jobs_;
  std::vector<TerrainBlock> blocks_;
  TerrainBlock at_once_;

  mutable std::mutex queue_mutex_;  ///< guards what follows
  std::condition_variable work_, done_;
  std::uint64_t ordered_ = 0, built_ = 0, taken_ = 0;
  GeoBox focus_;
  bool stop_ = false;

  mutable std::mutex folder_mutex_;  ///< guards the folder, its selection, the scratch buffers
  GeoBox selected_;
  std::size_t problems_told_ = 0;

  using Clock = std::chrono::steady_clock;  ///< the taker's thread alone uses what follows
  Clock::time_point take_start_;
  bool taking_ = false;
  double wait_ms_ = 0;
  TakeTimes last_take_;
  Rounds taken_rounds_, expected_rounds_;
  std::size_t round_ = 0;  ///< of the expected ones
  int in_round_ = 0;       ///< blocks taken

  std::thread thread_;
};

/// Floor of unknown ground far from every known post: 100 m over the lowest of a few posts of the
/// tiles near a place, or of any tile where those hold none. Never below the lowest known post.
double far_floor_m(TerrainFolder& folder, const GeoBox& near);

}  // namespace ridgeline
