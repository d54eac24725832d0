#include "core/bus/can_error.hpp"

namespace ridgeline {
namespace {

/// Classes in the identifier and details in data byte 1, as linux/can/error.h numbers them. They
/// are written to logs, so they are the same on every system.
enum ErrorClass : std::uint32_t {
  class_transmit_timeout = 0x001,
  class_lost_arbitration = 0x002,
  class_controller = 0x004,
  class_protocol = 0x008,
  class_transceiver = 0x010,
  class_acknowledge = 0x020,
  class_bus_off = 0x040,
  class_bus_error = 0x080,
  class_restarted = 0x100,
  class_counters = 0x200,
};
constexpr unsigned receive_overflow = 0x01, transmit_overflow = 0x02, warnings = 0x0c,
                   passives = 0x30, active = 0x40;

}  // namespace

Result<CanErrorReport> can_error_report(const BusFrame& frame) {
  if (!frame.error) return Fault::bus_not_error;
  if (frame.length != 8) return Fault::bus_length;
  const auto says = [&frame](ErrorClass bits) { return (frame.id & bits) != 0; };
  const unsigned details = says(class_controller) ? frame.data[1] : 0u;
  CanErrorReport report;
  report.transmit_timeout = says(class_transmit_timeout);
  report.lost_arbitration = says(class_lost_arbitration);
  report.receive_overflow = (details & receive_overflow) != 0;
  report.transmit_overflow = (details & transmit_overflow) != 0;
  report.warning = (details & warnings) != 0;
  report.passive = (details & passives) != 0;
  report.active_again = (details & active) != 0;
  report.protocol_violation = says(class_protocol);
  report.transceiver = says(class_transceiver);
  report.not_acknowledged = says(class_acknowledge);
  report.bus_off = says(class_bus_off);
  report.bus_error = says(class_bus_error);
  report.restarted = says(class_restarted);
  report.has_counters = says(class_counters);
  report.transmit_errors = report.has_counters ? frame.data[6] : std::uint8_t{0};
  report.receive_errors = report.has_counters ? frame.data[7] : std::uint8_t{0};
  return report;
}

CanController next_controller(CanController previous, const CanErrorReport& report) {
  if (report.bus_off) return CanController::bus_off;
  if (report.active_again || report.restarted) return CanController::active;
  if (previous == CanController::bus_off) return previous;
  if (report.passive) return CanController::passive;
  if (report.warning) return CanController::warning;
  return previous;
}

}  // namespace ridgeline
