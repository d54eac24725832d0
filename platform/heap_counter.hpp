#pragma once
#include <cstdint>

namespace ridgeline {

/// Counts heap allocations made by our own objects while a section is open. The program must be
/// linked with the --wrap options of platform/CMakeLists.txt (heap_counter); libraries and the GL
/// driver keep their own heap and are not counted (docs/adr/0008).
class HeapSection {
 public:
  HeapSection();
  ~HeapSection();
  HeapSection(const HeapSection&) = delete;
  HeapSection& operator=(const HeapSection&) = delete;
};

/// Allocations counted in all sections so far.
[[nodiscard]] std::uint64_t heap_allocations_counted();
/// Allocations our own objects have made since the program began; shows that counting works.
[[nodiscard]] std::uint64_t heap_allocations_seen();

}  // namespace ridgeline
