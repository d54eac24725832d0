#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "config/bus_icd.hpp"
#include "core/bus/bus_frame.hpp"

namespace ridgeline {

/// Header bytes of a CANaerospace message that are not its type.
struct CanasHeader {
  std::uint8_t node_id = 0;
  std::uint8_t service_code = 0;
  std::uint8_t message_code = 0;
};

/// A frame of a parameter on channel 0 as FLOAT (32-bit IEEE), in the unit of its row.
[[nodiscard]] BusFrame float_frame(BusParameter parameter, double value, std::int64_t time_ns,
                                   const CanasHeader& header);

/// A frame of a latitude or longitude as LONG, 1e-7 degree (1.1 cm on a meridian).
/// Domain: angle within -180..180 degrees; others are clamped.
[[nodiscard]] BusFrame position_frame(BusParameter parameter, double angle_deg,
                                      std::int64_t time_ns, const CanasHeader& header);

/// UTC of day (id 1200) and date (id 1206) of a Unix time, as CHAR4.
[[nodiscard]] BusFrame utc_frame(std::int64_t time_ns, const CanasHeader& header);
[[nodiscard]] BusFrame date_frame(std::int64_t time_ns, const CanasHeader& header);

/// One line of a `candump -L` log with microseconds, without the line end.
/// Domain: classic data frames.
[[nodiscard]] std::string candump_text(const BusFrame& frame, std::string_view interface);

}  // namespace ridgeline
