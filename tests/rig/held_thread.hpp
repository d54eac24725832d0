#pragma once
#include <sys/types.h>

#include <string>

namespace ridgeline::rig {

/// One thread of another program, stopped as if it hung; the others go on. Goes on at the end.
/// Domain: made and destroyed by the same thread, which must be a parent of the program.
class HeldThread {
 public:
  /// `name`: of the thread, as the kernel knows it.
  HeldThread(pid_t program, const std::string& name);
  HeldThread(const HeldThread&) = delete;
  HeldThread& operator=(const HeldThread&) = delete;
  ~HeldThread();

  [[nodiscard]] bool holds() const { return thread_ > 0; }
  /// Once its program was killed: a thread that is held stays, and its program with it, until its
  /// end was asked for. Nothing while it lives.
  void bury();

 private:
  pid_t thread_ = -1;
};

}  // namespace ridgeline::rig
