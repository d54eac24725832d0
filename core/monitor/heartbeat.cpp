#include "core/monitor/heartbeat.hpp"

namespace ridgeline {
namespace {

HeartbeatRefusal refusal_of(const Heartbeat& previous, const FrameProof& proof, std::int64_t now_ns,
                            std::int64_t input_limit_ns) {
  if (previous.has_beaten && proof.frame <= previous.last_frame) {
    return HeartbeatRefusal::frame_not_new;
  }
  if (!proof.fence_signalled) return HeartbeatRefusal::fence_missing;
  if (!proof.bound_computed) return HeartbeatRefusal::bound_missing;
  if (proof.finished_ns > proof.deadline_ns || proof.finished_ns > now_ns) {
    return HeartbeatRefusal::finished_late;
  }
  if (previous.has_beaten && proof.newest_input_ns <= previous.last_input_ns) {
    return HeartbeatRefusal::input_not_new;
  }
  if (proof.newest_input_ns > now_ns || now_ns - proof.newest_input_ns > input_limit_ns) {
    return HeartbeatRefusal::input_stale;
  }
  return HeartbeatRefusal::none;
}

}  // namespace

HeartbeatStep next_heartbeat(const Heartbeat& previous, const FrameProof& proof,
                             std::int64_t now_ns, std::int64_t input_limit_ns) {
  HeartbeatStep step{previous, refusal_of(previous, proof, now_ns, input_limit_ns)};
  ++step.next.refusals[static_cast<std::size_t>(step.refusal)];
  if (step.refusal != HeartbeatRefusal::none) return step;
  step.next.level = !previous.level;
  step.next.has_beaten = true;
  step.next.last_frame = proof.frame;
  step.next.last_input_ns = proof.newest_input_ns;
  ++step.next.edges;
  return step;
}

}  // namespace ridgeline
