#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

namespace ridgeline::rig {

/// A stretch of time, from `at_ns` on the monotonic clock.
struct Stretch {
  std::int64_t at_ns = 0;
  std::int64_t length_ns = 0;
};

/// What an outside watchdog sees of a heartbeat line, and how well it could look.
struct WatchFacts {
  std::uint64_t edges = 0;
  std::int64_t longest_gap_ns = 0;  ///< between two edges next to each other
  std::int64_t away_ns = 0;         ///< together: looks 5 ms late or more: nothing ran at all
  std::vector<Stretch> gaps;        ///< those longer than asked for
  std::vector<Stretch> stalls;      ///< of the machine: 20 ms or longer without a look
};

/// Looks at a line 500 times a second, before all other threads of the machine, and counts. Late
/// looks are the machine's: nothing in it goes first.
class LineWatch {
 public:
  /// `value_file`: "0" or "1"; `gap_ns`: edges further apart than this are noted one by one.
  LineWatch(const std::filesystem::path& value_file, std::int64_t gap_ns);
  LineWatch(const LineWatch&) = delete;
  LineWatch& operator=(const LineWatch&) = delete;
  ~LineWatch();

  /// Everything so far.
  [[nodiscard]] WatchFacts facts() const;
  /// Whether the system let it go first; late looks may be anybody's otherwise.
  [[nodiscard]] bool goes_first() const { return goes_first_; }

 private:
  void run();
  void look(std::int64_t now_ns);
  void note_late(std::int64_t due_ns, std::int64_t now_ns);

  int file_ = -1;
  std::int64_t gap_ns_ = 0;
  std::atomic<bool> stop_{false}, goes_first_{false};
  bool level_ = false;
  std::int64_t last_edge_ns_ = 0;
  mutable std::mutex mutex_;  ///< of the facts
  WatchFacts facts_;
  std::thread thread_;
};

}  // namespace ridgeline::rig
