#include "sim/log/log_date.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <string>

#include "sim/log/log_text.hpp"

namespace ridgeline {
namespace {

using log_text::billionths;
using log_text::decimal_number;
using log_text::equal_ignoring_case;
using log_text::next_word;

constexpr std::int64_t second_ns = 1'000'000'000;

/// 1 to 12; German names as well, in UTF-8 and Latin-1.
std::optional<unsigned> month_of(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 5>, 12> names = {
      {{"jan"},
       {"feb"},
       {"mar", "m\xc3\xa4r", "m\xe4r", "mrz", "m\xc3\x84r"},
       {"apr"},
       {"may", "mai"},
       {"jun"},
       {"jul"},
       {"aug"},
       {"sep"},
       {"oct", "okt"},
       {"nov"},
       {"dec", "dez"}}};
  for (unsigned month = 0; month < names.size(); ++month) {
    for (const std::string_view known : names[month]) {
      if (!known.empty() && equal_ignoring_case(name, known)) return month + 1;
    }
  }
  return std::nullopt;
}

std::optional<std::int64_t> date_ns(unsigned year, unsigned month, unsigned day) {
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(month), std::chrono::day(day)};
  if (!date.ok() || year < 1970 || year > 2200) return std::nullopt;
  return std::int64_t{std::chrono::sys_days(date).time_since_epoch().count()} * 86400 * second_ns;
}

/// "14:28:07.062" as nanoseconds of the day.
std::optional<std::int64_t> clock_ns(std::string_view text) {
  const std::size_t first = text.find(':');
  const std::size_t second = text.find(':', first == std::string_view::npos ? first : first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return std::nullopt;
  const auto hour = decimal_number(text.substr(0, first));
  const auto minute = decimal_number(text.substr(first + 1, second - first - 1));
  const auto seconds_ns = billionths(text.substr(second + 1));
  if (!hour || !minute || !seconds_ns || *hour > 23 || *minute > 59) return std::nullopt;
  if (*seconds_ns >= 61 * second_ns) return std::nullopt;
  return (std::int64_t{*hour} * 3600 + *minute * 60) * second_ns + *seconds_ns;
}

}  // namespace

std::optional<std::int64_t> asc_date_ns(std::string_view text) {
  next_word(text);  // the weekday
  const std::optional<unsigned> month = month_of(next_word(text));
  const auto day = decimal_number(next_word(text));
  std::optional<std::int64_t> clock = clock_ns(next_word(text));
  std::string_view word = next_word(text);
  const bool is_am = equal_ignoring_case(word, "am"), is_pm = equal_ignoring_case(word, "pm");
  constexpr std::int64_t half_day_ns = 43200 * second_ns;
  if (clock && (is_am || is_pm)) {
    // Some writers put am or pm behind a clock of 24 hours.
    if (is_pm && *clock < half_day_ns) *clock += half_day_ns;
    if (is_am && *clock >= half_day_ns) *clock -= half_day_ns;
  }
  if (is_am || is_pm) word = next_word(text);
  const auto year = decimal_number(word);
  if (!month || !day || !clock || !year || !text.empty()) return std::nullopt;
  const auto midnight = date_ns(*year, *month, *day);
  if (!midnight) return std::nullopt;
  return *midnight + *clock;
}

std::optional<std::int64_t> trc_date_ns(std::string_view text) {
  const std::string_view date = next_word(text);
  const std::string_view time = next_word(text);
  const std::size_t first = date.find('.');
  const std::size_t second = date.find('.', first == std::string_view::npos ? first : first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return std::nullopt;
  const auto day = decimal_number(date.substr(0, first));
  const auto month = decimal_number(date.substr(first + 1, second - first - 1));
  const auto year = decimal_number(date.substr(second + 1));
  // The second point only parts digits of one fraction.
  std::string clock_text(time);
  const std::size_t point = clock_text.find('.');
  const std::size_t further = point == std::string::npos ? point : clock_text.find('.', point + 1);
  if (further != std::string::npos) clock_text.erase(further, 1);
  const auto clock = clock_ns(clock_text);
  if (!day || !month || !year || !clock) return std::nullopt;
  const auto midnight = date_ns(*year, *month, *day);
  if (!midnight) return std::nullopt;
  return *midnight + *clock;
}

std::optional<std::int64_t> trc_day_number_ns(std::string_view text) {
  constexpr std::int64_t day_of_1970 = 25569, last_day = 109'000;
  constexpr double units_per_day = 864'000'000.0;  // of 100 us
  const auto days = billionths(text);
  if (!days || *days < day_of_1970 * second_ns || *days > last_day * second_ns) {
    return std::nullopt;
  }
  // Nine decimals of a day resolve 86 us: all digits are needed.
  const std::size_t point = text.find('.');
  double fraction = 0.0;
  for (std::size_t at = text.size(); point != std::string_view::npos && at > point + 1; --at) {
    fraction = (fraction + (text[at - 1] - '0')) / 10.0;
  }
  const std::int64_t whole_days = *days / second_ns - day_of_1970;
  return whole_days * 86400 * second_ns + std::llround(fraction * units_per_day) * 100'000;
}

}  // namespace ridgeline
