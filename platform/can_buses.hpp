#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "platform/can_socket.hpp"

namespace ridgeline {

/// One or two CAN interfaces as sources beside each other: what is wrong with one leaves the other
/// alone. BusFrame::interface tells their frames apart.
class CanBuses {
 public:
  static constexpr std::size_t capacity = 2;

  /// Opens one more interface. Domain: at most `capacity`, else Fault::capacity_exceeded; the
  /// faults of CanSocket::open(). Its index is the order of opening, whatever `settings` say.
  [[nodiscard]] Status open(const CanSettings& settings);

  /// What waits on all of them, in order of reception; valid until the next call.
  /// Faults are told per bus, by fault(). Cost: never blocks, never allocates.
  std::span<const ReceivedFrame> receive();
  /// What happened to a bus in the last receive().
  [[nodiscard]] Fault fault(std::size_t bus) const { return faults_[bus]; }
  [[nodiscard]] std::size_t size() const { return count_; }
  /// Domain: bus < size().
  [[nodiscard]] CanSocket& operator[](std::size_t bus);

 private:
  std::array<std::optional<CanSocket>, capacity> sockets_;
  std::array<Fault, capacity> faults_{};
  std::array<ReceivedFrame, capacity * CanBatch::capacity> merged_{};
  std::size_t count_ = 0;
};

}  // namespace ridgeline
