#pragma once
#include <array>
#include <cstdint>

#include "core/monitor/availability.hpp"
#include "platform/spsc_ring.hpp"

namespace ridgeline {

/// How much a line of the log matters; the numbers are those of syslog.
enum class LogLevel : std::uint8_t { error = 3, caution = 4, note = 6 };

struct LogRecord {
  std::int64_t time_ns = 0;  ///< CLOCK_MONOTONIC
  LogLevel level = LogLevel::note;
  std::array<char, 200> text{};
};

/// Lines of one thread on their way to the log thread. A full ring drops the line and counts it.
/// Cost: formats into fixed memory; no allocation, no system call but the clock's.
class LogRing {
 public:
  /// As printf. Domain: integers and strings; a longer text is cut.
  [[gnu::format(printf, 3, 4)]] void tell(LogLevel level, const char* format, ...);
  /// By the log thread.
  bool pop(LogRecord& record) { return ring_.pop(record); }
  [[nodiscard]] std::uint64_t dropped_count() const { return ring_.refused_count(); }

 private:
  SpscRing<LogRecord, 128> ring_;
};

/// One line of text without end of line, "12.345678 s: TEXT"; under a service manager's journal
/// with the level as `<N>` before it. Returns its length. Shape: line has room for 256 bytes.
int log_line(const LogRecord& record, bool for_journal, std::array<char, 256>& line);

/// What a picture is, in words: its mode and its reasons, "removed attitude_stale heading_stale".
/// What finds no room is left out.
[[nodiscard]] std::array<char, 128> picture_words(const Availability& availability);

}  // namespace ridgeline
