#pragma once
#include <csignal>
#include <string>

#include "platform/display/bus_thread.hpp"
#include "platform/display/display_config.hpp"
#include "platform/display/exchange.hpp"
#include "platform/display/log_thread.hpp"
#include "platform/display/render_thread.hpp"
#include "platform/display/supervisor.hpp"
#include "platform/real_time.hpp"

namespace ridgeline {

/// Exit statuses of the program, as docs/commands.md has them.
enum class Exit : int { done = 0, failed_in_flight = 1, wrong_usage = 2, bad_input = 3 };

/// The flight program: a bus thread, a render thread and a log thread, and the calling thread as
/// their supervisor. Lines are taken first, so that SVS fail stands from the first moment on.
class FlightProgram {
 public:
  explicit FlightProgram(const DisplayConfig& config);

  /// Holds back the signals that run() takes, for the calling thread and all that it starts. The
  /// first thing a program does: one that comes before would end it as if it knew none.
  static void hold_signals();

  /// Boots, flies until SIGTERM or SIGINT or a fault that ends it, and shuts down. What boot
  /// refuses is one line on standard error. SIGUSR1 asks for a status report.
  Exit run();

 private:
  [[nodiscard]] std::string open();
  [[nodiscard]] std::string start();
  bool fly();
  void take_signal(int signal);
  Exit shut_down();
  Exit refuse(const std::string& problem);

  const DisplayConfig& config_;
  Exchange exchange_;
  Supervisor supervisor_;
  BusThread bus_;
  RenderThread render_;
  LogThread log_;
  FlightThread bus_thread_, render_thread_, log_thread_;
};

}  // namespace ridgeline
