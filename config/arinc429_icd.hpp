#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "config/bus_icd.hpp"

/// What the display reads from ARINC 429 words, and how they travel in CAN frames (docs/icd.md).
/// Labels are octal, as everywhere. A label means nothing without the equipment id of the port: 370
/// is the height of a GNSS receiver (00B) and the load factor of an inertial system (004).
namespace ridgeline {

/// Ports of one gateway; the frame of port n has identifier base + n.
inline constexpr std::uint8_t arinc429_port_count = 16;
/// First 29-bit identifier of the convention. Its low 16 bits are above every CANaerospace
/// identifier, so no frame can be taken for one on a redundancy channel.
inline constexpr std::uint32_t arinc429_default_id_base = 0x0a429000;

/// How the data bits of a word are coded.
enum class Arinc429Form : std::uint8_t {
  bnr,           ///< two's complement in bits 29..11
  bnr20,         ///< two's complement in bits 29..9: no SDI
  bnr_fine,      ///< the bits below a bnr20 position: bits 28..18, no sign
  bcd,           ///< digits of 3, 4, 4, 4, 4 bits from bit 29 down, sign in the SSM
  bcd_position,  ///< degrees of 1, 4, 4 and minutes of 4, 4, 4 bits (tenths) from bit 29 down to 9
  discrete,      ///< single bits
  utc_word,      ///< hour 28..24, minute 23..18, second 17..12
  date_word,     ///< BCD day 29..24, month 23..19, year of the century 18..11
};

/// One label of some kinds of equipment.
struct Arinc429Row {
  std::uint16_t label;            ///< octal label as a number, 0..0377
  BusParameter parameter;         ///< what it gives
  Arinc429Form form;              ///< coding
  double range;                   ///< full scale of a BNR word, in the label's own unit
  std::uint8_t significant_bits;  ///< of a BNR word below the sign; those further down are masked
  double unit_factor;             ///< from the label's unit to the parameter's
  std::array<std::uint16_t, 4> equipment;  ///< identifiers it holds for; 0: no further one
};

/// The table. Of several labels one kind of equipment sends for one parameter only one is read: a
/// source must not disagree with itself.
namespace arinc429_detail {
using enum BusParameter;
using enum Arinc429Form;
inline constexpr double one = 1.0;
inline constexpr double mps_per_kt = 1852.0 / 3600.0;
inline constexpr double mps_per_fpm = 0.3048 / 60.0;
inline constexpr double m_per_ft = 0.3048;
/// A fine word counts units of 180 / 2^31 degree below a coarse one of 180 / 2^20.
inline constexpr double fine_range_deg = 180.0 / 1048576.0;
// clang-format off
inline constexpr std::array<Arinc429Row, 27> rows = {{
  // label, parameter, form, range, significant bits, factor, equipment
  {0010, ins_latitude, bcd_position, 0.0, 20, one, {0x004}},
  {0011, ins_longitude, bcd_position, 0.0, 20, one, {0x004}},
  {0103, gps_true_track, bnr, 180.0, 18, one, {0x00b}},
  {0110, gps_latitude, bnr20, 180.0, 20, one, {0x004, 0x00b}},
  {0111, gps_longitude, bnr20, 180.0, 20, one, {0x004, 0x00b}},
  {0112, gps_ground_speed, bnr, 4096.0, 15, mps_per_kt, {0x00b}},
  {0120, gps_latitude, bnr_fine, fine_range_deg, 11, one, {0x004, 0x00b}},
  {0121, gps_longitude, bnr_fine, fine_range_deg, 11, one, {0x004, 0x00b}},
  {0150, utc, utc_word, 0.0, 17, one, {0x00b}},
  {0165, altitude_rate, bnr, 32768.0, 15, mps_per_fpm, {0x00b}},
  {0206, calibrated_airspeed, bnr, 1024.0, 14, mps_per_kt, {0x006, 0x038}},
  {0210, true_airspeed, bnr, 2048.0, 15, mps_per_kt, {0x006, 0x038}},
  {0212, altitude_rate, bnr, 32768.0, 11, mps_per_fpm, {0x006}},
  {0260, date, date_word, 0.0, 19, one, {0x00b}},
  {0310, ins_latitude, bnr20, 180.0, 20, one, {0x004, 0x038}},
  {0311, ins_longitude, bnr20, 180.0, 20, one, {0x004, 0x038}},
  {0312, ins_ground_speed, bnr, 4096.0, 15, mps_per_kt, {0x004, 0x038}},
  {0313, ins_true_track, bnr, 180.0, 15, one, {0x004, 0x038}},
  {0314, true_heading, bnr, 180.0, 15, one, {0x004, 0x038}},
  {0320, magnetic_heading, bnr, 180.0, 15, one, {0x004, 0x005, 0x038}},
  {0324, pitch, bnr, 180.0, 15, one, {0x004, 0x005, 0x038, 0x00b}},
  {0325, roll, bnr, 180.0, 15, one, {0x004, 0x005, 0x038, 0x00b}},
  {0326, pitch_rate, bnr, 128.0, 13, one, {0x004, 0x005, 0x038}},
  {0327, roll_rate, bnr, 128.0, 13, one, {0x004, 0x005, 0x038}},
  {0330, yaw_rate, bnr, 128.0, 13, one, {0x004, 0x005, 0x038}},
  {0365, altitude_rate, bnr, 32768.0, 15, mps_per_fpm, {0x004, 0x038}},
  {0370, gps_height, bnr20, 131072.0, 20, m_per_ft, {0x00b, 0x055}},
}};
// clang-format on

constexpr bool holds_for(const Arinc429Row& row, std::uint16_t equipment) {
  for (const std::uint16_t known : row.equipment) {
    if (known != 0 && known == equipment) return true;
  }
  return false;
}

/// A source that could disagree with itself: one equipment, one parameter, two complete words.
/// BCD positions are in the table to be refused by name and give no value.
constexpr bool is_complete(const Arinc429Row& row) {
  return row.form != Arinc429Form::bnr_fine && row.form != Arinc429Form::bcd_position;
}

constexpr bool is_consistent() {
  for (std::size_t index = 0; index < rows.size(); ++index) {
    if (rows[index].label > 0377) return false;
    if (index > 0 && rows[index].label <= rows[index - 1].label) return false;
    for (std::size_t other = 0; other < index; ++other) {
      if (rows[index].parameter != rows[other].parameter) continue;
      if (!is_complete(rows[index]) || !is_complete(rows[other])) continue;
      for (const std::uint16_t equipment : rows[index].equipment) {
        if (holds_for(rows[other], equipment)) return false;
      }
    }
  }
  return true;
}
static_assert(is_consistent(), "ascending labels, one label a parameter of an equipment");
}  // namespace arinc429_detail

inline constexpr const std::array<Arinc429Row, 27>& arinc429_icd = arinc429_detail::rows;

/// The row of a label sent by an equipment; nullptr where the display reads nothing from it.
[[nodiscard]] constexpr const Arinc429Row* arinc429_row(std::uint16_t label,
                                                        std::uint16_t equipment) {
  for (const Arinc429Row& row : arinc429_icd) {
    if (row.label == label && arinc429_detail::holds_for(row, equipment)) return &row;
  }
  return nullptr;
}

}  // namespace ridgeline
