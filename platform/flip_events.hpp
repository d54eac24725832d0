#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/result.hpp"

namespace ridgeline {

/// A page flip that has happened, as the kernel tells.
struct FlipEvent {
  std::uint64_t picture = 0;         ///< what drmModePageFlip() was given along
  std::int64_t time_ns = 0;          ///< of the vertical blank, CLOCK_MONOTONIC
  std::uint32_t vertical_blank = 0;  ///< its number
};

/// Reads the page flips of a graphics card. No allocation, no call into libdrm.
class FlipEvents {
 public:
  FlipEvents() = default;
  /// Owner: the caller of `card`, which stays open.
  explicit FlipEvents(int card) : card_(card) {}

  /// The next flip. Errors: screen_flip_late when none comes within `timeout_ns` (0: none is
  /// there), screen_lost when the card is gone or tells nonsense.
  [[nodiscard]] Result<FlipEvent> next(std::int64_t timeout_ns);

 private:
  [[nodiscard]] Status fill(std::int64_t deadline_ns);
  int card_ = -1;
  alignas(8) std::array<std::byte, 512> told_{};
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace ridgeline
