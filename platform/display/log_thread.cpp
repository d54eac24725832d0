#include "platform/display/log_thread.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "platform/heap_counter.hpp"
#include "platform/real_time.hpp"

namespace ridgeline {
namespace {

constexpr std::int64_t round_ns = 50 * limits::ms_ns;

/// All of it, however often the system takes only a part.
bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

LogThread::LogThread(const DisplayConfig& config, Exchange& exchange)
    : config_(config),
      exchange_(exchange),
      for_journal_(std::getenv("JOURNAL_STREAM") != nullptr),
      new_file_(config.report.status_file + ".new") {}

void LogThread::run() {
  const HeapSection after_boot;
  while (!end.load(std::memory_order_acquire)) {
    const std::int64_t now_ns = monotonic_now_ns();
    round(now_ns);
    sleep_until(now_ns + round_ns);
  }
}

void LogThread::write_lines(LogRing& ring) {
  LogRecord record;
  // No more than a ring holds: a thread that talks without end must not keep the reports waiting.
  for (int i = 0; i < 128 && ring.pop(record); ++i) {
    std::array<char, 256> line{};
    int length = log_line(record, for_journal_, line);
    if (length == static_cast<int>(line.size()) - 1) --length;
    line[static_cast<std::size_t>(length++)] = '\n';
    static_cast<void>(write_all(STDERR_FILENO, {line.data(), static_cast<std::size_t>(length)}));
  }
}

void LogThread::round(std::int64_t now_ns) {
  for (LogRing* ring : {&exchange_.supervisor_log, &exchange_.render_log, &exchange_.bus_log}) {
    write_lines(*ring);
  }
  const bool wanted = exchange_.want_status.exchange(false);
  const double interval_s = config_.report.status_interval_s;
  const bool due =
      interval_s > 0 && !config_.report.status_file.empty() && now_ns >= next_report_ns_;
  if (!wanted && !due) return;
  if (due) next_report_ns_ = now_ns + std::llround(interval_s * 1e9);
  report(now_ns, "running");
}

void LogThread::report(std::int64_t now_ns, const char* why) {
  read_sources(exchange_, sources_);
  write_status(json_, config_, exchange_, sources_, now_ns, why);
  const char* path = config_.report.status_file.c_str();
  if (*path == '\0') {
    static_cast<void>(write_all(STDOUT_FILENO, json_.text()));
    return;
  }
  constexpr mode_t for_all_to_read = 0644;
  const int file =
      ::open(new_file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, for_all_to_read);
  const bool written = file >= 0 && write_all(file, json_.text());
  const bool closed = file >= 0 && ::close(file) == 0;
  if (!written || !closed || std::rename(new_file_.c_str(), path) != 0) {
    std::fprintf(stderr, "ridgeline-display: %s: %s\n", path,
                 fault_text(Fault::file_unwritable).data());
  }
}

void LogThread::finish(const char* why) {
  round(monotonic_now_ns());
  report(monotonic_now_ns(), why);
}

}  // namespace ridgeline
