#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "platform/display/display_config.hpp"
#include "platform/display/exchange.hpp"
#include "platform/gpio_lines.hpp"
#include "platform/service_notify.hpp"

namespace ridgeline {

/// Watches the other threads and alone moves the lines: an edge of the heartbeat for every frame
/// that proves itself, SVS valid while such frames come, SVS fail when they do not.
/// Rules: - The heartbeat line moves for proven frames only (next_heartbeat()).
///        - SVS valid: terrain is drawn, shown and switched on, and the last frame is younger than
///          timeouts.picture_ms. SVS fail: the opposite, but for a display that is switched off,
///          which has not failed.
///        - The service manager's watchdog is kept quiet by life, not by success: new frames and
///          rounds of the bus thread, whatever the picture shows. A bus that is silent is no reason
///          to start the program again.
class Supervisor {
 public:
  Supervisor(const DisplayConfig& config, Exchange& exchange);

  /// Takes the lines, with boot levels from the first moment on. The fault of GpioLines::open();
  /// `refused` is then the name of the line.
  [[nodiscard]] Status open(const char*& refused);
  /// One round at `now_ns`, every 10 ms. Cost: no allocation, no blocking.
  void round(std::int64_t now_ns);
  /// Boot levels: what the lines say when the program has ended.
  void let_go();

  [[nodiscard]] const LineStatus& status() const { return status_; }

 private:
  void take_frame(std::int64_t now_ns);
  void read_lines(std::int64_t now_ns);
  [[nodiscard]] bool level(std::size_t input) const;
  void pass_switches();
  void write_lines(std::int64_t now_ns);
  void keep_service();
  void tell_state();
  void tell_lost(const Status& status);

  const DisplayConfig& config_;
  Exchange& exchange_;
  ServiceNotify service_;
  std::optional<GpioLines> lines_;
  LineStatus status_;
  FrameFact frame_;
  BusStatus bus_;
  HeartbeatRefusal refusal_ = HeartbeatRefusal::none;
  bool booted_ = false;
  bool stalled_ = false;
  std::uint64_t frame_kept_ = 0, rounds_kept_ = 0;  ///< when the service manager was told last
  std::array<char, 160> state_told_{};
};

/// The stable word of a refusal, for logs and reports.
[[nodiscard]] const char* refusal_word(HeartbeatRefusal refusal);

}  // namespace ridgeline
