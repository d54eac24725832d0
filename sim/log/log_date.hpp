#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace ridgeline {

/// "Sam Sep 30 10:06:13.191 pm 2017" as Unix time, read as UTC; the weekday is not judged, am or pm
/// and the fraction of a second may be missing. Month names English or German.
[[nodiscard]] std::optional<std::int64_t> asc_date_ns(std::string_view text);

/// "18.12.2021 14:28:07.062.1" as Unix time, read as UTC: milliseconds, then further digits.
[[nodiscard]] std::optional<std::int64_t> trc_date_ns(std::string_view text);

/// Days since 1899-12-30 with a fraction ("44548.6028595139") as Unix time, rounded to 100 us: ten
/// decimals of a day resolve 9 us, and the programs that write them count in milliseconds.
[[nodiscard]] std::optional<std::int64_t> trc_day_number_ns(std::string_view text);

}  // namespace ridgeline
