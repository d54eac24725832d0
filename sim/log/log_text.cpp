#include "sim/log/log_text.hpp"

#include <cstddef>

namespace ridgeline::log_text {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view next_word(std::string_view& rest) {
  std::size_t length = 0;
  while (length < rest.size() && !is_blank(rest[length])) ++length;
  const std::string_view word = rest.substr(0, length);
  rest.remove_prefix(length);
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  return word;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t index = 0; index < a.size(); ++index) {
    if (lower(a[index]) != lower(b[index])) return false;
  }
  return true;
}

bool starts_ignoring_case(std::string_view text, std::string_view start) {
  return equal_ignoring_case(text.substr(0, start.size()), start);
}

int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::uint32_t> hex_number(std::string_view text) {
  if (text.empty() || text.size() > 8) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : text) {
    if (hex_digit(c) < 0) return std::nullopt;
    value = value << 4 | static_cast<std::uint32_t>(hex_digit(c));
  }
  return value;
}

std::optional<std::uint32_t> decimal_number(std::string_view text) {
  if (text.empty() || text.size() > 9) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : text) {
    if (!is_digit(c)) return std::nullopt;
    value = value * 10 + static_cast<std::uint32_t>(c - '0');
  }
  return value;
}

std::optional<std::int64_t> billionths(std::string_view text) {
  constexpr std::size_t most_whole_digits = 10;  // last_whole has as many
  constexpr int fraction_digits = 9;
  std::int64_t whole = 0;
  std::size_t at = 0;
  for (; at < text.size() && is_digit(text[at]); ++at) {
    if (at >= most_whole_digits) return std::nullopt;
    whole = whole * 10 + (text[at] - '0');
  }
  constexpr std::int64_t last_whole = 9'223'372'035;
  if (at == 0 || whole > last_whole) return std::nullopt;
  std::int64_t fraction = 0;
  int digits = 0;
  if (at < text.size()) {
    if (text[at] != '.' || at + 1 == text.size()) return std::nullopt;
    for (++at; at < text.size(); ++at) {
      if (!is_digit(text[at])) return std::nullopt;
      if (digits == fraction_digits) continue;
      fraction = fraction * 10 + (text[at] - '0');
      ++digits;
    }
  }
  for (; digits < fraction_digits; ++digits) fraction *= 10;
  return whole * 1'000'000'000 + fraction;
}

}  // namespace ridgeline::log_text
