#pragma once
#include <cstddef>
#include <cstdint>

#include "core/base/fixed_vector.hpp"
#include "core/base/result.hpp"
#include "core/bus/bus_profile.hpp"

namespace ridgeline {

/// One identifier that the display wants to see: data frames of exactly this kind, no others.
struct CanFilter {
  std::uint32_t id = 0;
  bool extended = false;
};

/// What Linux takes for one socket.
inline constexpr std::size_t can_filter_capacity = 512;
using CanFilters = FixedVector<CanFilter, can_filter_capacity>;

/// The identifiers that the configured protocol reads, from its own table, on the channels that are
/// read; with CANaerospace the node service requests as well.
/// Domain: at most can_filter_capacity identifiers, else Fault::capacity_exceeded.
[[nodiscard]] Result<CanFilters> can_filters(const BusProfile& profile);

}  // namespace ridgeline
