#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "config/bus_icd.hpp"
#include "core/bus/bus_decoder.hpp"
#include "core/state/integrity_state.hpp"

namespace ridgeline {

/// What a value is good for. A stored sample is never `stale`, `frozen`, `disagrees` or
/// `reference_unknown`: these depend on the time and the profile of asking, and are answered by
/// validity_at() and ownship_pose().
enum class Validity : std::uint8_t {
  missing,            ///< never received
  valid,              ///< received, plausible
  stale,              ///< last good value is older than its limit
  implausible,        ///< the newest value jumped away from the last good one
  invalid,            ///< the newest value was not finite or out of range
  reference_unknown,  ///< a heading whose reference (true or magnetic) cannot be told
  frozen,             ///< the same bits while others say that it moves
  disagrees,          ///< another source, or another parameter, contradicts it
};

/// One value with its own age, validity and source. `value` and `time_ns` are those of the last
/// good frame of this parameter, whatever else was received since.
struct Sample {
  double value = 0.0;
  std::int64_t time_ns = 0;
  Validity validity = Validity::missing;
  Source source;
};

/// A jump that is not believed yet: the newest refused values, as long as they agree with each
/// other.
struct JumpCandidate {
  double value = 0.0;   ///< or the latitude
  double second = 0.0;  ///< the longitude, for positions
  std::int64_t time_ns = 0;
  std::uint8_t count = 0;
};

/// Every frame handed in raises exactly one of the first group; the second counts consequences.
struct UpdateCounters {
  std::uint32_t frames = 0;         ///< handed in
  std::uint32_t decoded = 0;        ///< became a value, or half of one
  std::uint32_t ignored = 0;        ///< identifier not read by the display
  std::uint32_t not_data = 0;       ///< error, remote and CAN FD frames
  std::uint32_t other_channel = 0;  ///< redundancy channel, or index, that is not read
  std::uint32_t other_source = 0;   ///< second sender while the first one is fresh: compared
  std::uint32_t bad_length = 0;
  /// Also reserved types, positions coded too coarsely, heights without a datum.
  std::uint32_t type_mismatch = 0;
  std::uint32_t out_of_range = 0;
  std::uint32_t not_finite = 0;
  std::uint32_t bad_parity = 0;
  std::uint32_t no_computed_data = 0;  ///< the sender says so
  std::uint32_t functional_test = 0;   ///< the sender says so
  std::uint32_t failure_warning = 0;   ///< the sender says so
  std::uint32_t suspect = 0;           ///< quality bits, unreliable digits
  std::uint32_t unpaired_words = 0;    ///< second words without their first
  std::uint32_t implausible = 0;       ///< jumped, refused
  std::uint32_t out_of_order = 0;      ///< older than what is held
  std::uint32_t from_future = 0;       ///< later than `now` by more than the tolerance
  std::uint32_t duplicated = 0;        ///< the message code of the frame before it
  std::uint32_t replayed = 0;          ///< a message code that was there before

  std::uint32_t unpaired_halves = 0;   ///< halves of a DOUBLE and coarse words given up
  std::uint32_t unpaired_fixes = 0;    ///< latitudes or longitudes given up
  std::uint32_t jumps_believed = 0;    ///< jumps that persisted
  std::uint32_t source_changes = 0;    ///< parameters taken over by another sender
  std::uint32_t clock_resets = 0;      ///< `now` went back: everything was forgotten
  std::uint32_t clock_steps = 0;       ///< UTC on the bus and times of reception came apart
  std::uint32_t replay_bursts = 0;     ///< times too many frames were there before
  std::uint32_t lost_in_sequence = 0;  ///< frames missing by their message codes
  std::uint32_t disagreements = 0;     ///< times two sources began to contradict each other
  std::uint32_t freezes = 0;           ///< times a value was found to stand still
  std::uint32_t outvoted = 0;          ///< sources left because two others agreed against them
};

/// The ownship as the bus describes it. Trivially copyable; about 12 KiB.
/// The samples of a latitude and its longitude always belong to one fix: one source, times within
/// BusProfile::fix_pair_limit_ns; they change together or not at all.
struct OwnshipState {
  std::array<Sample, bus_parameter_count> samples{};
  std::array<JumpCandidate, bus_parameter_count> candidates{};
  /// Time of the newest refused value (implausible or invalid), per parameter.
  std::array<std::int64_t, bus_parameter_count> refused_time_ns{};
  PositionPairing gps;
  PositionPairing ins;
  DecoderMemory decoder;
  IntegrityState integrity;
  std::int64_t now_ns = 0;  ///< of the last update
  UpdateCounters counters;

  [[nodiscard]] const Sample& operator[](BusParameter parameter) const {
    return samples[static_cast<std::size_t>(parameter)];
  }
};

/// Age of a sample, never negative. Domain: sample not `missing`.
[[nodiscard]] constexpr std::int64_t age_ns(const Sample& sample, std::int64_t now_ns) {
  return now_ns > sample.time_ns ? now_ns - sample.time_ns : 0;
}

/// What the frames of a parameter themselves say of it at `now_ns`: a refused value counts as long
/// as it is younger than `timeout_ns`, a good one as well; after that the parameter is stale. Only
/// frames of this parameter keep it alive.
[[nodiscard]] Validity own_validity_at(const OwnshipState& state, BusParameter parameter,
                                       std::int64_t now_ns, std::int64_t timeout_ns);

/// The same; and where that is `valid`, whether others contradict it (integrity.hpp).
[[nodiscard]] Validity validity_at(const OwnshipState& state, BusParameter parameter,
                                   std::int64_t now_ns, std::int64_t timeout_ns);

}  // namespace ridgeline
