#include "core/bus/double_pairs.hpp"

namespace ridgeline {
namespace {

constexpr std::uint8_t relearn_count = 3;

DoubleOrder order_of(ValuePart first) {
  return first == ValuePart::high_half ? DoubleOrder::high_first : DoubleOrder::low_first;
}

/// Adjacent in code and time, complementary, from one sender: everything but the order.
bool is_candidate(const DoublePairs& pending, const DecodedValue& half, const BusFrame& frame,
                  const BusProfile& profile) {
  const auto next_code = static_cast<std::uint8_t>(pending.message_code + 1);
  const std::int64_t gap_ns = frame.time_ns - pending.time_ns;
  return pending.pending && pending.part != half.part && half.message.message_code == next_code &&
         half.message.node_id == pending.node_id && frame.interface == pending.interface &&
         gap_ns >= 0 && gap_ns <= profile.double_pair_limit_ns;
}

void remember(DoublePairs& pairs, const DecodedValue& half, const BusFrame& frame) {
  pairs.pending = true;
  pairs.part = half.part;
  pairs.half_bits = half.half_bits;
  pairs.message_code = half.message.message_code;
  pairs.node_id = half.message.node_id;
  pairs.interface = frame.interface;
  pairs.time_ns = frame.time_ns;
}

}  // namespace

DoublePairStep paired_double(const DoublePairs& previous, const DecodedValue& half,
                             const BusFrame& frame, const BusProfile& profile) {
  RL_ASSERT(half.part != ValuePart::whole);
  DoublePairStep step;
  step.next = previous;
  DoublePairs& next = step.next;
  const bool configured = profile.double_order != DoubleOrder::learned;
  if (configured) next.order = profile.double_order;

  if (is_candidate(previous, half, frame, profile)) {
    const DoubleOrder order = order_of(previous.part);
    if (next.order == DoubleOrder::learned) next.order = order;
    if (next.order == order) {
      const bool high_came_first = previous.part == ValuePart::high_half;
      step.value = high_came_first ? double_of_halves(previous.half_bits, half.half_bits)
                                   : double_of_halves(half.half_bits, previous.half_bits);
      next.pending = false;
      next.against_order = 0;
      return step;
    }
    ++next.against_order;
    if (next.against_order >= relearn_count && !configured) {
      next.order = DoubleOrder::learned;
      next.against_order = 0;
    }
  }
  step.unpaired = previous.pending;
  remember(next, half, frame);
  return step;
}

}  // namespace ridgeline
