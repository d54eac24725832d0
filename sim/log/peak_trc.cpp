#include "sim/log/peak_trc.hpp"

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
constexpr std::uint32_t status_id = 0xffffffff;  // of a row that tells the state of the bus
constexpr std::size_t longest_standard_digits = 4;
constexpr std::uint32_t controller_class = 0x4, bus_off_class = 0x40, bus_error_class = 0x80,
                        counter_class = 0x200;
constexpr std::uint32_t bus_off_status = 0x10;
constexpr std::int64_t longest_offset_ms = 1'000'000'000'000;
constexpr std::uint32_t most_buses = 255;

constexpr std::array<std::uint8_t, 16> fd_lengths = {0, 1,  2,  3,  4,  5,  6,  7,
                                                     8, 12, 16, 20, 24, 32, 48, 64};

/// "milliseconds.fraction" as nanoseconds, cut off below one.
std::optional<std::int64_t> offset_ns(std::string_view text) {
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  std::int64_t ms = 0;
  if (whole.empty()) return std::nullopt;
  for (const char c : whole) {
    if (!is_digit(c)) return std::nullopt;
    ms = ms * 10 + (c - '0');
    if (ms > longest_offset_ms) return std::nullopt;
  }
  if (point == std::string_view::npos) return ms * 1'000'000;
  std::string fraction = "0.";
  fraction.append(text.substr(point + 1));
  const std::optional<std::int64_t> billionths = log_text::billionths(fraction);
  if (!billionths) return std::nullopt;
  return ms * 1'000'000 + *billionths / 1000;
}

/// The error class that a row without a data frame stands for, or none.
std::optional<std::uint32_t> error_class(std::string_view type, std::string_view id,
                                         std::string_view data) {
  if (type == "ER" || equal_ignoring_case(type, "error")) return bus_error_class;
  if (type == "EC") return counter_class;
  const bool is_status =
      type == "ST" || equal_ignoring_case(type, "warng") || hex_number(id) == status_id;
  if (!is_status) return std::nullopt;
  // Four bytes of status, most significant first; the last one says bus-off or not.
  std::uint32_t last = 0;
  for (int byte = 0; byte < 4; ++byte) last = hex_number(next_word(data)).value_or(0);
  return (last & bus_off_status) != 0 ? bus_off_class : controller_class;
}

bool is_data_type(std::string_view type) {
  constexpr std::array<std::string_view, 6> types = {"", "DT", "FD", "FB", "FE", "BI"};
  for (const std::string_view known : types) {
    if (type == known) return true;
  }
  return false;
}

const char* read_identifier(std::string_view text, BusFrame& frame) {
  const std::optional<std::uint32_t> id = hex_number(text);
  if (!id) return "identifier is not hexadecimal";
  frame.extended = text.size() > longest_standard_digits;
  if (*id > (frame.extended ? last_extended_id : last_standard_id)) {
    return frame.extended ? "29-bit identifier is above 1FFFFFFF"
                          : "11-bit identifier is above 7FF";
  }
  frame.id = *id;
  return nullptr;
}

const char* read_data(std::string_view data, std::size_t count, BusFrame& frame) {
  for (std::size_t index = 0; index < count; ++index) {
    const std::string_view word = next_word(data);
    const std::optional<std::uint32_t> byte = hex_number(word);
    if (!byte || word.size() > 2) return "fewer data bytes than the length says";
    frame.data[index] = static_cast<std::uint8_t>(*byte);
  }
  frame.length = static_cast<std::uint8_t>(count);
  return data.empty() ? nullptr : "more data bytes than the length says";
}

}  // namespace

const char* PeakTrcParser::set_bus(std::string_view bus, CandumpLine& line) {
  std::uint32_t number = 1;
  if (!bus.empty()) {
    const std::optional<std::uint32_t> given = decimal_number(bus);
    if (!given || *given < 1 || *given > most_buses) return "bus is not 1..255";
    number = *given;
  }
  interface_ = "can" + std::to_string(number - 1);
  line.interface = interface_;
  return nullptr;
}

/// Takes a row apart in the order of $COLUMNS, or of the version.
const char* PeakTrcParser::read_columns(std::string_view rest, Row& row) const {
  constexpr std::array<std::array<std::string_view, 2>, 6> orders = {
      {{"1.0", "N,O,I,L,D"},
       {"1.1", "N,O,T,I,L,D"},
       {"1.2", "N,O,B,T,I,L,D"},
       {"1.3", "N,O,B,T,I,R,L,D"},
       {"2.0", "N,O,T,I,d,l,D"},
       {"2.1", "N,O,T,B,I,d,R,L,D"}}};
  std::string_view columns = columns_;
  bool is_known = false;
  for (const auto& order : orders) {
    if (order[0] != version_) continue;
    is_known = true;
    if (columns.empty()) columns = order[1];
  }
  if (!is_known) return "file version is not one of 1.0 to 2.1";
  for (const char column : columns) {
    // A bus state of version 2.0 leaves identifier and length out.
    const bool is_left_out =
        row.type == "ST" && version_ == "2.0" && (column == 'I' || column == 'l');
    if (column == ',' || is_left_out) continue;
    if (column == 'D') {
      row.data = trimmed(rest);
      continue;
    }
    const std::string_view word = next_word(rest);
    switch (column) {
      case 'N':
      case 'R':
        break;
      case 'O':
        row.time = word;
        break;
      case 'T':
        row.type = word;
        break;
      case 'B':
        row.bus = word;
        break;
      case 'I':
        row.id = word;
        break;
      case 'd':
        row.direction = word;
        break;
      case 'l':
      case 'L':
        row.length = word;
        row.length_is_code = column == 'L';
        break;
      default:
        return "$COLUMNS names a column that is not known";
    }
  }
  return nullptr;
}

CandumpLine PeakTrcParser::frame_of(const Row& row) {
  CandumpLine line;
  const std::optional<std::int64_t> offset = offset_ns(row.time);
  if (!offset) return malformed_line("time is not milliseconds and a decimal fraction");
  if (row.type == "EV") return comment_line({});
  line.kind = CandumpLineKind::frame;
  line.frame.time_ns = start_ns_ + *offset;
  if (const char* why = set_bus(row.bus, line)) return malformed_line(why);
  if (const auto error = error_class(row.type, row.id, row.data)) {
    line.frame.error = true;
    line.frame.id = *error;
    return line;
  }
  // Versions 1.1 to 1.3 write the direction where 2.x writes the type.
  const bool is_old = version_[0] == '1';
  const std::string_view direction = is_old ? row.type : row.direction;
  const std::string_view type = is_old ? std::string_view{} : row.type;
  line.is_sent = equal_ignoring_case(direction, "tx");
  if (!line.is_sent && !direction.empty() && !equal_ignoring_case(direction, "rx")) {
    return malformed_line("direction is neither Rx nor Tx");
  }
  if (const char* why = read_identifier(row.id, line.frame)) return malformed_line(why);
  line.frame.remote = type == "RR" || row.data == "RTR";
  if (!line.frame.remote && !is_data_type(type)) return malformed_line("type is not a known one");
  line.frame.fd = !type.empty() && type != "DT" && type != "RR";
  if (line.frame.remote && line.frame.fd) return malformed_line("a remote frame is not CAN FD");
  const std::optional<std::uint32_t> length = decimal_number(row.length);
  const bool is_code = row.length_is_code;
  if (!length || *length > (is_code ? 15U : 64U)) return malformed_line("length is out of range");
  std::size_t count = *length;
  if (is_code) count = line.frame.fd ? fd_lengths[*length] : (*length < 8 ? *length : 8);
  if (!line.frame.fd && count > 8) return malformed_line("classic frame has more than 8 bytes");
  if (is_code && !line.frame.fd && *length > 8) line.raw_dlc = static_cast<std::uint8_t>(*length);
  if (line.frame.remote) {
    line.frame.length = static_cast<std::uint8_t>(count);
    return line;
  }
  if (const char* why = read_data(row.data, count, line.frame)) return malformed_line(why);
  return line;
}

/// A line that begins with ';'; `text` without it.
CandumpLine PeakTrcParser::comment(std::string_view text) {
  constexpr std::string_view version_key = "$FILEVERSION=", start_key = "$STARTTIME=",
                             columns_key = "$COLUMNS=", start_words = "start time:";
  if (starts_ignoring_case(text, version_key)) {
    version_ = trimmed(text.substr(version_key.size()));
  } else if (starts_ignoring_case(text, columns_key)) {
    columns_ = trimmed(text.substr(columns_key.size()));
  } else if (starts_ignoring_case(text, start_key)) {
    const auto start = trc_day_number_ns(trimmed(text.substr(start_key.size())));
    if (!start) return malformed_line("$STARTTIME is not a number of days");
    start_ns_ = *start;
    has_start_ = true;
  } else if (const std::string_view words = trimmed(text);
             !has_start_ && starts_ignoring_case(words, start_words)) {
    const auto start = trc_date_ns(trimmed(words.substr(start_words.size())));
    if (!start) return malformed_line("start time is not a date");
    start_ns_ = *start;
  }
  return comment_line(trimmed(text));
}

CandumpLine PeakTrcParser::line(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return comment_line({});
  if (text.front() == ';') return comment(text.substr(1));
  std::string_view rest = text;
  next_word(rest);
  // A converter leaves this line of its source between the rows.
  if (starts_ignoring_case(rest, "start of measurement")) return comment_line({});
  if (!is_digit(text.front())) return malformed_line("neither a row nor a comment");
  Row row;
  if (const char* why = read_columns(text, row)) return malformed_line(why);
  return frame_of(row);
}

}  // namespace ridgeline
