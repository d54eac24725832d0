// Error frames of a CAN controller, and the state that they add up to. An input is frames of ten
// bytes: class bits (2), data (8).
#include "core/bus/can_error.hpp"

#include <algorithm>
#include <array>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

using ridgeline::BusFrame;
using ridgeline::CanController;
using ridgeline::CanErrorReport;
using ridgeline::Fault;
using ridgeline::Result;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

BusFrame error_frame(InputBytes& input) {
  BusFrame frame;
  const std::uint16_t head = input.u16();
  frame.error = (head & 0x8000U) == 0;
  frame.id = head & 0x7fffU;
  frame.length = (head & 0x4000U) == 0 ? 8 : static_cast<std::uint8_t>(input.below(9));
  const auto bytes = input.bytes(frame.length);
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

/// The report against the bits of linux/can/error.h, one by one.
void check_report(const CanErrorReport& report, const BusFrame& frame) {
  const std::array<bool, 8> classes = {report.transmit_timeout,   report.lost_arbitration,
                                       report.protocol_violation, report.transceiver,
                                       report.not_acknowledged,   report.bus_off,
                                       report.bus_error,          report.restarted};
  constexpr std::array<std::uint32_t, 8> bits = {0x1, 0x2, 0x8, 0x10, 0x20, 0x40, 0x80, 0x100};
  for (std::size_t index = 0; index < bits.size(); ++index) {
    must(classes[index] == ((frame.id & bits[index]) != 0), "a class is what its bit says");
  }
  const unsigned state = (frame.id & 0x4U) != 0 ? frame.data[1] : 0U;
  must(report.receive_overflow == ((state & 0x01U) != 0) &&
           report.transmit_overflow == ((state & 0x02U) != 0) &&
           report.warning == ((state & 0x0cU) != 0) && report.passive == ((state & 0x30U) != 0) &&
           report.active_again == ((state & 0x40U) != 0),
       "a controller's state is told by a controller's error only");
  const bool counts = (frame.id & 0x200U) != 0;
  must(report.has_counters == counts && report.transmit_errors == (counts ? frame.data[6] : 0) &&
           report.receive_errors == (counts ? frame.data[7] : 0),
       "counters are told when they are there");
}

void check_next(CanController before, CanController after, const CanErrorReport& report) {
  must(!report.bus_off || after == CanController::bus_off, "bus-off is believed");
  const bool is_back = report.active_again || report.restarted;
  must(before != CanController::bus_off || is_back || after == CanController::bus_off,
       "bus-off is left by a restart only");
  must(after >= before || is_back || report.passive || report.warning,
       "a controller gets better only when it says so");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  CanController controller = CanController::active;
  while (!input.empty()) {
    const BusFrame frame = error_frame(input);
    const Result<CanErrorReport> report = ridgeline::can_error_report(frame);
    if (!report) {
      must(report.fault() == (frame.error ? Fault::bus_length : Fault::bus_not_error),
           "a frame is refused for what is wrong with it");
      must(!frame.error || frame.length != 8, "a whole error frame is read");
      continue;
    }
    must(frame.error && frame.length == 8, "only whole error frames are read");
    check_report(report.value(), frame);
    const CanController next = ridgeline::next_controller(controller, report.value());
    check_next(controller, next, report.value());
    controller = next;
  }
  return 0;
}
