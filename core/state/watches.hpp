#pragma once
#include <cstdint>

#include "core/bus/bus_value.hpp"

/// The small memories that integrity monitoring is made of: one condition that must last, two
/// values that must move together, one value that must not stand still. Pure: memory + what is
/// new -> memory.
namespace ridgeline {

/// How long a condition must last to be believed, and its absence to be believed again.
struct ConfirmRule {
  std::int64_t raise_ns = 0;
  std::int64_t clear_ns = 0;
};

/// A condition that counts only after it has lasted.
struct Confirmation {
  bool raised = false;
  bool pending = false;  ///< it is the other way round than `raised`, since `since_ns`
  std::int64_t since_ns = 0;
};
[[nodiscard]] Confirmation confirmed(const Confirmation& previous, bool present,
                                     std::int64_t time_ns, const ConfirmRule& rule);

/// How far two values that should move together may come apart.
struct DriftRule {
  double limit = 0.0;             ///< m; apart by more is a contradiction
  double forgiven_per_s = 0.0;    ///< m/s that are no contradiction, however long they last
  double forgiven_of_rate = 0.0;  ///< the same as a part of the rate of movement
  /// A contradiction stays until the two are together again; else it is forgiven in time as well.
  bool latches = false;
  ConfirmRule confirm;
};

/// By how much one value has moved more than another one, less what is forgiven.
struct DriftWatch {
  double east_m = 0.0;  ///< or height
  double north_m = 0.0;
  std::int64_t time_ns = 0;
  bool started = false;
  Confirmation contradiction;
};

/// Takes in that from the last call to `time_ns` one value moved `east_m`, `north_m` more than the
/// other. After a pause of more than limits::watch_restart_ns both begin anew, together.
/// Units:  m; `rate_mps` of movement.  Domain: `time_ns` not before the last one, else begun anew.
[[nodiscard]] DriftWatch drifted(const DriftWatch& previous, double east_m, double north_m,
                                 std::int64_t time_ns, double rate_mps, const DriftRule& rule);

/// Whether both values were there a moment ago (limits::watch_present_ns).
[[nodiscard]] bool is_present(const DriftWatch& watch, std::int64_t now_ns);
/// Whether they contradict each other; remembered for limits::contradiction_memory_ns after one of
/// them has fallen silent.
[[nodiscard]] bool contradicts(const DriftWatch& watch, std::int64_t now_ns);

/// One value that must not stand still while others say that it moves.
struct FreezeWatch {
  double value = 0.0;
  double second = 0.0;  ///< the longitude, for positions
  double other = 0.0;   ///< last reading of the value that tells of movement
  std::int64_t since_ns = 0;
  std::int64_t time_ns = 0;
  double moved = 0.0;  ///< what the others say that it has moved meanwhile
  bool started = false;
  bool raised = false;
};

/// How much the others must have moved while a value stood still, and how long it must have.
struct FreezeRule {
  double limit = 0.0;
  std::int64_t least_ns = 0;
};

/// Takes in a new sample. The same bits as before, for at least `least_ns`, while the others moved
/// by more than the limit: frozen, until the bits change. What moved earlier than about
/// limits::freeze_window_ns ago is forgotten.
[[nodiscard]] FreezeWatch stood_still(const FreezeWatch& previous, double value, double second,
                                      std::int64_t time_ns, double moved, const FreezeRule& rule);

/// What a message code says of its frame.
enum class Sequence : std::uint8_t {
  in_order,
  gap,         ///< frames are missing before it
  duplicate,   ///< the same code again
  behind,      ///< a code that was there before: replayed or reordered
  begun_anew,  ///< the sender counts from somewhere else, or no longer
};

/// The message codes of one identifier of one sender. Senders that do not count by one, or not at
/// all, are never judged.
struct SequenceWatch {
  Source source;
  std::uint8_t code = 0;        ///< of the last frame taken
  std::uint8_t counted = 0;     ///< steps of one in a row, up to limits::sequence_learn_count
  std::uint8_t other_code = 0;  ///< of the last frame refused
  std::uint8_t refused = 0;     ///< frames refused in a row that count among themselves
  bool started = false;
};
struct SequenceStep {
  SequenceWatch next;
  Sequence verdict = Sequence::in_order;
  std::uint8_t missing = 0;  ///< frames that a gap is long
};
[[nodiscard]] SequenceStep sequence_step(const SequenceWatch& previous, const Source& source,
                                         std::uint8_t code);

}  // namespace ridgeline
