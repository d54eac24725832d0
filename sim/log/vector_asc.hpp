#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/log/candump_line.hpp"

namespace ridgeline {

/// Takes the lines of a Vector ASC log apart, one after the other: what a line means depends on the
/// header before it.
/// Grammar: `date WEEKDAY MONTH DAY TIME [am|pm] YEAR` and `Begin Triggerblock` with such a date
/// give
///   the start, read as UTC (the file says no zone; month names English or German); `base hex|dec
///   timestamps absolute|relative` says how numbers and times are written, relative ones counting
///   from the timed line before. Then `T CH ID[x] Rx|Tx d LENGTH BYTES..`, `T CH ID[x] Rx|Tx r
///   [LENGTH]`, `T CH ErrorFrame ..`, and `T CANFD CH Rx|Tx ID[x] [NAME] BRS ESI CODE LENGTH
///   BYTES.. DURATION BITS FLAGS ..`, whose flags, unless 0, say whether the frame was FD or
///   classic. What follows a frame's data is not judged. Channel n is interface can(n-1). Lines of
///   `//`, the header, the trigger block and timed events without a frame (Start of measurement,
///   Status, Statistic, J1939TP, log and trigger events) are comments;
///   `// ridgeline: ..` is a label. Everything else is malformed.
/// Source: facts of python-can's reader and can-utils' asc2log; deviations in docs/icd.md.
class VectorAscParser {
 public:
  /// The next line; views hold until the next call.
  [[nodiscard]] CandumpLine line(std::string_view text);

 private:
  CandumpLine header_line(std::string_view text);
  CandumpLine timed_line(std::string_view time, std::string_view rest);
  CandumpLine channel_line(std::string_view channel, std::string_view rest, std::int64_t time_ns);
  CandumpLine fd_line(std::string_view rest, std::int64_t time_ns);
  const char* read_classic(std::string_view rest, CandumpLine& line) const;
  const char* read_identifier(std::string_view text, BusFrame& frame) const;
  const char* set_channel(std::string_view text, CandumpLine& line);
  const char* read_data(std::string_view& rest, std::size_t count, BusFrame& frame) const;
  [[nodiscard]] std::optional<std::uint32_t> number(std::string_view text) const;

  bool is_decimal_ = false;
  bool is_relative_ = false;
  std::int64_t start_ns_ = 0;
  std::int64_t elapsed_ns_ = 0;
  std::string interface_;
};

}  // namespace ridgeline
