#pragma once
#include <cstdint>

#include "core/base/result.hpp"

namespace ridgeline {

/// Seconds of the day of a UTC clock. Domain: 0..23, 0..59, 0..60 (a leap second), else
/// bus_value_out_of_range.
[[nodiscard]] Result<double> second_of_day(std::uint32_t hour, std::uint32_t minute,
                                           std::uint32_t second);

/// Days since 1970-01-01 of a Gregorian date.
/// Domain: years 1900..2199, months 1..12, days 1..31 (29 and 30 as the month allows, leap years
/// not judged), else bus_value_out_of_range.
[[nodiscard]] Result<double> days_since_1970(std::uint32_t year, std::uint32_t month,
                                             std::uint32_t day);

}  // namespace ridgeline
