#include "core/bus/arinc429_word.hpp"

#include <bit>

#include "core/bus/clock_value.hpp"

namespace ridgeline {
namespace {

constexpr int bnr_bits = 19, bnr20_bits = 21;

/// Bits `high`..`low` of a word, numbered from 1.
constexpr std::uint32_t field(std::uint32_t bits, int high, int low) {
  return bits >> (low - 1) & ((std::uint32_t{1} << (high - low + 1)) - 1);
}

/// Two's complement of `width` bits.
constexpr double signed_value(std::uint32_t field_bits, int width) {
  const auto value = static_cast<std::int32_t>(field_bits);
  const bool is_negative = (field_bits >> (width - 1) & 1U) != 0;
  return is_negative ? value - (std::int32_t{1} << width) : value;
}

/// Digits of four bits from bit `high` down; 10 or more is no digit and sticks out of the result.
struct Digits {
  std::uint32_t value = 0;
  bool are_good = true;
};
constexpr Digits with_digit(Digits digits, std::uint32_t digit) {
  return {digits.value * 10 + digit, digits.are_good && digit <= 9};
}

}  // namespace

Result<Arinc429Word> arinc429_word(std::uint32_t bits, LabelOrder label_order) {
  if (std::popcount(bits) % 2 == 0) return Fault::bus_parity;
  Arinc429Word word;
  word.bits = bits;
  std::uint32_t label = bits & 0xffU;
  if (label_order == LabelOrder::as_sent) {
    std::uint32_t turned = 0;
    for (int bit = 0; bit < 8; ++bit) turned |= (label >> bit & 1U) << (7 - bit);
    label = turned;
  }
  word.label = static_cast<std::uint16_t>(label);
  word.sdi = static_cast<std::uint8_t>(field(bits, 10, 9));
  word.ssm = static_cast<std::uint8_t>(field(bits, 31, 30));
  return word;
}

Arinc429Status arinc429_status(Arinc429Form form, std::uint8_t ssm) {
  RL_ASSERT(ssm <= 3);
  if (ssm == 1) return Arinc429Status::no_computed_data;
  if (ssm == 2) return Arinc429Status::functional_test;
  const bool is_set = ssm == 3;
  switch (form) {
    case Arinc429Form::bcd:
    case Arinc429Form::bcd_position:
    case Arinc429Form::date_word:
      return is_set ? Arinc429Status::minus : Arinc429Status::normal;
    case Arinc429Form::discrete:
      return is_set ? Arinc429Status::failure_warning : Arinc429Status::normal;
    case Arinc429Form::bnr:
    case Arinc429Form::bnr20:
    case Arinc429Form::bnr_fine:
    case Arinc429Form::utc_word:
      break;
  }
  return is_set ? Arinc429Status::normal : Arinc429Status::failure_warning;
}

Fault fault_of_status(Arinc429Status status) {
  switch (status) {
    case Arinc429Status::no_computed_data:
      return Fault::bus_no_computed_data;
    case Arinc429Status::functional_test:
      return Fault::bus_functional_test;
    case Arinc429Status::failure_warning:
      return Fault::bus_failure_warning;
    case Arinc429Status::normal:
    case Arinc429Status::minus:
      break;
  }
  return Fault::none;
}

double bnr_value(std::uint32_t bits, double range, std::uint8_t significant_bits) {
  RL_ASSERT(significant_bits >= 1 && significant_bits < bnr_bits);
  const std::uint32_t unused = (std::uint32_t{1} << (bnr_bits - 1 - significant_bits)) - 1;
  const std::uint32_t code = field(bits, 29, 11) & ~unused;
  return signed_value(code, bnr_bits) * range / (1 << (bnr_bits - 1));
}

double bnr20_value(std::uint32_t bits, double range) {
  return signed_value(field(bits, 29, 9), bnr20_bits) * range / (1 << (bnr20_bits - 1));
}

Result<std::uint32_t> bnr_fine_units(std::uint32_t bits) {
  if (field(bits, 29, 29) != 0) return Fault::bus_value_out_of_range;
  return field(bits, 28, 18);
}

Result<std::uint32_t> bcd_digits(std::uint32_t bits) {
  Digits digits = with_digit({}, field(bits, 29, 27));
  for (int high = 26; high > 11; high -= 4)
    digits = with_digit(digits, field(bits, high, high - 3));
  if (!digits.are_good) return Fault::bus_digit;
  return digits.value;
}

Result<std::uint32_t> bcd_position_units(std::uint32_t bits) {
  Digits degrees = with_digit({}, field(bits, 29, 29));
  degrees = with_digit(degrees, field(bits, 28, 25));
  degrees = with_digit(degrees, field(bits, 24, 21));
  Digits tenths;
  for (int high = 20; high > 9; high -= 4) tenths = with_digit(tenths, field(bits, high, high - 3));
  if (!degrees.are_good || !tenths.are_good) return Fault::bus_digit;
  if (tenths.value >= 600) return Fault::bus_value_out_of_range;
  return degrees.value * 600 + tenths.value;
}

Result<double> utc_word_s(std::uint32_t bits) {
  if (field(bits, 29, 29) != 0) return Fault::bus_value_out_of_range;
  return second_of_day(field(bits, 28, 24), field(bits, 23, 18), field(bits, 17, 12));
}

Result<double> date_word_days(std::uint32_t bits) {
  const Digits day = with_digit(with_digit({}, field(bits, 29, 28)), field(bits, 27, 24));
  const Digits month = with_digit(with_digit({}, field(bits, 23, 23)), field(bits, 22, 19));
  const Digits year = with_digit(with_digit({}, field(bits, 18, 15)), field(bits, 14, 11));
  if (!day.are_good || !month.are_good || !year.are_good) return Fault::bus_digit;
  return days_since_1970(year.value + (year.value >= 80 ? 1900 : 2000), month.value, day.value);
}

}  // namespace ridgeline
