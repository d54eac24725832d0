#pragma once
#include <cstdint>

#include "core/bus/bus_profile.hpp"
#include "core/bus/canas_services.hpp"
#include "platform/can_buses.hpp"
#include "platform/display/display_config.hpp"
#include "platform/display/exchange.hpp"

namespace ridgeline {

/// Reads the buses and keeps the ownship: frames in, the newest state out.
class BusThread {
 public:
  BusThread(const DisplayConfig& config, Exchange& exchange);

  /// Opens every interface. The fault of CanSocket::open(); `refused` is then its name.
  [[nodiscard]] Status open(const char*& refused);
  /// Until the exchange says stop. Cost: after its first round no allocation and no waiting but for
  /// frames, 10 ms at most.
  void run();
  /// One round: waits, reads, updates, publishes.
  void round();

 private:
  void take(std::span<const ReceivedFrame> received);
  void answer(const ReceivedFrame& received);
  void tell_faults();
  void publish();

  const DisplayConfig& config_;
  Exchange& exchange_;
  BusProfile profile_;
  CanBuses buses_;
  OwnshipState state_;
  BusStatus status_;
};

}  // namespace ridgeline
