#include "sim/log/candump_line.hpp"

#include <optional>

#include "config/arinc429_icd.hpp"
#include "sim/log/log_text.hpp"

namespace ridgeline {
namespace {

using log_text::decimal_number;
using log_text::hex_digit;
using log_text::hex_number;
using log_text::is_digit;
using log_text::next_word;
using log_text::trimmed;

constexpr std::string_view label_prefix = "ridgeline:";
constexpr std::string_view lost_prefix = "DROPCOUNT:";
constexpr std::size_t longest_interface = 15;
constexpr std::uint32_t error_flag = 0x20000000;
constexpr std::uint32_t extended_mask = 0x1fffffff;
constexpr std::uint32_t standard_mask = 0x7ff;
constexpr std::string_view word_interface = "429", word_prefix = "429.";

/// Reads pairs of hex digits, '.' allowed between them, into the frame; returns what follows the
/// last pair. A single digit is left over and found by the caller.
std::string_view read_bytes(std::string_view text, std::size_t most, BusFrame& frame) {
  while (frame.length < most && text.size() >= 2 && hex_digit(text[0]) >= 0 &&
         hex_digit(text[1]) >= 0) {
    frame.data[frame.length++] =
        static_cast<std::uint8_t>(hex_digit(text[0]) * 16 + hex_digit(text[1]));
    text.remove_prefix(2);
    const bool more = text.size() >= 3 && text[0] == '.' && frame.length < most;
    if (more) text.remove_prefix(1);
  }
  return text;
}

/// "_9".."_F", the raw DLC of a classic frame with 8 bytes, or nothing.
bool read_raw_dlc(std::string_view text, CandumpLine& line) {
  if (text.empty()) return true;
  if (text.size() != 2 || text[0] != '_' || line.frame.length != 8) return false;
  const int dlc = hex_digit(text[1]);
  if (dlc < 9) return false;
  line.raw_dlc = static_cast<std::uint8_t>(dlc);
  return true;
}

/// Identifier of 3 or 8 hex digits; nullptr when it is good, else why it is not.
const char* read_identifier(std::string_view text, BusFrame& frame) {
  const std::optional<std::uint32_t> id = hex_number(text);
  if (!id) return "identifier is not hexadecimal";
  if (text.size() == 3) {
    if (*id > standard_mask) return "11-bit identifier is above 7FF";
    frame.id = *id;
    return nullptr;
  }
  if (text.size() != 8) return "identifier has neither 3 nor 8 digits";
  if (*id > (error_flag | extended_mask)) return "29-bit identifier is above 1FFFFFFF";
  frame.error = (*id & error_flag) != 0;
  frame.extended = !frame.error;
  frame.id = *id & extended_mask;
  return nullptr;
}

/// "ff:sdt:af#": what follows the identifier of a CAN XL frame.
bool is_xl_body(std::string_view text) {
  return text.size() >= 15 && hex_number(text.substr(0, 2)) && text[2] == ':' &&
         hex_number(text.substr(3, 2)) && text[5] == ':' && hex_number(text.substr(6, 8)) &&
         text[14] == '#';
}

const char* read_fd_body(std::string_view text, CandumpLine& line) {
  line.frame.fd = true;
  if (line.frame.error) return "an error frame cannot be CAN FD";
  if (text.empty() || hex_digit(text[0]) < 0) return "CAN FD flags are missing";
  text = read_bytes(text.substr(1), 64, line.frame);
  return text.empty() ? nullptr : "data is not up to 64 hexadecimal bytes";
}

const char* read_remote_body(std::string_view text, CandumpLine& line) {
  line.frame.remote = true;
  if (line.frame.error) return "an error frame cannot be remote";
  if (!text.empty() && text[0] >= '0' && text[0] <= '8') {
    line.frame.length = static_cast<std::uint8_t>(text[0] - '0');
    text.remove_prefix(1);
  }
  return read_raw_dlc(text, line) ? nullptr : "remote length is not a digit 0..8";
}

const char* read_classic_body(std::string_view text, CandumpLine& line) {
  text = read_bytes(text, 8, line.frame);
  return read_raw_dlc(text, line) ? nullptr : "data is not up to 8 hexadecimal bytes";
}

/// Everything from the identifier on; nullptr when good, else why not.
const char* read_frame(std::string_view text, CandumpLine& line) {
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos) return "frame has no '#'";
  std::string_view body = text.substr(hash + 1);
  if (hash == 5 && hex_number(text.substr(0, 5)) && is_xl_body(body)) {
    line.kind = CandumpLineKind::xl_frame;
    return nullptr;
  }
  line.kind = CandumpLineKind::frame;
  if (const char* why = read_identifier(text.substr(0, hash), line.frame)) return why;
  if (!body.empty() && body[0] == '#') return read_fd_body(body.substr(1), line);
  if (!body.empty() && (body[0] == 'R' || body[0] == 'r')) {
    return read_remote_body(body.substr(1), line);
  }
  return read_classic_body(body, line);
}

/// An ARINC 429 word received on port `port`: eight hex digits, as the frame of the convention.
const char* read_word(std::string_view port, std::string_view text, CandumpLine& line) {
  const std::optional<std::uint32_t> number = decimal_number(port);
  if (!number || *number >= arinc429_port_count) return "port of a word is not 0..15";
  const std::optional<std::uint32_t> word = hex_number(text);
  if (!word || text.size() != 8) return "word is not eight hexadecimal digits";
  line.kind = CandumpLineKind::frame;
  line.interface = word_interface;
  line.frame.id = arinc429_default_id_base + *number;
  line.frame.extended = true;
  line.frame.length = 4;
  for (std::size_t byte = 0; byte < 4; ++byte) {
    line.frame.data[byte] = static_cast<std::uint8_t>(*word >> (24 - 8 * byte));
  }
  return nullptr;
}

CandumpLine frame_line(std::string_view rest) {
  const std::size_t close = rest.find(')');
  if (close == std::string_view::npos) return malformed_line("timestamp is not closed");
  const std::optional<std::int64_t> time_ns =
      log_text::billionths(trimmed(rest.substr(1, close - 1)));
  if (!time_ns) return malformed_line("timestamp is not seconds and a decimal fraction");
  rest = trimmed(rest.substr(close + 1));

  CandumpLine line;
  line.interface = next_word(rest);
  if (line.interface.empty()) return malformed_line("interface is missing");
  if (line.interface.size() > longest_interface) {
    return malformed_line("interface name is longer than 15 characters");
  }
  const std::string_view frame = next_word(rest);
  if (frame.empty()) return malformed_line("frame is missing");
  const bool is_word = line.interface.substr(0, word_prefix.size()) == word_prefix &&
                       frame.find('#') == std::string_view::npos;
  const char* why = is_word ? read_word(line.interface.substr(word_prefix.size()), frame, line)
                            : read_frame(frame, line);
  if (why != nullptr) return malformed_line(why);
  // The log form of CAN XL prints nothing else; what follows a frame that is skipped is not judged.
  if (line.kind == CandumpLineKind::xl_frame) return line;
  line.frame.time_ns = *time_ns;
  if (!rest.empty() && rest != "R" && rest != "T") {
    return malformed_line("text after the frame is neither R nor T");
  }
  line.is_sent = rest == "T";
  return line;
}

/// "DROPCOUNT: dropped N CAN frames on 'can0' socket (total drops M)".
CandumpLine lost_line(std::string_view text) {
  CandumpLine line;
  line.kind = CandumpLineKind::lost;
  std::string_view rest = trimmed(text.substr(lost_prefix.size()));
  constexpr std::uint64_t most_believed = 4'000'000'000;  // the kernel's counter has 32 bits
  if (next_word(rest) == "dropped") {
    for (const char c : next_word(rest)) {
      if (!is_digit(c) || line.lost_count > most_believed) break;
      line.lost_count = line.lost_count * 10 + static_cast<std::uint64_t>(c - '0');
    }
  }
  if (line.lost_count == 0) line.lost_count = 1;
  return line;
}

}  // namespace

CandumpLine malformed_line(std::string_view why) {
  CandumpLine line;
  line.kind = CandumpLineKind::malformed;
  line.text = why;
  return line;
}

CandumpLine comment_line(std::string_view text) {
  CandumpLine line;
  line.kind = CandumpLineKind::comment;
  if (text.substr(0, label_prefix.size()) == label_prefix) {
    line.kind = CandumpLineKind::label;
    line.text = trimmed(text.substr(label_prefix.size()));
  }
  return line;
}

CandumpLine candump_line(std::string_view text) {
  text = trimmed(text);
  CandumpLine line;
  line.kind = CandumpLineKind::comment;
  if (text.empty()) return line;
  if (text.front() == '(') return frame_line(text);
  if (text.substr(0, lost_prefix.size()) == lost_prefix) return lost_line(text);
  if (text.front() != '#') return malformed_line("neither a frame nor a comment");
  if (text.size() > 1 && text[1] != ' ') return line;
  return comment_line(text.size() > 1 ? text.substr(2) : text.substr(1));
}

}  // namespace ridgeline
