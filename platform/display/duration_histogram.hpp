#pragma once
#include <array>
#include <atomic>
#include <cstdint>

namespace ridgeline {

/// How often durations of each length came, to 0.25 ms up to 1 s; longer ones count as the last.
/// Rules: one thread calls add(); any may ask, and then sees a moment's counts.
class DurationHistogram {
 public:
  static constexpr std::int64_t step_ns = 250'000;
  static constexpr std::size_t steps = 4'000;

  void add(std::int64_t duration_ns) {
    const std::int64_t step = duration_ns < 0 ? 0 : duration_ns / step_ns;
    const auto last = static_cast<std::int64_t>(steps) - 1;
    counts_[static_cast<std::size_t>(step < last ? step : last)].fetch_add(
        1, std::memory_order_relaxed);
    count_.fetch_add(1, std::memory_order_relaxed);
    if (duration_ns > largest_ns_.load(std::memory_order_relaxed)) {
      largest_ns_.store(duration_ns, std::memory_order_relaxed);
    }
  }

  [[nodiscard]] std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t largest_ns() const {
    return largest_ns_.load(std::memory_order_relaxed);
  }
  /// Upper edge of the step in which the quantile lies, never above the largest; 0 without any.
  /// Domain: 0 < share <= 1.
  [[nodiscard]] std::int64_t quantile_ns(double share) const {
    const std::uint64_t total = count();
    std::uint64_t seen = 0;
    for (std::size_t step = 0; step < steps; ++step) {
      seen += counts_[step].load(std::memory_order_relaxed);
      if (seen > 0 && static_cast<double>(seen) >= share * static_cast<double>(total)) {
        const std::int64_t edge_ns = static_cast<std::int64_t>(step + 1) * step_ns;
        return step + 1 == steps || edge_ns > largest_ns() ? largest_ns() : edge_ns;
      }
    }
    return 0;
  }

 private:
  std::array<std::atomic<std::uint32_t>, steps> counts_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> largest_ns_{0};
};

}  // namespace ridgeline
