#include "core/bus/canas_services.hpp"

#include "config/bus_icd.hpp"

namespace ridgeline {
namespace {

constexpr std::uint32_t high_services = 128, high_services_end = 200;
constexpr std::uint32_t low_services = 2000, low_services_end = 2032;
constexpr std::uint8_t identification = 0, synchronisation = 1;
constexpr std::uint8_t broadcast = 0;
constexpr std::uint8_t header_bytes = 4;

bool is_classic_data(const BusFrame& frame) {
  return !frame.error && !frame.remote && !frame.fd;
}

/// Requests have even identifiers, each answered on the next one.
bool is_request_id(const BusFrame& frame) {
  const bool is_service = (frame.id >= high_services && frame.id < high_services_end) ||
                          (frame.id >= low_services && frame.id < low_services_end);
  return is_service && !frame.extended && frame.id % 2 == 0;
}

}  // namespace

std::optional<BusFrame> ids_reply(const BusFrame& request, const CanasIdentity& self) {
  const bool is_ids = is_classic_data(request) && !request.extended &&
                      request.id == high_services && request.length == header_bytes &&
                      request.data[1] == static_cast<std::uint8_t>(CanasType::no_data) &&
                      request.data[2] == identification;
  if (!is_ids || (request.data[0] != broadcast && request.data[0] != self.node_id)) {
    return std::nullopt;
  }
  BusFrame reply;
  reply.time_ns = request.time_ns;
  reply.id = request.id + 1;
  reply.interface = request.interface;
  reply.length = 8;
  constexpr std::uint8_t standard_identifiers = 0, standard_header = 0;
  reply.data = {self.node_id,           static_cast<std::uint8_t>(CanasType::uchar4),
                identification,         request.data[3],
                self.hardware_revision, self.software_revision,
                standard_identifiers,   standard_header};
  return reply;
}

Result<std::uint32_t> nss_time_stamp(const BusFrame& frame) {
  if (frame.error || frame.remote) return Fault::bus_not_data;
  if (frame.fd) return Fault::bus_not_classic;
  if (!is_request_id(frame)) return Fault::bus_id_unknown;
  if (frame.length < header_bytes) return Fault::bus_length;
  if (frame.data[2] != synchronisation) return Fault::bus_id_unknown;
  if (frame.data[1] != static_cast<std::uint8_t>(CanasType::uint32)) {
    return Fault::bus_type_mismatch;
  }
  if (frame.length != 8) return Fault::bus_length;
  return std::uint32_t{frame.data[4]} << 24 | std::uint32_t{frame.data[5]} << 16 |
         std::uint32_t{frame.data[6]} << 8 | std::uint32_t{frame.data[7]};
}

}  // namespace ridgeline
