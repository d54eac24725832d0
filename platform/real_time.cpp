#include "platform/real_time.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <cerrno>
#include <cstring>

#include "config/limits_bus.hpp"
#include "platform/can_batch.hpp"

namespace ridgeline {

void* FlightThread::run(void* self) {
  auto* thread = static_cast<FlightThread*>(self);
  pthread_setname_np(pthread_self(), thread->name_);
  thread->function_(thread->context_);
  thread->ended_.store(true, std::memory_order_release);
  return nullptr;
}

Status FlightThread::start(const char* name, void (*function)(void*), void* context) {
  RL_ASSERT(!started_);
  name_ = name;
  function_ = function;
  context_ = context;
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return Fault::thread_refused;
  const bool made = pthread_attr_setstacksize(&attributes, stack_bytes) == 0 &&
                    pthread_create(&thread_, &attributes, run, this) == 0;
  pthread_attr_destroy(&attributes);
  if (!made) return Fault::thread_refused;
  started_ = true;
  return {};
}

bool FlightThread::join(std::int64_t timeout_ns) {
  if (!started_) return true;
  timespec end{};
  clock_gettime(CLOCK_REALTIME, &end);
  const std::int64_t end_ns = end.tv_nsec + timeout_ns;
  end.tv_sec += end_ns / limits::second_ns;
  end.tv_nsec = end_ns % limits::second_ns;
  if (pthread_timedjoin_np(thread_, nullptr, &end) != 0) return false;
  started_ = false;
  return true;
}

int make_real_time(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

void touch_stack() {
  constexpr std::size_t bytes = 256 * 1024;
  unsigned char room[bytes];
  // Through a volatile pointer: a compiler would leave out what nobody reads.
  volatile unsigned char* const touched = room;
  constexpr std::size_t page_bytes = 4096;
  for (std::size_t at = 0; at < bytes; at += page_bytes) touched[at] = 1;
}

int lock_memory_of_now() {
  return ::mlockall(MCL_CURRENT) == 0 ? 0 : errno;
}

void sleep_until(std::int64_t time_ns) {
  const timespec until = {time_ns / limits::second_ns, time_ns % limits::second_ns};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace ridgeline
