#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace ridgeline {

/// A queue from one thread to one other, of fixed capacity: what does not fit is refused and
/// counted, never waited for.
/// Rules: one thread calls push(), one calls pop(); refused_count() may be asked by anybody.
/// Cost:  one copy of T; no lock, no allocation.
template <typename T, std::size_t Capacity>
class SpscRing {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "indices wrap round");

 public:
  bool push(const T& value) {
    const std::uint32_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == Capacity) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    items_[end % Capacity] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  bool pop(T& value) {
    const std::uint32_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    value = items_[begin % Capacity];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  [[nodiscard]] static constexpr std::size_t capacity() { return Capacity; }
  [[nodiscard]] std::uint64_t refused_count() const {
    return refused_.load(std::memory_order_relaxed);
  }

 private:
  std::array<T, Capacity> items_{};
  alignas(64) std::atomic<std::uint32_t> end_{0};    ///< written by push()
  alignas(64) std::atomic<std::uint32_t> begin_{0};  ///< written by pop()
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace ridgeline
