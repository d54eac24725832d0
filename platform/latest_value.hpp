#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace ridgeline {

/// The newest value of one thread for one other: three slots that change hands, so that neither
/// ever waits, repeats or sees half a value. Values in between are lost, which is the point.
/// Rules: one thread calls write(), one calls read().
/// Cost:  two copies of T and one atomic exchange; no lock, no loop, no allocation.
template <typename T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void write(const T& value) {
    slots_[back_] = value;
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | fresh), std::memory_order_acq_rel) &
            slot_mask;
  }

  /// The newest value into `value`; whether it is one that was not read before.
  bool read(T& value) {
    const bool is_new = (middle_.load(std::memory_order_relaxed) & fresh) != 0;
    if (is_new) front_ = middle_.exchange(front_, std::memory_order_acq_rel) & slot_mask;
    value = slots_[front_];
    return is_new;
  }

 private:
  static constexpr std::uint8_t slot_mask = 3, fresh = 4;

  std::array<T, 3> slots_{};
  alignas(64) std::atomic<std::uint8_t> middle_{1};
  alignas(64) std::uint8_t back_ = 0;   ///< the writer's
  alignas(64) std::uint8_t front_ = 2;  ///< the reader's
};

}  // namespace ridgeline
