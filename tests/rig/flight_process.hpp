#pragma once
#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace ridgeline::rig {

/// Asks again and again until it is true; false when that takes too long.
bool within(int seconds, const std::function<bool()>& is_true);

/// A program that runs beside the test; killed at the end if it still does.
class Process {
 public:
  /// `errors`: file that takes its standard error.
  Process(const std::vector<std::string>& command, const std::string& errors);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  void signal(int number) const;
  [[nodiscard]] pid_t id() const { return id_; }
  [[nodiscard]] bool runs();
  /// Waits for its end; exit status, -1 after a signal or when it takes too long.
  int status(int seconds);
  /// How often standard error has held the text so far.
  [[nodiscard]] int times_told(const std::string& text) const;
  [[nodiscard]] std::string told() const;

 private:
  pid_t id_ = -1;
  bool ended_ = false;
  int status_ = -1;
  std::string errors_;
};

}  // namespace ridgeline::rig
