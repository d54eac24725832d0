#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "config/limits_bus.hpp"

/// The bus interface control table: every parameter the display reads, and how CANaerospace carries
/// it (docs/icd.md). How the other protocols carry the same parameters: arinc429_icd.hpp and
/// canfix_icd.hpp.
/// Source: CANaerospace specification v1.7 (M. Stock), sections 2, 3, 5 and 7; free to cite and
/// use.
namespace ridgeline {

/// What is spoken on the bus. Configured, never guessed: the protocols use the same identifiers.
enum class BusProtocol : std::uint8_t { canaerospace, arinc429, canfix };

/// Data type codes of CANaerospace v1.7, section 2.2; 32-99 are reserved, 100-255 are user-defined.
enum class CanasType : std::uint8_t {
  no_data = 0,
  error = 1,
  float32 = 2,
  int32 = 3,
  uint32 = 4,
  bits32 = 5,
  int16 = 6,
  uint16 = 7,
  bits16 = 8,
  int8 = 9,
  uint8 = 10,
  bits8 = 11,
  short2 = 12,
  ushort2 = 13,
  bits16_2 = 14,
  char4 = 15,
  uchar4 = 16,
  bits8_4 = 17,
  char2 = 18,
  uchar2 = 19,
  bits8_2 = 20,
  memory_id = 21,
  checksum = 22,
  ascii1 = 23,
  ascii2 = 24,
  ascii4 = 25,
  char3 = 26,
  uchar3 = 27,
  bits8_3 = 28,
  ascii3 = 29,
  double_high = 30,
  double_low = 31,
};

/// Data bytes of each standard type code, by code.
inline constexpr std::array<std::uint8_t, 32> canas_type_size_bytes = {
    0, 4, 4, 4, 4, 4, 2, 2, 2, 1, 1, 1, 4, 4, 4, 4, 4, 4, 2, 2, 2, 4, 4, 1, 2, 4, 3, 3, 3, 3, 4, 4};
inline constexpr std::uint8_t canas_first_user_type = 100;

/// Every parameter the display reads; the index of its row in `bus_icd` and of its sample in
/// OwnshipState.
enum class BusParameter : std::uint8_t {
  pitch_rate,
  roll_rate,
  yaw_rate,
  pitch,
  roll,
  altitude_rate,
  indicated_airspeed,
  true_airspeed,
  calibrated_airspeed,
  heading,
  standard_altitude,
  gps_latitude,
  gps_longitude,
  gps_height,
  gps_ground_speed,
  gps_true_track,
  ins_latitude,
  ins_longitude,
  ins_height,
  ins_ground_speed,
  ins_true_track,
  magnetic_heading,
  radio_height,
  magnetic_variation,
  true_heading,
  utc,
  date,
};
inline constexpr std::size_t bus_parameter_count = 27;

/// Unit of a decoded value. Degrees of `wraps` rows are brought into [-180, 180).
enum class BusUnit : std::uint8_t { deg, deg_per_s, m, m_per_s, s_of_day, days_since_1970 };

/// One bit per accepted data type, for BusIcdRow::types.
[[nodiscard]] constexpr std::uint32_t type_bit(CanasType type) {
  return std::uint32_t{1} << static_cast<std::uint8_t>(type);
}

/// What kind of quantity a parameter is: how it is coded and what values the display accepts.
struct BusQuantity {
  BusUnit unit;          ///< unit of the decoded value
  std::uint32_t types;   ///< type_bit() of every accepted type
  CanasType field_type;  ///< what a frame without a header holds (profile `field`)
  double minimum;        ///< smallest accepted value, after wrapping
  double maximum;        ///< largest accepted value, after wrapping
  bool wraps;            ///< an angle that is wrapped on input
};

/// One parameter on the bus.
struct BusIcdRow {
  std::uint16_t id;         ///< 11-bit identifier on channel 0; channel n is 29-bit id + 65536 n
  BusParameter parameter;   ///< equals the index of the row
  std::string_view name;    ///< stable name in reports and docs/icd.md
  BusQuantity quantity;     ///< coding and range
  double rate_hz;           ///< scheduled rate (section 6.3), 0 where none is scheduled
  std::int64_t timeout_ns;  ///< age at which the value is stale
};

/// The quantities. Ranges are the display's domain, not a sensor's.
namespace icd_quantity {
using enum CanasType;
inline constexpr std::uint32_t analogue = type_bit(float32) | type_bit(short2);
inline constexpr std::uint32_t ins_types = type_bit(float32) | type_bit(int32);
/// GPS positions: FLOAT, a DOUBLEH/DOUBLEL pair, or LONG in 1e-7 degree as units in the field send
/// it. SHORT2 is in the standard's list but resolves 611 m: recognised, and refused by name.
inline constexpr std::uint32_t gps_types = ins_types | type_bit(double_high) | type_bit(double_low);

// clang-format off
inline constexpr BusQuantity body_rate{BusUnit::deg_per_s, analogue, float32, -720.0, 720.0, false};
inline constexpr BusQuantity pitch_angle{BusUnit::deg, analogue, float32, -90.0, 90.0, true};
inline constexpr BusQuantity angle{BusUnit::deg, analogue, float32, -180.0, 180.0, true};
inline constexpr BusQuantity height{BusUnit::m, analogue, float32, -1500.0, 30000.0, false};
inline constexpr BusQuantity radio{BusUnit::m, analogue, float32, -50.0, 10000.0, false};
inline constexpr BusQuantity climb{BusUnit::m_per_s, analogue, float32, -300.0, 300.0, false};
inline constexpr BusQuantity speed{BusUnit::m_per_s, analogue, float32, 0.0, 600.0, false};
inline constexpr BusQuantity gps_lat{BusUnit::deg, gps_types, int32, -90.0, 90.0, false};
inline constexpr BusQuantity gps_lon{BusUnit::deg, gps_types, int32, -180.0, 180.0, true};
inline constexpr BusQuantity ins_lat{BusUnit::deg, ins_types, int32, -90.0, 90.0, false};
inline constexpr BusQuantity ins_lon{BusUnit::deg, ins_types, int32, -180.0, 180.0, true};
inline constexpr BusQuantity clock{BusUnit::s_of_day, type_bit(char4), char4, 0.0, 86400.0, false};
inline constexpr BusQuantity day{BusUnit::days_since_1970, type_bit(char4), char4,
                                 -25567.0, 55000.0, false};
// clang-format on
}  // namespace icd_quantity

/// The table, in the order of BusParameter and of ascending identifier.
namespace icd_detail {
using enum BusParameter;
namespace q = icd_quantity;
namespace t = limits;
// clang-format off
inline constexpr std::array<BusIcdRow, bus_parameter_count> rows = {{
  // id, parameter, name, quantity, Hz, age at which it is stale
  {303, pitch_rate, "pitch_rate", q::body_rate, 80.0, t::air_data_timeout_ns},
  {304, roll_rate, "roll_rate", q::body_rate, 80.0, t::air_data_timeout_ns},
  {305, yaw_rate, "yaw_rate", q::body_rate, 80.0, t::air_data_timeout_ns},
  {311, pitch, "pitch", q::pitch_angle, 80.0, t::attitude_timeout_ns},
  {312, roll, "roll", q::angle, 80.0, t::attitude_timeout_ns},
  {314, altitude_rate, "altitude_rate", q::climb, 10.0, t::velocity_timeout_ns},
  {315, indicated_airspeed, "indicated_airspeed", q::speed, 0.0, t::air_data_timeout_ns},
  {316, true_airspeed, "true_airspeed", q::speed, 10.0, t::air_data_timeout_ns},
  {317, calibrated_airspeed, "calibrated_airspeed", q::speed, 10.0, t::air_data_timeout_ns},
  {321, heading, "heading", q::angle, 80.0, t::heading_timeout_ns},
  {322, standard_altitude, "standard_altitude", q::height, 10.0, t::height_timeout_ns},
  {1036, gps_latitude, "gps_latitude", q::gps_lat, 10.0, t::position_timeout_ns},
  {1037, gps_longitude, "gps_longitude", q::gps_lon, 10.0, t::position_timeout_ns},
  {1038, gps_height, "gps_height", q::height, 10.0, t::height_timeout_ns},
  {1039, gps_ground_speed, "gps_ground_speed", q::speed, 10.0, t::velocity_timeout_ns},
  {1040, gps_true_track, "gps_true_track", q::angle, 10.0, t::velocity_timeout_ns},
  {1049, ins_latitude, "ins_latitude", q::ins_lat, 0.0, t::position_timeout_ns},
  {1050, ins_longitude, "ins_longitude", q::ins_lon, 0.0, t::position_timeout_ns},
  {1051, ins_height, "ins_height", q::height, 0.0, t::height_timeout_ns},
  {1052, ins_ground_speed, "ins_ground_speed", q::speed, 0.0, t::velocity_timeout_ns},
  {1053, ins_true_track, "ins_true_track", q::angle, 0.0, t::velocity_timeout_ns},
  {1069, magnetic_heading, "magnetic_heading", q::angle, 0.0, t::heading_timeout_ns},
  {1070, radio_height, "radio_height", q::radio, 0.0, t::radio_height_timeout_ns},
  {1121, magnetic_variation, "magnetic_variation", q::angle, 0.0, t::variation_timeout_ns},
  {1133, true_heading, "true_heading", q::angle, 0.0, t::heading_timeout_ns},
  {1200, utc, "utc", q::clock, 0.0, t::clock_timeout_ns},
  {1206, date, "date", q::day, 0.0, t::clock_timeout_ns},
}};
// clang-format on
}  // namespace icd_detail

inline constexpr const std::array<BusIcdRow, bus_parameter_count>& bus_icd = icd_detail::rows;

namespace icd_detail {
constexpr bool icd_is_consistent() {
  for (std::size_t index = 0; index < bus_icd.size(); ++index) {
    if (static_cast<std::size_t>(bus_icd[index].parameter) != index) return false;
    if (index > 0 && bus_icd[index].id <= bus_icd[index - 1].id) return false;
  }
  return true;
}
static_assert(icd_is_consistent(), "rows are in the order of BusParameter and of ascending id");

constexpr bool only_gps_positions_come_in_halves() {
  constexpr std::uint32_t halves =
      type_bit(CanasType::double_high) | type_bit(CanasType::double_low);
  for (const BusIcdRow& row : bus_icd) {
    const bool is_gps_position =
        row.parameter == BusParameter::gps_latitude || row.parameter == BusParameter::gps_longitude;
    if (((row.quantity.types & halves) != 0) != is_gps_position) return false;
  }
  return true;
}
static_assert(only_gps_positions_come_in_halves(), "the decoder remembers halves of these two");
}  // namespace icd_detail

/// The row of a parameter.
[[nodiscard]] constexpr const BusIcdRow& icd_row(BusParameter parameter) {
  return bus_icd[static_cast<std::size_t>(parameter)];
}

}  // namespace ridgeline
