#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "platform/display/display_config.hpp"
#include "platform/display/exchange.hpp"
#include "platform/display/json_text.hpp"
#include "platform/display/status_report.hpp"

namespace ridgeline {

/// Writes what the other threads have to say: log lines to standard error, status reports to their
/// file. The one thread that may wait for a disk or a reader.
class LogThread {
 public:
  LogThread(const DisplayConfig& config, Exchange& exchange);

  /// Until finish() is asked for. Cost: no allocation after its first round.
  void run();
  /// One round at `now_ns`: all lines that wait, and a report where one is due or wanted.
  void round(std::int64_t now_ns);
  /// The last lines and the last report; `why` as in write_status().
  void finish(const char* why);

  std::atomic<bool> end{false};  ///< set once the other threads have ended

 private:
  void write_lines(LogRing& ring);
  void report(std::int64_t now_ns, const char* why);

  const DisplayConfig& config_;
  Exchange& exchange_;
  bool for_journal_;
  std::string new_file_;  ///< written first, then put in place of the old report
  std::int64_t next_report_ns_ = 0;
  StatusSources sources_;
  JsonText json_;
};

}  // namespace ridgeline
