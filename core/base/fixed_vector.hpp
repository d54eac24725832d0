#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "core/base/assert.hpp"

namespace ridgeline {

/// A vector with room for `Capacity` elements inside the object: never allocates.
/// Elements beyond the capacity are refused and counted, never lost in silence.
template <typename T, std::size_t Capacity>
class FixedVector {
 public:
  /// Appends; false (and one more in refused_count()) when full.
  bool push_back(const T& value) {
    if (count_ == Capacity) {
      ++refused_count_;
      return false;
    }
    items_[count_++] = value;
    if (count_ > high_water_count_) high_water_count_ = count_;
    return true;
  }
  void clear() { count_ = 0; }

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] static constexpr std::size_t capacity() { return Capacity; }
  [[nodiscard]] std::size_t high_water_count() const { return high_water_count_; }
  [[nodiscard]] std::size_t refused_count() const { return refused_count_; }
  [[nodiscard]] const T& operator[](std::size_t index) const {
    RL_ASSERT(index < count_);
    return items_[index];
  }
  [[nodiscard]] T& operator[](std::size_t index) {
    RL_ASSERT(index < count_);
    return items_[index];
  }
  [[nodiscard]] auto begin() const { return items_.begin(); }
  [[nodiscard]] auto end() const { return items_.begin() + static_cast<std::ptrdiff_t>(count_); }
  [[nodiscard]] std::span<const T> view() const { return {items_.data(), count_}; }

 private:
  std::array<T, Capacity> items_{};
  std::size_t count_ = 0;
  std::size_t high_water_count_ = 0;
  std::size_t refused_count_ = 0;
};

}  // namespace ridgeline
