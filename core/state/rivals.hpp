#pragma once
#include <cstdint>
#include <optional>

#include "core/bus/bus_decoder.hpp"
#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_profile.hpp"
#include "core/state/ownship_state.hpp"

/// Several senders of one parameter: one is held, the others are compared with it.
namespace ridgeline {

/// What a parameter is compared as; nothing for those that the picture does not hang on.
[[nodiscard]] std::optional<Compared> compared_as(BusParameter parameter);

/// How many comparisons there are, and how many of them contradict.
struct Votes {
  int present = 0;
  int against = 0;
};
/// The senders besides the held one, at `now_ns`.
[[nodiscard]] Votes rival_votes(const OwnshipState& state, Compared what, std::int64_t now_ns);

/// Takes in a frame of another sender than the held one. It renews nothing; but where two others
/// agree with each other and both contradict the held one, one of them becomes the held one.
/// Domain: topic.source is not that of the held value.
void take_rival(OwnshipState& state, const BusFrame& frame, const FrameTopic& topic,
                const BusProfile& profile);

/// A sender that became the held one is no rival any more.
void forget_rival(OwnshipState& state, BusParameter parameter, const Source& held);

}  // namespace ridgeline
