#pragma once
#include <cstdint>

#include "core/bus/bus_profile.hpp"
#include "core/state/ownship_state.hpp"

/// What is wrong with values that are fresh, in range and do not jump: the same bits for too long,
/// contradicted by another source or parameter, a clock that stepped, frames that were there
/// before. The rules, with their times: docs/icd.md, section 10. The policy: docs/adr/0017.
namespace ridgeline {

/// Compares a value that was just taken in with everything that can contradict it.
/// Domain: not for latitudes and longitudes. Cost: O(1); no allocation.
void note_value(OwnshipState& state, BusParameter parameter, const BusProfile& profile);
/// The same for a fix, of GPS or INS.
void note_fix(OwnshipState& state, bool is_gps);
/// A jump was believed because it persisted.
void note_jump(OwnshipState& state, std::int64_t time_ns);
/// A frame that was there before, or is older than it should be.
void note_replay(OwnshipState& state, std::int64_t time_ns);
/// The clock that ages are told by went back.
void note_clock_step(OwnshipState& state, std::int64_t time_ns);

/// What others say of a value.
enum class Doubt : std::uint8_t {
  none,
  excluded,   ///< not the value: one of those it is compared with contradicts it and the rest
  disagrees,  ///< contradicted, and none that is of equal weight agrees
  frozen,
};
[[nodiscard]] Doubt doubt_at(const OwnshipState& state, BusParameter parameter,
                             std::int64_t now_ns);

/// Events that are over but must be seen.
struct RecentEvents {
  bool clock_stepped = false;
  bool frames_replayed = false;
  bool jump_believed = false;
};
[[nodiscard]] RecentEvents recent_events(const OwnshipState& state, std::int64_t now_ns);

}  // namespace ridgeline
