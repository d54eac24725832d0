#pragma once
#include <array>
#include <cstdint>

namespace ridgeline {

/// One timestamped CAN frame as a reader (log or socket) delivers it. Trivially copyable.
struct BusFrame {
  std::int64_t time_ns = 0;    ///< log or kernel time of reception, Unix epoch
  std::uint32_t id = 0;        ///< 11- or 29-bit identifier, without flag bits
  bool extended = false;       ///< 29-bit identifier
  bool remote = false;         ///< remote transmission request: carries no data
  bool error = false;          ///< error frame: `id` holds the class bits, data the details
  bool fd = false;             ///< CAN FD frame
  std::uint8_t interface = 0;  ///< index of the interface in the order of first appearance
  std::uint8_t length = 0;     ///< data bytes that are valid, 0..64
  std::array<std::uint8_t, 64> data{};
};

}  // namespace ridgeline
