#pragma once
#include <cstdint>

#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_profile.hpp"
#include "tests/fuzz/input_bytes.hpp"

/// Profiles and frames out of the bytes of an input: most frames name something that the protocol's
/// table knows, so that few inputs are turned away at the door.
namespace ridgeline::fuzz {

/// What an installer may say of a bus of this protocol.
[[nodiscard]] BusProfile profile_from(InputBytes& input, BusProtocol protocol);

/// The time of a frame or update: a step from the time before, seldom backwards.
/// Units: ns, within what the log readers give.
[[nodiscard]] std::int64_t time_from(InputBytes& input, std::int64_t before_ns);

/// One frame at a time. Any kind, any length, any identifier can come.
[[nodiscard]] BusFrame frame_from(InputBytes& input, const BusProfile& profile,
                                  std::int64_t time_ns);

}  // namespace ridgeline::fuzz
