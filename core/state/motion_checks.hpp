#pragma once
#include <cstdint>

#include "core/bus/bus_profile.hpp"
#include "core/state/ownship_state.hpp"

/// Parameters against each other by the laws of motion. Each takes in the newest sample of its
/// parameter; integrity.hpp says what follows.
namespace ridgeline {

/// A bank that stands still while the aircraft turns otherwise than that bank makes it.
void watch_roll(OwnshipState& state);
/// A pitch that stands still while the flight path angle changes.
void watch_pitch(OwnshipState& state);
/// A heading that stands still while the track turns.
void watch_heading(OwnshipState& state, BusParameter parameter);
/// Headings of different kinds against each other, by the signs and references of the profile.
void compare_headings(OwnshipState& state, std::int64_t time_ns, const BusProfile& profile);
/// A fix that stands still or leaves its own speed and track; GPS against INS.
void watch_fix(OwnshipState& state, bool is_gps);
/// A height that stands still, or leaves the altitude rate or the barometer; GPS against INS.
void watch_height(OwnshipState& state, bool is_gps);

}  // namespace ridgeline
