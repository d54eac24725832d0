#pragma once
#include <cstdint>

#include "config/bus_icd.hpp"

namespace ridgeline {

/// Who sent a value, whatever the protocol. Values of two sources are never mixed into one fix, and
/// can be compared.
struct Source {
  std::uint8_t interface = 0;  ///< BusFrame::interface
  /// Sender in the CANaerospace or CAN-FIX header, SDI of an ARINC 429 word; 0 where there is none.
  std::uint8_t node_id = 0;
  /// CANaerospace redundancy channel, ARINC 429 port, CAN-FIX index.
  std::uint16_t channel = 0;
  [[nodiscard]] bool operator==(const Source&) const = default;
};

/// One decoded value, the same for every protocol: within the range of its row in bus_icd, in its
/// unit, angles wrapped.
struct BusValue {
  BusParameter parameter{};
  double value = 0.0;
  std::int64_t time_ns = 0;  ///< of the frame that completed it
  Source source;
};

}  // namespace ridgeline
