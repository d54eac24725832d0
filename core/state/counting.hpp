#pragma once
#include <cstdint>
#include <limits>

namespace ridgeline {

/// One more, but never over the top.
inline void bump(std::uint32_t& counter) {
  if (counter != std::numeric_limits<std::uint32_t>::max()) ++counter;
}

}  // namespace ridgeline
