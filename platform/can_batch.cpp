#include "platform/can_batch.hpp"

#include <time.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ridgeline {
namespace {

std::int64_t ns_of(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t clock_ns(clockid_t clock) {
  timespec time = {};
  ::clock_gettime(clock, &time);
  return ns_of(time);
}

}  // namespace

std::int64_t monotonic_now_ns() {
  return clock_ns(CLOCK_MONOTONIC);
}
std::int64_t real_now_ns() {
  return clock_ns(CLOCK_REALTIME);
}

bool bus_frame_from(const canfd_frame& raw, std::size_t size_bytes, BusFrame& frame) {
  // The size alone tells the two apart: the flags byte of a classic frame means nothing.
  const bool fd = size_bytes == CANFD_MTU;
  if (!fd && size_bytes != CAN_MTU) return false;
  if (raw.len > (fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return false;
  frame = BusFrame{};
  frame.fd = fd;
  frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
  frame.remote = !frame.error && (raw.can_id & CAN_RTR_FLAG) != 0;
  frame.extended = !frame.error && (raw.can_id & CAN_EFF_FLAG) != 0;
  const bool wide = frame.extended || frame.error;
  frame.id = raw.can_id & (wide ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.length = raw.len;
  if (!frame.remote) std::copy_n(raw.data, raw.len, frame.data.begin());
  return true;
}

void CanBatch::prepare() {
  // The kernel shortens these lengths to what it wrote: they are set before every call.
  for (std::size_t i = 0; i < capacity; ++i) {
    vectors_[i] = {&raw_[i], sizeof raw_[i]};
    headers_[i] = {};
    headers_[i].msg_hdr.msg_iov = &vectors_[i];
    headers_[i].msg_hdr.msg_iovlen = 1;
    headers_[i].msg_hdr.msg_control = controls_[i].bytes.data();
    headers_[i].msg_hdr.msg_controllen = control_bytes;
  }
}

std::int64_t CanBatch::read_control(msghdr& header) {
  std::int64_t stamp_ns = 0;
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec time = {};
      std::memcpy(&time, CMSG_DATA(part), sizeof time);
      stamp_ns = ns_of(time);
    } else if (part->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(part), sizeof drops);
      counters_.dropped += drops - kernel_drops_;  // unsigned: right across its wrap
      kernel_drops_ = drops;
    }
  }
  return stamp_ns;
}

void CanBatch::take(std::size_t index, std::uint8_t interface) {
  msghdr& header = headers_[index].msg_hdr;
  const std::int64_t stamp_ns = read_control(header);
  ReceivedFrame& received = frames_[count_];
  if ((header.msg_flags & MSG_TRUNC) != 0 ||
      !bus_frame_from(raw_[index], headers_[index].msg_len, received.frame)) {
    ++counters_.malformed;
    return;
  }
  // A stamp of 0 is none: it must not become an age of half a century.
  if (stamp_ns <= 0) ++counters_.not_stamped;
  received.frame.interface = interface;
  received.frame.time_ns = stamp_ns > 0 ? stamp_ns : now_real_ns_;
  received.sent_here = (header.msg_flags & MSG_DONTROUTE) != 0;
  // Where the wall clock was set meanwhile, the frame still came after the queue was last empty.
  received.monotonic_ns = std::clamp(received.frame.time_ns - now_real_ns_ + now_monotonic_ns_,
                                     std::min(earliest_ns_, now_monotonic_ns_), now_monotonic_ns_);
  ++count_;
  ++counters_.frames;
  counters_.fd_frames += received.frame.fd ? 1u : 0u;
  counters_.remote_frames += received.frame.remote ? 1u : 0u;
  counters_.error_frames += received.frame.error ? 1u : 0u;
}

int CanBatch::receive(int descriptor, std::uint8_t interface) {
  count_ = 0;
  prepare();
  const std::int64_t asked_ns = monotonic_now_ns();
  const int got = ::recvmmsg(descriptor, headers_.data(), capacity, MSG_DONTWAIT, nullptr);
  const int error = got < 0 ? errno : 0;
  now_monotonic_ns_ = monotonic_now_ns();
  now_real_ns_ = real_now_ns();
  const std::size_t taken = got > 0 ? static_cast<std::size_t>(got) : 0;
  for (std::size_t i = 0; i < taken; ++i) take(i, interface);
  if (taken < capacity && (error == 0 || error == EAGAIN)) earliest_ns_ = asked_ns;
  return error;
}

}  // namespace ridgeline
