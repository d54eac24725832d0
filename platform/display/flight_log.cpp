#include "platform/display/flight_log.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <string_view>

#include "platform/can_batch.hpp"

namespace ridgeline {

void LogRing::tell(LogLevel level, const char* format, ...) {
  LogRecord record;
  record.time_ns = monotonic_now_ns();
  record.level = level;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(record.text.data(), record.text.size(), format, arguments);
  va_end(arguments);
  ring_.push(record);
}

int log_line(const LogRecord& record, bool for_journal, std::array<char, 256>& line) {
  const auto seconds = static_cast<long long>(record.time_ns / 1'000'000'000);
  const auto micros = static_cast<int>(record.time_ns % 1'000'000'000 / 1'000);
  char level[8] = "";
  if (for_journal) std::snprintf(level, sizeof level, "<%d>", static_cast<int>(record.level));
  const int length = std::snprintf(line.data(), line.size(), "%s%lld.%06d s: %s", level, seconds,
                                   micros, record.text.data());
  return std::clamp(length, 0, static_cast<int>(line.size()) - 1);
}

std::array<char, 128> picture_words(const Availability& availability) {
  std::array<char, 128> words{};
  std::size_t length = 0;
  const auto add = [&](const char* before, std::string_view word) {
    const int added = std::snprintf(words.data() + length, words.size() - length, "%s%.*s", before,
                                    static_cast<int>(word.size()), word.data());
    length = std::min(length + static_cast<std::size_t>(added), words.size() - 1);
  };
  add("", mode_word(availability.mode));
  for (const Reason reason : availability.reasons) add(" ", reason_word(reason));
  return words;
}

}  // namespace ridgeline
