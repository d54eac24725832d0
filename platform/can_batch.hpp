#pragma once
#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bus/bus_frame.hpp"

namespace ridgeline {

/// A frame with both clocks. `frame.time_ns` is the kernel's time of reception (Unix epoch, may
/// step); `monotonic_ns` the same moment on the clock that never steps: ages are told by this one.
struct ReceivedFrame {
  BusFrame frame;
  std::int64_t monotonic_ns = 0;
  bool sent_here = false;  ///< by a program of this machine
};

struct BatchCounters {
  std::uint64_t frames = 0;
  std::uint64_t fd_frames = 0;
  std::uint64_t remote_frames = 0;
  std::uint64_t error_frames = 0;
  std::uint64_t malformed = 0;    ///< neither a whole classic frame nor a whole FD frame
  std::uint64_t not_stamped = 0;  ///< came without kernel time: that of reading was taken
  std::uint64_t dropped = 0;      ///< by the kernel, for want of room; known one frame later
};

/// Reads many frames with one system call into memory of its own. It reads any socket that keeps
/// message boundaries, so that tests can feed it without a CAN bus.
class CanBatch {
 public:
  static constexpr std::size_t capacity = 64;

  /// The frames that wait, at most `capacity`; valid until the next call.
  /// Returns 0 or errno, EAGAIN when none waits. Cost: never blocks, never allocates.
  int receive(int descriptor, std::uint8_t interface);
  [[nodiscard]] std::span<const ReceivedFrame> frames() const { return {frames_.data(), count_}; }
  [[nodiscard]] const BatchCounters& counters() const { return counters_; }
  /// The kernel's counter of drops starts anew with every socket.
  void forget_drops() { kernel_drops_ = 0; }

 private:
  static constexpr std::size_t control_bytes = 128;
  struct alignas(cmsghdr) Control {
    std::array<char, control_bytes> bytes;
  };

  void prepare();
  void take(std::size_t index, std::uint8_t interface);
  std::int64_t read_control(msghdr& header);

  std::array<mmsghdr, capacity> headers_{};
  std::array<iovec, capacity> vectors_{};
  std::array<canfd_frame, capacity> raw_{};
  std::array<Control, capacity> controls_{};
  std::array<ReceivedFrame, capacity> frames_{};
  std::size_t count_ = 0;
  BatchCounters counters_;
  std::uint32_t kernel_drops_ = 0;
  std::int64_t now_monotonic_ns_ = 0;
  std::int64_t now_real_ns_ = 0;
  std::int64_t earliest_ns_ = 0;  ///< when nothing waited last: no frame is older
};

/// Turns the kernel's frame into ours, or says false where its length makes no sense.
[[nodiscard]] bool bus_frame_from(const canfd_frame& raw, std::size_t size_bytes, BusFrame& frame);

/// CLOCK_MONOTONIC and CLOCK_REALTIME.
[[nodiscard]] std::int64_t monotonic_now_ns();
[[nodiscard]] std::int64_t real_now_ns();

}  // namespace ridgeline
