#pragma once
#include <cstdint>

namespace ridgeline {

/// One switch input: the level that counts, and the one that wants to.
struct Debounce {
  bool level = false;         ///< what the program acts on
  bool candidate = false;     ///< the last level read
  std::int64_t since_ns = 0;  ///< when the candidate was first read
  std::uint32_t changes = 0;  ///< of `level`
  std::uint32_t bounces = 0;  ///< candidates given up before they counted
};

/// An input before it was ever read.
[[nodiscard]] constexpr Debounce debounce_from(bool level, std::int64_t now_ns) {
  return {level, level, now_ns, 0, 0};
}

/// One more reading. A level counts once every reading for `hold_ns` had it; a clock that went back
/// starts the wait again.
/// Domain: hold_ns >= 0; with 0 every reading counts at once.
[[nodiscard]] Debounce debounced(const Debounce& previous, bool level, std::int64_t now_ns,
                                 std::int64_t hold_ns);

}  // namespace ridgeline
