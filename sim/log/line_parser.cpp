#include "sim/log/line_parser.hpp"

#include <array>
#include <optional>

#include "sim/log/log_text.hpp"

namespace ridgeline {
namespace {

using log_text::equal_ignoring_case;
using log_text::is_digit;
using log_text::starts_ignoring_case;
using log_text::trimmed;

/// What one line says about the format; nothing where it could be a line of several.
std::optional<LogFormat> format_of_line(std::string_view line) {
  constexpr std::array<std::string_view, 6> asc_starts = {
      "date ", "base hex", "base dec", "//", "internal events logged", "begin triggerblock"};
  for (const std::string_view start : asc_starts) {
    if (starts_ignoring_case(line, start)) return LogFormat::vector_asc;
  }
  if (line.front() == ';') return LogFormat::peak_trc;
  if (line.front() == '(' || line.front() == '#') return LogFormat::candump;
  // Version 1.0 may have no header: its rows begin with a number and a bracket.
  std::size_t digits = 0;
  while (digits < line.size() && is_digit(line[digits])) ++digits;
  if (digits > 0 && digits < line.size() && line[digits] == ')') return LogFormat::peak_trc;
  return std::nullopt;
}

bool ends_with(std::string_view name, std::string_view end) {
  return name.size() >= end.size() &&
         equal_ignoring_case(name.substr(name.size() - end.size()), end);
}

}  // namespace

LogFormat log_format(std::string_view first_lines, std::string_view file_name) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (first_lines.substr(0, byte_order_mark.size()) == byte_order_mark) {
    first_lines.remove_prefix(byte_order_mark.size());
  }
  while (!first_lines.empty()) {
    const std::size_t end = first_lines.find('\n');
    const std::string_view line = trimmed(first_lines.substr(0, end));
    first_lines.remove_prefix(end == std::string_view::npos ? first_lines.size() : end + 1);
    if (line.empty()) continue;
    if (const std::optional<LogFormat> format = format_of_line(line)) return *format;
  }
  if (ends_with(file_name, ".asc")) return LogFormat::vector_asc;
  if (ends_with(file_name, ".trc")) return LogFormat::peak_trc;
  return LogFormat::candump;
}

LineParser::LineParser(LogFormat format) {
  if (format == LogFormat::vector_asc) parser_ = VectorAscParser{};
  if (format == LogFormat::peak_trc) parser_ = PeakTrcParser{};
}

CandumpLine LineParser::line(std::string_view text) {
  return std::visit([text](auto& parser) { return parser.line(text); }, parser_);
}

}  // namespace ridgeline
