#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

/// What the readers of text logs share: words and numbers of one line.
namespace ridgeline::log_text {

[[nodiscard]] bool is_blank(char c);
[[nodiscard]] bool is_digit(char c);

/// The text without blanks, tabs and line ends at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The text up to the next blank, which is removed from `rest` together with the blanks after it.
std::string_view next_word(std::string_view& rest);

/// Whether two texts are the same but for the case of A to Z.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);
[[nodiscard]] bool starts_ignoring_case(std::string_view text, std::string_view start);

/// 0..15, or -1.
[[nodiscard]] int hex_digit(char c);

/// A number of 1 to 8 hexadecimal digits, or of 1 to 9 decimal ones; nothing else.
[[nodiscard]] std::optional<std::uint32_t> hex_number(std::string_view text);
[[nodiscard]] std::optional<std::uint32_t> decimal_number(std::string_view text);

/// "whole.fraction" with 1 to 10 whole digits, in units of 10^-9 of one; digits beyond are cut off.
/// Exact, without a detour over floating point.
/// Domain: whole part at most 9 223 372 035, else nothing.
[[nodiscard]] std::optional<std::int64_t> billionths(std::string_view text);

}  // namespace ridgeline::log_text
