#include "tests/rig/line_watch.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>

namespace ridgeline::rig {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t look_ns = 2'000'000;
constexpr std::int64_t late_ns = 5'000'000;    // below this a timer is as good as it gets
constexpr std::int64_t stall_ns = 20'000'000;  // two rounds of the supervisor
constexpr int before_all_others = 90;

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * second_ns + now.tv_nsec;
}

void sleep_until(std::int64_t time_ns) {
  const timespec time{time_ns / second_ns, time_ns % second_ns};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != 0) {
  }
}

bool is_up(int file) {
  char text = '0';
  return ::pread(file, &text, 1, 0) == 1 && text == '1';
}

}  // namespace

LineWatch::LineWatch(const std::filesystem::path& value_file, std::int64_t gap_ns)
    : file_(::open(value_file.c_str(), O_RDONLY | O_CLOEXEC)), gap_ns_(gap_ns) {
  level_ = is_up(file_);
  thread_ = std::thread([this] { run(); });
}

LineWatch::~LineWatch() {
  stop_ = true;
  thread_.join();
  ::close(file_);
}

WatchFacts LineWatch::facts() const {
  const std::lock_guard lock(mutex_);
  return facts_;
}

void LineWatch::run() {
  const sched_param first{before_all_others};
  goes_first_ = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &first) == 0;
  std::int64_t due_ns = now_ns();
  while (!stop_) {
    due_ns += look_ns;
    sleep_until(due_ns);
    const std::int64_t woken_ns = now_ns();
    look(woken_ns);
    if (woken_ns - due_ns > late_ns) {
      note_late(due_ns, woken_ns);
      due_ns = woken_ns;
    }
  }
}

void LineWatch::look(std::int64_t now_ns) {
  const bool level = is_up(file_);
  if (level == level_) return;
  level_ = level;
  const std::lock_guard lock(mutex_);
  ++facts_.edges;
  const std::int64_t gap_ns = last_edge_ns_ > 0 ? now_ns - last_edge_ns_ : 0;
  if (gap_ns > gap_ns_) facts_.gaps.push_back({last_edge_ns_, gap_ns});
  facts_.longest_gap_ns = std::max(facts_.longest_gap_ns, gap_ns);
  last_edge_ns_ = now_ns;
}

void LineWatch::note_late(std::int64_t due_ns, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  facts_.away_ns += now_ns - due_ns;
  if (now_ns - due_ns >= stall_ns) facts_.stalls.push_back({due_ns, now_ns - due_ns});
}

}  // namespace ridgeline::rig
