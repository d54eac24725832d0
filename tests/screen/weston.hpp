#pragma once
#include <sys/types.h>

#include <string>

#include "tests/screen/seen_pixels.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {

/// The compositor of that name, with an output that is memory only, in a folder of its own.
class Weston {
 public:
  static constexpr int width_px = 640, height_px = 480;
  Weston();
  Weston(const Weston&) = delete;
  Weston& operator=(const Weston&) = delete;
  ~Weston();

  /// Empty: it runs. Else why it does not: it is not installed, say.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// Path of its socket.
  [[nodiscard]] const char* name() const { return socket_.c_str(); }
  /// What its output shows, by its own client for that; empty where that fails.
  [[nodiscard]] SeenPixels screenshot() const;

 private:
  [[nodiscard]] bool answers() const;
  TemporaryFolder folder_;
  std::string socket_, problem_;
  pid_t process_ = -1;
};

}  // namespace ridgeline::test
