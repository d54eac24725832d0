#include "platform/can_buses.hpp"

#include <algorithm>
#include <utility>

namespace ridgeline {

Status CanBuses::open(const CanSettings& settings) {
  if (count_ == capacity) return Fault::capacity_exceeded;
  CanSettings mine = settings;
  mine.index = static_cast<std::uint8_t>(count_);
  Result<CanSocket> socket = CanSocket::open(mine);
  if (!socket) return socket.fault();
  sockets_[count_++] = std::move(socket).value();
  return {};
}

CanSocket& CanBuses::operator[](std::size_t bus) {
  RL_ASSERT(bus < count_);
  return *sockets_[bus];
}

std::span<const ReceivedFrame> CanBuses::receive() {
  std::array<std::span<const ReceivedFrame>, capacity> waiting;
  for (std::size_t bus = 0; bus < count_; ++bus) {
    faults_[bus] = sockets_[bus]->receive().fault();
    waiting[bus] = sockets_[bus]->frames();
  }
  const auto earlier = [](const ReceivedFrame& a, const ReceivedFrame& b) {
    return a.monotonic_ns < b.monotonic_ns;
  };
  const auto end = std::merge(waiting[0].begin(), waiting[0].end(), waiting[1].begin(),
                              waiting[1].end(), merged_.begin(), earlier);
  return {merged_.data(), static_cast<std::size_t>(end - merged_.begin())};
}

}  // namespace ridgeline
