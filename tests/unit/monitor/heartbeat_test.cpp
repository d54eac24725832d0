#include "core/monitor/heartbeat.hpp"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

constexpr std::int64_t now_ns = 1000, input_limit_ns = 300;

FrameProof good_proof(std::uint64_t frame = 1, std::int64_t input_ns = 900) {
  return {frame, input_ns, 1010, 1000, true, true};
}

HeartbeatRefusal refusal(const FrameProof& proof, const Heartbeat& previous = {}) {
  const HeartbeatStep step = next_heartbeat(previous, proof, now_ns, input_limit_ns);
  const bool moved = step.next.level != previous.level;
  EXPECT_EQ(moved, step.refusal == HeartbeatRefusal::none);
  EXPECT_EQ(step.next.edges, previous.edges + (moved ? 1u : 0u));
  EXPECT_EQ(step.next.refusals[static_cast<std::size_t>(step.refusal)],
            previous.refusals[static_cast<std::size_t>(step.refusal)] + 1);
  return step.refusal;
}

TEST(Heartbeat, moves_once_for_every_frame_proven_new) {
  Heartbeat beat;
  for (std::uint64_t frame = 1; frame <= 5; ++frame) {
    const FrameProof proof = good_proof(frame, 900 + static_cast<std::int64_t>(frame));
    beat = next_heartbeat(beat, proof, now_ns, input_limit_ns).next;
    EXPECT_EQ(beat.level, frame % 2 == 1);
  }
  EXPECT_EQ(beat.edges, 5u);
}

TEST(Heartbeat, each_missing_proof_alone_keeps_it_still) {
  EXPECT_EQ(refusal(good_proof()), HeartbeatRefusal::none);
  FrameProof proof = good_proof();
  proof.fence_signalled = false;
  EXPECT_EQ(refusal(proof), HeartbeatRefusal::fence_missing);
  proof = good_proof();
  proof.bound_computed = false;
  EXPECT_EQ(refusal(proof), HeartbeatRefusal::bound_missing);
  proof = good_proof();
  proof.deadline_ns = 999;
  EXPECT_EQ(refusal(proof), HeartbeatRefusal::finished_late);
  proof = good_proof();
  proof.finished_ns = 1001;  // not yet
  EXPECT_EQ(refusal(proof), HeartbeatRefusal::finished_late);
  EXPECT_EQ(refusal(good_proof(1, 699)), HeartbeatRefusal::input_stale);
  EXPECT_EQ(refusal(good_proof(1, 700)), HeartbeatRefusal::none);
  EXPECT_EQ(refusal(good_proof(1, 1001)), HeartbeatRefusal::input_stale);
}

TEST(Heartbeat, a_repeated_frame_or_a_frozen_input_keeps_it_still) {
  const Heartbeat beat = next_heartbeat({}, good_proof(7), now_ns, input_limit_ns).next;
  EXPECT_EQ(refusal(good_proof(7, 950), beat), HeartbeatRefusal::frame_not_new);
  EXPECT_EQ(refusal(good_proof(6, 950), beat), HeartbeatRefusal::frame_not_new);
  EXPECT_EQ(refusal(good_proof(8, 900), beat), HeartbeatRefusal::input_not_new);
  EXPECT_EQ(refusal(good_proof(8, 901), beat), HeartbeatRefusal::none);
}

}  // namespace
}  // namespace ridgeline
