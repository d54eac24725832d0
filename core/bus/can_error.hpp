#pragma once
#include <cstdint>

#include "core/base/result.hpp"
#include "core/bus/bus_frame.hpp"

/// What a CAN controller says about itself: the error frames of SocketCAN.
namespace ridgeline {

/// How much a controller may still do on its bus.
enum class CanController : std::uint8_t { active, warning, passive, bus_off };

/// What one error frame reports; several at once are usual.
struct CanErrorReport {
  bool transmit_timeout = false;
  bool lost_arbitration = false;
  bool receive_overflow = false;  ///< the controller lost frames: they were never delivered
  bool transmit_overflow = false;
  bool warning = false;       ///< one of the error counters reached 96
  bool passive = false;       ///< one of them reached 128
  bool active_again = false;  ///< both fell below 96
  bool protocol_violation = false;
  bool transceiver = false;       ///< wire or transceiver
  bool not_acknowledged = false;  ///< nobody else is on the bus
  bool bus_off = false;           ///< the controller has left the bus
  bool bus_error = false;
  bool restarted = false;  ///< and is back
  bool has_counters = false;
  std::uint8_t transmit_errors = 0;  ///< valid with has_counters
  std::uint8_t receive_errors = 0;
};

/// Reads an error frame.
/// Domain: BusFrame::error with eight bytes, else Fault::bus_length; other frames:
///         Fault::bus_not_error.
/// Source: linux/can/error.h.
[[nodiscard]] Result<CanErrorReport> can_error_report(const BusFrame& frame);

/// State of a controller after one more report: the worst of what it says; bus-off is left only by
/// a restart or by being active again.
[[nodiscard]] CanController next_controller(CanController previous, const CanErrorReport& report);

}  // namespace ridgeline
