#include "core/bus/can_filters.hpp"

#include "config/bus_icd.hpp"
#include "config/canfix_icd.hpp"

namespace ridgeline {
namespace {

constexpr std::uint32_t node_service_request_id = 128;  ///< channel 0: IDS and NSS

void add_canaerospace(CanFilters& filters, const BusProfile& profile) {
  filters.push_back({node_service_request_id, false});
  for (std::uint32_t n = 0; n < profile.channel_count; ++n) {
    const std::uint32_t channel = profile.channel + n;
    const ChannelOffsets& offsets = profile.channel_offsets;
    if (offsets.count > 0 && channel >= offsets.count) return;
    const std::uint32_t offset = offsets.count > 0 ? offsets.offset[channel] : channel << 16;
    for (const BusIcdRow& row : bus_icd) filters.push_back({offset + row.id, offset != 0});
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
      for (const CanfixRow& row : canfix_icd) filters.push_back({row.id, false});
      break;
  }
  if (filters.refused_count() > 0) return Fault::capacity_exceeded;
  return filters;
}

}  // namespace ridgeline
