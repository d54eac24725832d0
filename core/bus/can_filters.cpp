#include "core/bus/can_filters.hpp"

#include "core/bus/canaerospace.hpp"
#include "core/bus/canfix.hpp"

namespace ridgeline {
namespace {

constexpr std::uint32_t standard_id_count = 2048;
constexpr std::uint32_t node_service_request_id = 128;  ///< channel 0: IDS and NSS

BusFrame standard_frame(std::uint32_t id) {
  BusFrame frame;
  frame.id = id;
  frame.length = 8;
  return frame;
}

void add_canaerospace(CanFilters& filters, const BusProfile& profile) {
  filters.push_back({node_service_request_id, false});
  for (std::uint32_t n = 0; n < profile.channel_count; ++n) {
    const std::uint32_t channel = profile.channel + n;
    const ChannelOffsets& offsets = profile.channel_offsets;
    if (offsets.count > 0 && channel >= offsets.count) return;
    const std::uint32_t offset = offsets.count > 0 ? offsets.offset[channel] : channel << 16;
    for (std::uint32_t id = 0; id < standard_id_count; ++id) {
      if (icd_row_of(standard_frame(id)) != nullptr) filters.push_back({offset + id, offset != 0});
    }
  }
}

}  // namespace

Result<CanFilters> can_filters(const BusProfile& profile) {
  CanFilters filters;
  switch (profile.protocol) {
    case BusProtocol::canaerospace:
      add_canaerospace(filters, profile);
      break;
    case BusProtocol::arinc429:
      for (std::uint32_t port = 0; port < arinc429_port_count; ++port) {
        if (profile.arinc429.ports[port].equipment == 0) continue;
        filters.push_back({profile.arinc429.id_base + port, true});
      }
      break;
    case BusProtocol::canfix:
      for (std::uint32_t id = 0; id < standard_id_count; ++id) {
        if (canfix_row_of(standard_frame(id)) != nullptr) filters.push_back({id, false});
      }
      break;
  }
  if (filters.refused_count() > 0) return Fault::capacity_exceeded;
  return filters;
}

}  // namespace ridgeline
