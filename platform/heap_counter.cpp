#include "platform/heap_counter.hpp"

#include <atomic>
#include <cstddef>

namespace {
std::atomic<std::uint64_t> seen{0};
std::atomic<std::uint64_t> counted{0};
thread_local bool counting = false;

void count() {
  seen.fetch_add(1, std::memory_order_relaxed);
  if (counting) counted.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// The linker sends our objects' calls here: -Wl,--wrap=malloc and so on.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier)
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* block, std::size_t size);
void* __real__Znwm(std::size_t size);
void* __real__Znam(std::size_t size);

void* __wrap_malloc(std::size_t size) {
  count();
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t number, std::size_t size) {
  count();
  return __real_calloc(number, size);
}
void* __wrap_realloc(void* block, std::size_t size) {
  count();
  return __real_realloc(block, size);
}
void* __wrap__Znwm(std::size_t size) {
  count();
  return __real__Znwm(size);
}
void* __wrap__Znam(std::size_t size) {
  count();
  return __real__Znam(size);
}
// NOLINTEND(bugprone-reserved-identifier)
}

namespace ridgeline {

HeapSection::HeapSection() {
  counting = true;
}
HeapSection::~HeapSection() {
  counting = false;
}
std::uint64_t heap_allocations_counted() {
  return counted.load(std::memory_order_relaxed);
}
std::uint64_t heap_allocations_seen() {
  return seen.load(std::memory_order_relaxed);
}

}  // namespace ridgeline
