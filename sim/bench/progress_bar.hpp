#pragma once
#include <string>

namespace ridgeline::sim {

/// One line on standard error that is drawn over again: a bar, per cent, what is being done and how
/// long it will take. Quiet where standard error is no terminal, but for one line at the end.
class ProgressBar {
 public:
  explicit ProgressBar(int steps);
  /// One step is done; `doing` is next.
  void step(const std::string& doing);
  void end();

 private:
  void draw(const std::string& doing);

  int steps_, done_ = 0;
  bool is_terminal_;
  double start_s_, drawn_s_ = 0;
};

}  // namespace ridgeline::sim
