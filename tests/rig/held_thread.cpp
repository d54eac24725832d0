#include "tests/rig/held_thread.hpp"

#include <sys/ptrace.h>
#include <sys/wait.h>

#include <filesystem>

#include "tests/rig/simulated_chip.hpp"

namespace ridgeline::rig {

HeldThread::HeldThread(pid_t program, const std::string& name) {
  for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(program) + "/task")) {
    if (text_of(entry.path() / "comm") != name) continue;
    const pid_t thread = std::stoi(entry.path().filename());
    if (::ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0 ||
        ::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) != 0) {
      return;
    }
    int status = 0;
    if (::waitpid(thread, &status, __WALL) == thread && WIFSTOPPED(status)) thread_ = thread;
    return;
  }
}

void HeldThread::bury() {
  int status = 0;
  if (holds() && ::waitpid(thread_, &status, __WALL | WNOHANG) == thread_ && !WIFSTOPPED(status)) {
    thread_ = -1;
  }
}

HeldThread::~HeldThread() {
  if (holds()) ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
}

}  // namespace ridgeline::rig
