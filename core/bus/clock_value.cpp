#include "core/bus/clock_value.hpp"

#include <array>

namespace ridgeline {

Result<double> second_of_day(std::uint32_t hour, std::uint32_t minute, std::uint32_t second) {
  // 60 is a leap second.
  if (hour > 23 || minute > 59 || second > 60) return Fault::bus_value_out_of_range;
  return 3600.0 * hour + 60.0 * minute + second;
}

Result<double> days_since_1970(std::uint32_t year, std::uint32_t month, std::uint32_t day) {
  constexpr std::array<std::uint8_t, 13> longest = {0,  31, 29, 31, 30, 31, 30,
                                                    31, 31, 30, 31, 30, 31};
  const bool plausible = year >= 1900 && year <= 2199 && month >= 1 && month <= 12 && day >= 1 &&
                         day <= longest[month];
  if (!plausible) return Fault::bus_value_out_of_range;
  // Counted from 1 March so that the leap day comes last.
  const auto shifted_year = static_cast<std::int32_t>(month > 2 ? year : year - 1);
  const auto shifted_month = static_cast<std::int32_t>(month > 2 ? month - 3 : month + 9);
  const std::int32_t year_days =
      365 * shifted_year + shifted_year / 4 - shifted_year / 100 + shifted_year / 400;
  const std::int32_t month_days = (153 * shifted_month + 2) / 5;
  constexpr std::int32_t days_to_1970 = 719468;
  return static_cast<double>(year_days + month_days + static_cast<std::int32_t>(day) - 1 -
                             days_to_1970);
}

}  // namespace ridgeline
