#include "sim/log/vector_asc.hpp"

#include <array>
#include <optional>

#include "sim/log/log_date.hpp"
#include "sim/log/log_text.hpp"

namespace ridgeline {
namespace {

using log_text::decimal_number;
using log_text::equal_ignoring_case;
using log_text::hex_number;
using log_text::is_digit;
using log_text::next_word;
using log_text::starts_ignoring_case;
using log_text::trimmed;

constexpr std::uint32_t last_standard_id = 0x7ff, last_extended_id = 0x1fffffff;
constexpr std::uint32_t bus_error_class = 0x80;
/// Bits of the flags that end a line of a CAN FD channel.
constexpr std::uint32_t remote_flag = 0x10, fd_flag = 0x1000;
constexpr std::int64_t longest_log_ns = 1'000'000'000'000'000'000;
constexpr std::uint32_t most_channels = 255;

CandumpLine error_frame(std::int64_t time_ns) {
  CandumpLine line;
  line.kind = CandumpLineKind::frame;
  line.frame.time_ns = time_ns;
  line.frame.error = true;
  line.frame.id = bus_error_class;
  return line;
}

/// Timed events that hold no frame, by their words after the time.
bool is_event(std::string_view rest) {
  constexpr std::array<std::string_view, 6> starts = {
      "start of measurement", "stop of measurement", "log ", "trigger", "sv:",
      "end of measurement"};
  for (const std::string_view start : starts) {
    if (starts_ignoring_case(rest, start)) return true;
  }
  const std::string_view bus = next_word(rest);
  if (!equal_ignoring_case(bus, "can") && !equal_ignoring_case(bus, "canfd")) return false;
  next_word(rest);
  return starts_ignoring_case(rest, "status:") || starts_ignoring_case(rest, "statistic:");
}

bool read_direction(std::string_view word, CandumpLine& line) {
  line.is_sent = equal_ignoring_case(word, "tx");
  return line.is_sent || equal_ignoring_case(word, "rx");
}

}  // namespace

std::optional<std::uint32_t> VectorAscParser::number(std::string_view text) const {
  return is_decimal_ ? decimal_number(text) : hex_number(text);
}

const char* VectorAscParser::set_channel(std::string_view text, CandumpLine& line) {
  const std::optional<std::uint32_t> channel = decimal_number(text);
  if (!channel || *channel < 1 || *channel > most_channels) return "channel is not 1..255";
  interface_ = "can" + std::to_string(*channel - 1);
  line.interface = interface_;
  return nullptr;
}

const char* VectorAscParser::read_identifier(std::string_view text, BusFrame& frame) const {
  frame.extended = !text.empty() && (text.back() == 'x' || text.back() == 'X');
  if (frame.extended) text.remove_suffix(1);
  const std::optional<std::uint32_t> id = number(text);
  if (!id) return "identifier is not a number of the file's base";
  if (*id > (frame.extended ? last_extended_id : last_standard_id)) {
    return frame.extended ? "29-bit identifier is above 1FFFFFFF"
                          : "11-bit identifier is above 7FF";
  }
  frame.id = *id;
  return nullptr;
}

const char* VectorAscParser::read_data(std::string_view& rest, std::size_t count,
                                       BusFrame& frame) const {
  for (std::size_t index = 0; index < count; ++index) {
    const std::optional<std::uint32_t> byte = number(next_word(rest));
    if (!byte) return "fewer data bytes than the length says";
    if (*byte > 0xff) return "data byte is above 255";
    frame.data[index] = static_cast<std::uint8_t>(*byte);
  }
  frame.length = static_cast<std::uint8_t>(count);
  return nullptr;
}

/// "d LENGTH BYTES.." or "r [LENGTH]".
const char* VectorAscParser::read_classic(std::string_view rest, CandumpLine& line) const {
  const std::string_view kind = next_word(rest);
  const bool is_remote = equal_ignoring_case(kind, "r");
  if (!is_remote && !equal_ignoring_case(kind, "d")) return "neither data (d) nor remote (r)";
  const std::optional<std::uint32_t> code = number(next_word(rest));
  line.frame.remote = is_remote;
  if (!code) return is_remote ? nullptr : "length is not a number of the file's base";
  if (*code > 15) return "length code is above 15";
  const std::size_t count = *code < 8 ? *code : 8;
  if (*code > 8) line.raw_dlc = static_cast<std::uint8_t>(*code);
  if (!is_remote) return read_data(rest, count, line.frame);
  line.frame.length = static_cast<std::uint8_t>(count);
  return nullptr;
}

/// "CH ID[x] Rx|Tx ..", or the events and errors of one channel.
CandumpLine VectorAscParser::channel_line(std::string_view channel, std::string_view rest,
                                          std::int64_t time_ns) {
  CandumpLine line;
  const std::string_view first = next_word(rest);
  if (equal_ignoring_case(first, "statistic:") || equal_ignoring_case(first, "j1939tp")) {
    line.kind = CandumpLineKind::comment;
    return line;
  }
  if (starts_ignoring_case(first, "errorframe")) line = error_frame(time_ns);
  if (const char* why = set_channel(channel, line)) return malformed_line(why);
  if (line.frame.error) return line;
  line.kind = CandumpLineKind::frame;
  line.frame.time_ns = time_ns;
  if (const char* why = read_identifier(first, line.frame)) return malformed_line(why);
  if (!read_direction(next_word(rest), line))
    return malformed_line("direction is neither Rx nor Tx");
  if (const char* why = read_classic(rest, line)) return malformed_line(why);
  return line;
}

/// "CH Rx|Tx ID[x] [NAME] BRS ESI CODE LENGTH BYTES.. DURATION BITS FLAGS ..".
CandumpLine VectorAscParser::fd_line(std::string_view rest, std::int64_t time_ns) {
  CandumpLine line;
  line.kind = CandumpLineKind::frame;
  if (const char* why = set_channel(next_word(rest), line)) return malformed_line(why);
  if (!read_direction(next_word(rest), line))
    return malformed_line("direction is neither Rx nor Tx");
  const std::string_view identifier = next_word(rest);
  if (starts_ignoring_case(identifier, "errorframe")) {
    const std::string_view interface = line.interface;
    line = error_frame(time_ns);
    line.interface = interface;
    return line;
  }
  line.frame.time_ns = time_ns;
  if (const char* why = read_identifier(identifier, line.frame)) return malformed_line(why);
  std::string_view word = next_word(rest);
  if (word != "0" && word != "1") word = next_word(rest);  // a symbolic name came first
  const std::string_view state = next_word(rest);
  if ((word != "0" && word != "1") || (state != "0" && state != "1")) {
    return malformed_line("CAN FD bits BRS and ESI are missing");
  }
  const std::optional<std::uint32_t> code = hex_number(next_word(rest));
  const std::optional<std::uint32_t> length = decimal_number(next_word(rest));
  if (!code || *code > 15) return malformed_line("length code is not 0..f");
  if (!length || *length > 64) return malformed_line("length is not 0..64");
  if (const char* why = read_data(rest, *length, line.frame)) return malformed_line(why);
  next_word(rest);  // duration
  next_word(rest);  // bits on the bus
  const std::optional<std::uint32_t> flags = hex_number(next_word(rest));
  // Some writers leave the flags 0: then the line itself says CAN FD.
  line.frame.fd = !flags || *flags == 0 || (*flags & fd_flag) != 0 || *length > 8;
  line.frame.remote = flags && (*flags & remote_flag) != 0;
  if (line.frame.remote && ((*flags & fd_flag) != 0 || *length > 0)) {
    return malformed_line("a remote frame is not CAN FD and has no data");
  }
  if (line.frame.remote) line.frame.length = static_cast<std::uint8_t>(*code < 8 ? *code : 8);
  return line;
}

CandumpLine VectorAscParser::timed_line(std::string_view time, std::string_view rest) {
  const std::optional<std::int64_t> stamp_ns = log_text::billionths(time);
  if (!stamp_ns) return malformed_line("time is not seconds and a decimal fraction");
  if (*stamp_ns > longest_log_ns - (is_relative_ ? elapsed_ns_ : 0)) {
    return malformed_line("time is beyond 30 years");
  }
  // Relative times count from the timed line before, whatever that line was.
  elapsed_ns_ = is_relative_ ? elapsed_ns_ + *stamp_ns : *stamp_ns;
  const std::int64_t time_ns = start_ns_ + elapsed_ns_;
  CandumpLine line;
  line.kind = CandumpLineKind::comment;
  if (is_event(rest)) return line;
  const std::string_view first = next_word(rest);
  if (equal_ignoring_case(first, "canfd")) return fd_line(rest, time_ns);
  if (first.empty() || !is_digit(first.front())) return malformed_line("event is not a known one");
  return channel_line(first, rest, time_ns);
}

/// Lines without a time: header, trigger block, comments.
CandumpLine VectorAscParser::header_line(std::string_view text) {
  CandumpLine line;
  line.kind = CandumpLineKind::comment;
  const std::string_view whole = text;
  const std::string_view first = next_word(text);
  const bool is_block = starts_ignoring_case(whole, "begin triggerblock");
  if (is_block) next_word(text);
  if (equal_ignoring_case(first, "date") || (is_block && !text.empty())) {
    const std::optional<std::int64_t> start_ns = asc_date_ns(text);
    if (!start_ns) return malformed_line("date is not one");
    start_ns_ = *start_ns;
    elapsed_ns_ = 0;
    return line;
  }
  if (equal_ignoring_case(first, "base")) {
    const std::string_view base = next_word(text);
    const std::string_view word = next_word(text);
    const std::string_view times = next_word(text);
    is_decimal_ = equal_ignoring_case(base, "dec");
    is_relative_ = equal_ignoring_case(times, "relative");
    const bool is_good =
        (is_decimal_ || equal_ignoring_case(base, "hex")) &&
        (word.empty() || (equal_ignoring_case(word, "timestamps") &&
                          (is_relative_ || equal_ignoring_case(times, "absolute"))));
    return is_good ? line
                   : malformed_line("base is not hex or dec with absolute or relative times");
  }
  const bool is_known = is_block || equal_ignoring_case(whole, "end triggerblock") ||
                        equal_ignoring_case(whole, "internal events logged") ||
                        equal_ignoring_case(whole, "no internal events logged");
  return is_known ? line : malformed_line("neither a frame nor an event nor a comment");
}

CandumpLine VectorAscParser::line(std::string_view text) {
  text = trimmed(text);
  CandumpLine comment;
  comment.kind = CandumpLineKind::comment;
  if (text.empty()) return comment;
  if (text.substr(0, 2) == "//") return comment_line(trimmed(text.substr(2)));
  if (!is_digit(text.front())) return header_line(text);
  const std::string_view time = next_word(text);
  return timed_line(time, text);
}

}  // namespace ridgeline
