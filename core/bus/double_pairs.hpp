#pragma once
#include <cstdint>
#include <optional>

#include "core/bus/canaerospace.hpp"

namespace ridgeline {

/// What is remembered of one parameter whose values come as two frames. Trivially copyable.
struct DoublePairs {
  bool pending = false;                      ///< one half waits for the other
  ValuePart part{};                          ///< of the pending half
  std::uint32_t half_bits = 0;               ///< of the pending half
  std::uint8_t message_code = 0;             ///< of the pending half
  std::uint8_t node_id = 0;                  ///< of the pending half
  std::uint8_t interface = 0;                ///< of the pending half
  std::int64_t time_ns = 0;                  ///< of the pending half
  DoubleOrder order = DoubleOrder::learned;  ///< what the sender was seen to do
  std::uint8_t against_order = 0;            ///< candidates in a row that broke `order`
};

/// What one more half led to.
struct DoublePairStep {
  DoublePairs next;
  std::optional<double> value;  ///< the joined value, not yet range-checked
  bool unpaired = false;        ///< a half was given up without its partner
};

/// Joins the two halves of a DOUBLE. Both orders are accepted, but a half pairs only with the other
/// kind of half of the same sender and interface whose message code is the very next one, within
/// `double_pair_limit_ns`, and in the order the sender used before: after a lost frame the halves
/// of two different fixes also have adjacent codes, and only order and time tell them apart. The
/// order is learned from the first pair, or configured; three candidates against a learned order in
/// a row make it be learned anew. Domain: `half.part` is not `whole`, else RL_ASSERT. Cost:   O(1);
/// no allocation. Source: CANaerospace v1.7 gives neither order nor atomicity; the rule is ours
/// (docs/icd.md).
[[nodiscard]] DoublePairStep paired_double(const DoublePairs& previous, const DecodedValue& half,
                                           const BusFrame& frame, const BusProfile& profile);

}  // namespace ridgeline
