#pragma once
#include <cstdint>
#include <span>

#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_profile.hpp"
#include "core/state/ownship_state.hpp"

namespace ridgeline {

/// Previous state + the frames received since + now -> state.
/// Frame:  times of frames and `now_ns` on one clock (log time, or kernel time of reception).
/// Domain: any frames; what is wrong with one is counted, never fatal. Frames should be in time
/// order; one older than
///         the value held is refused. `now_ns` more than future_tolerance_ns before the latest one
///         means a new clock: everything but the counters is forgotten.
/// Rules:  - Each parameter has its own age: no frame of another parameter, channel or source
/// renews it.
///         - One source at a time: another sender is refused until the held value is older than its
///         timeout.
///         - A value that is not finite or out of range makes its parameter `invalid` at once; the
///         next good one
///           makes it valid again. A frame of the wrong type or length says nothing about the
///           value.
///         - A fix of exactly 0 / 0 is `invalid`: receivers without a fix send it.
///         - A value further from the last good one than the limit rate x elapsed time + slack is
///         `implausible`
///           (limits_bus.hpp). It is believed after persist_count such values in a row that agree
///           with each other. Pitch above 75 degrees suspends the rule for roll and headings.
///         - A position changes only as a pair: latitude and longitude of one source, at most
///           fix_pair_limit_ns apart, each used once.
/// Cost:   O(frames); no allocation, no blocking.
[[nodiscard]] OwnshipState update_ownship(const OwnshipState& previous,
                                          std::span<const BusFrame> frames, std::int64_t now_ns,
                                          const BusProfile& profile);

}  // namespace ridgeline
