#pragma once
#include <cstdint>

#include "config/arinc429_icd.hpp"
#include "core/base/result.hpp"
#include "core/bus/bus_profile.hpp"

namespace ridgeline {

/// One ARINC 429 word taken apart. Bits are numbered as on the wire: bit 1 is sent first and is the
/// lowest of `bits`, bit 32 is the parity.
struct Arinc429Word {
  std::uint32_t bits = 0;   ///< as received
  std::uint16_t label = 0;  ///< octal number, 0..0377
  std::uint8_t sdi = 0;     ///< bits 10, 9; data in words of 20 bits
  std::uint8_t ssm = 0;     ///< bits 31, 30
};

/// What the sender says of its word with the sign/status matrix.
enum class Arinc429Status : std::uint8_t {
  normal,
  minus,  ///< BCD: normal, and negative, south or west
  no_computed_data,
  functional_test,
  failure_warning,
};

/// Takes a word apart. Domain: odd parity over all 32 bits, else bus_parity: of a damaged word not
/// even the label can be believed.
[[nodiscard]] Result<Arinc429Word> arinc429_word(std::uint32_t bits, LabelOrder label_order);

/// What the two SSM bits mean in a word of this form; `ssm` 0..3. 11 is normal in BNR words, minus
/// in BCD words and a failure warning in discrete words; 00 is a failure warning, plus, and normal.
[[nodiscard]] Arinc429Status arinc429_status(Arinc429Form form, std::uint8_t ssm);

/// The fault a status stands for, or none.
[[nodiscard]] Fault fault_of_status(Arinc429Status status);

/// A BNR value: signed(bits 29..11) * range / 2^18; of the bits below the sign only the first
/// `significant_bits` count (1..18), those further down may be discretes.
[[nodiscard]] double bnr_value(std::uint32_t bits, double range, std::uint8_t significant_bits);

/// A BNR value of 20 bits and sign: signed(bits 29..9) * range / 2^20.
[[nodiscard]] double bnr20_value(std::uint32_t bits, double range);

/// The bits of a fine word, 0..2047, in units of 180 / 2^31 degree.
/// Domain: sign bit 29 clear, else bus_value_out_of_range: a fine word is never negative.
[[nodiscard]] Result<std::uint32_t> bnr_fine_units(std::uint32_t bits);

/// The digits of a BCD word as a number, 0..79999; the sign is the SSM's, the unit the label's.
/// Domain: digits 0..9, else bus_digit (a sender marks an unreliable one with 1111).
[[nodiscard]] Result<std::uint32_t> bcd_digits(std::uint32_t bits);

/// A BCD position in tenths of a minute, without sign. Domain: digits 0..9, else bus_digit; minutes
/// below 60, else bus_value_out_of_range.
[[nodiscard]] Result<std::uint32_t> bcd_position_units(std::uint32_t bits);

/// Seconds of the day of a UTC word. Domain: sign bit clear and a clock's values, else
/// bus_value_out_of_range.
[[nodiscard]] Result<double> utc_word_s(std::uint32_t bits);

/// Days since 1970 of a BCD date word; years 80..99 are 1980..1999, 00..79 are 2000..2079 (GNSS
/// time begins in 1980). Domain: digits 0..9, else bus_digit; a date, else bus_value_out_of_range.
[[nodiscard]] Result<double> date_word_days(std::uint32_t bits);

}  // namespace ridgeline
