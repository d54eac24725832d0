#include "tests/unit/platform_terrain/allocation_count.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> count = 0;
}

// Replaced for the whole test program, so that a test can prove a call takes no heap.
void* operator new(std::size_t size_bytes) {
  ++count;
  if (void* memory = std::malloc(size_bytes == 0 ? 1 : size_bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t /*size_bytes*/) noexcept {
  std::free(memory);
}

namespace ridgeline::test {

std::size_t allocation_count() {
  return count;
}

}  // namespace ridgeline::test
