#pragma once
#include <cstdint>
#include <optional>

#include "core/base/result.hpp"
#include "core/bus/bus_frame.hpp"

namespace ridgeline {

/// What this node says of itself on a CANaerospace bus.
struct CanasIdentity {
  std::uint8_t node_id = 1;  ///< 1..255; 0 is everybody
  std::uint8_t hardware_revision = 0;
  std::uint8_t software_revision = 0;
};

/// The answer to an identification request (IDS, service 0), which every node owes within 100 ms;
/// nothing where the frame asks nothing of this node. The answer has the request's time, message
/// code and interface, and says standard identifiers and header.
/// Domain: a classic data frame with id 128 (channel 0), exactly four bytes, type NODATA, service
/// 0, addressed to this node or to all; any other frame is not answered. Cost:   O(1); no
/// allocation. Who sends the answer is not this room's business. Source: CANaerospace v1.7,
/// sections 3.1 and 4.1: byte 0 of a service frame is the addressee; the answer carries the number
/// of the node that gives it, so that a broadcast is answered by name.
[[nodiscard]] std::optional<BusFrame> ids_reply(const BusFrame& request, const CanasIdentity& self);

/// The time stamp of a node synchronisation (NSS, service 1), in the units of its sender; nobody
/// answers it. It is no time of reception and ages nothing.
/// Domain: a classic data frame on a request channel (id 128 + 2c, c 0..35, or 2000 + 2c, c 0..15),
/// else bus_id_unknown; service 1, else bus_id_unknown; type ULONG, else bus_type_mismatch; eight
/// bytes, else bus_length. Error and remote frames: bus_not_data; CAN FD: bus_not_classic.
/// Source: CANaerospace v1.7, section 4.2.
[[nodiscard]] Result<std::uint32_t> nss_time_stamp(const BusFrame& frame);

}  // namespace ridgeline
