#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "config/bus_icd.hpp"

/// What the display reads from a CAN-FIX bus (docs/icd.md): 11-bit identifier = parameter, bytes 0
/// node, 1 index, 2 function code, 3.. data, little-endian.
namespace ridgeline {

/// Data types of the parameters that are read.
enum class CanfixType : std::uint8_t {
  int16,    ///< INT
  uint16,   ///< UINT
  int32,    ///< DINT
  float32,  ///< FLOAT
  time,     ///< hour, minute, second as one byte each, then milliseconds as UINT
};

/// Data bytes of a type.
[[nodiscard]] constexpr std::uint8_t canfix_size_bytes(CanfixType type) {
  constexpr std::array<std::uint8_t, 5> sizes = {2, 2, 4, 4, 5};
  return sizes[static_cast<std::size_t>(type)];
}

/// Function code, byte 2: what the sender says of its value.
inline constexpr std::uint8_t canfix_quality_bit = 0x02;    ///< suspect
inline constexpr std::uint8_t canfix_failure_bit = 0x04;    ///< failed: not to be shown
inline constexpr std::uint8_t canfix_reserved_bit = 0x08;   ///< no meaning yet
inline constexpr std::uint8_t canfix_metadata_mask = 0xf0;  ///< not 0: a limit or mark, no value

/// One parameter on the bus.
struct CanfixRow {
  std::uint16_t id;
  BusParameter parameter;
  CanfixType type;
  double unit_per_step;  ///< of the parameter's unit in bus_icd
};

namespace canfix_detail {
using enum BusParameter;
using enum CanfixType;
inline constexpr double mps_per_kt = 1852.0 / 3600.0;
inline constexpr double mps_per_fpm = 0.3048 / 60.0;
inline constexpr double m_per_ft = 0.3048;
// clang-format off
inline constexpr std::array<CanfixRow, 16> rows = {{
  // id, parameter, type, unit per step
  {384, pitch, int16, 0.01},
  {385, roll, int16, 0.01},
  {387, indicated_airspeed, uint16, 0.1 * mps_per_kt},
  {389, magnetic_heading, uint16, 0.1},
  {390, altitude_rate, int16, mps_per_fpm},
  {397, true_airspeed, uint16, 0.1 * mps_per_kt},
  {398, calibrated_airspeed, uint16, 0.1 * mps_per_kt},
  {451, gps_latitude, float32, 1.0},
  {452, gps_longitude, float32, 1.0},
  {453, gps_ground_speed, uint16, 0.1 * mps_per_kt},
  {454, gps_true_track, uint16, 0.1},
  {1024, pitch_rate, int16, 0.1},
  {1025, roll_rate, int16, 0.1},
  {1026, yaw_rate, int16, 0.1},
  {1034, gps_height, int32, m_per_ft},
  {1408, utc, time, 1.0},
}};
// clang-format on

constexpr bool is_consistent() {
  for (std::size_t index = 1; index < rows.size(); ++index) {
    if (rows[index].id <= rows[index - 1].id) return false;
    for (std::size_t other = 0; other < index; ++other) {
      if (rows[index].parameter == rows[other].parameter) return false;
    }
  }
  return true;
}
static_assert(is_consistent(), "ascending ids, one a parameter");
}  // namespace canfix_detail

inline constexpr const std::array<CanfixRow, 16>& canfix_icd = canfix_detail::rows;

/// The row of an 11-bit identifier; nullptr where the display does not read it.
[[nodiscard]] constexpr const CanfixRow* canfix_row(std::uint32_t id) {
  for (const CanfixRow& row : canfix_icd) {
    if (row.id == id) return &row;
  }
  return nullptr;
}

}  // namespace ridgeline
