#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace ridgeline {

/// What a finished frame can show for itself. Times on one monotonic clock.
struct FrameProof {
  std::uint64_t frame = 0;           ///< number of the frame, ascending
  std::int64_t newest_input_ns = 0;  ///< reception of the newest bus value that it shows
  std::int64_t deadline_ns = 0;
  std::int64_t finished_ns = 0;
  bool bound_computed = false;   ///< its error bound was computed for it, not carried over
  bool fence_signalled = false;  ///< the GPU has finished it
};

/// Why a frame moves no heartbeat. In the order in which they are looked for.
enum class HeartbeatRefusal : std::uint8_t {
  none,
  frame_not_new,  ///< the same or an older frame again
  fence_missing,  ///< the GPU has not finished
  bound_missing,
  finished_late,  ///< or in the future
  input_not_new,  ///< no input newer than that of the last heartbeat
  input_stale,    ///< newer, but too old; or from the future
};
inline constexpr std::size_t heartbeat_refusal_count = 7;

/// The watchdog line as it should be, and why not more often.
struct Heartbeat {
  bool level = false;
  bool has_beaten = false;
  std::uint64_t last_frame = 0;
  std::int64_t last_input_ns = 0;
  std::uint64_t edges = 0;
  std::array<std::uint64_t, heartbeat_refusal_count> refusals{};  ///< by HeartbeatRefusal
};

struct HeartbeatStep {
  Heartbeat next;
  HeartbeatRefusal refusal = HeartbeatRefusal::none;
};

/// One edge for a frame that is proven new, none for any other: the watchdog wants edges, so a hung
/// renderer, a frozen input and a dead thread all end in silence.
/// Domain: now_ns is when the frame is judged; an input older than `input_limit_ns` then is stale.
[[nodiscard]] HeartbeatStep next_heartbeat(const Heartbeat& previous, const FrameProof& proof,
                                           std::int64_t now_ns, std::int64_t input_limit_ns);

}  // namespace ridgeline
