#pragma once
#include <pthread.h>

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/base/result.hpp"

namespace ridgeline {

/// A thread of the flight program: named, with a stack of fixed size.
class FlightThread {
 public:
  FlightThread() = default;
  FlightThread(const FlightThread&) = delete;
  FlightThread& operator=(const FlightThread&) = delete;

  /// Starts `function(context)` once. `name`: at most 15 characters.
  /// Errors: Fault::thread_refused.
  [[nodiscard]] Status start(const char* name, void (*function)(void*), void* context);
  [[nodiscard]] bool ended() const { return ended_.load(std::memory_order_acquire); }
  /// Waits for its end, at most so long; whether it has ended.
  bool join(std::int64_t timeout_ns);

 private:
  static void* run(void* self);

  static constexpr std::size_t stack_bytes = std::size_t{1} << 20;
  pthread_t thread_{};
  const char* name_ = "";
  void (*function_)(void*) = nullptr;
  void* context_ = nullptr;
  bool started_ = false;
  std::atomic<bool> ended_{false};
};

/// Puts the calling thread under SCHED_FIFO. 0, or errno: EPERM where the right is missing
/// (CAP_SYS_NICE or LimitRTPRIO). Domain: priority 1..99.
[[nodiscard]] int make_real_time(int priority);

/// Touches the calling thread's stack so far down that later calls meet no new page.
void touch_stack();

/// Locks all that the program holds now into memory. What is mapped later is not: terrain tiles
/// come and go with the flight, and reading them is the business of one thread that may wait. 0, or
/// errno: EPERM or ENOMEM where RLIMIT_MEMLOCK is too small.
[[nodiscard]] int lock_memory_of_now();

/// Sleeps until a moment of CLOCK_MONOTONIC; returns at once when it has passed.
void sleep_until(std::int64_t time_ns);

}  // namespace ridgeline
