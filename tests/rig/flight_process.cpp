#include "tests/rig/flight_process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace ridgeline::rig {

bool within(int seconds, const std::function<bool()>& is_true) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (!is_true()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

Process::Process(const std::vector<std::string>& command, const std::string& errors)
    : errors_(errors) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  // Before the fork, so that nobody reads what an earlier program has told.
  const int file = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  id_ = ::fork();
  if (id_ != 0) {
    ::close(file);
    return;
  }
  ::dup2(file, STDERR_FILENO);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

Process::~Process() {
  if (runs()) {
    signal(SIGKILL);
    status(10);
  }
}

void Process::signal(int number) const {
  ::kill(id_, number);
}

bool Process::runs() {
  int raw = 0;
  if (!ended_ && ::waitpid(id_, &raw, WNOHANG) == id_) {
    ended_ = true;
    status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
  }
  return !ended_;
}

int Process::status(int seconds) {
  return within(seconds, [this] { return !runs(); }) ? status_ : -1;
}

std::string Process::told() const {
  std::ifstream stream(errors_);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

int Process::times_told(const std::string& text) const {
  const std::string all = told();
  int times = 0;
  for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) {
    ++times;
  }
  return times;
}

}  // namespace ridgeline::rig
