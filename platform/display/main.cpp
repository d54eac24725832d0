#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "platform/display/display_config.hpp"
#include "platform/display/flight_program.hpp"

namespace {

using ridgeline::Exit;

constexpr const char* usage =
    "usage: ridgeline-display [--check-config] CONFIGURATION\n"
    "       ridgeline-display --help | --version\n"
    "Draws terrain from a live bus as the configuration file says, until SIGTERM; SIGUSR1 asks "
    "for\n"
    "a status report. --check-config reads and checks the file, and ends.\n"
    "Exit status: 0 stopped or checked, 1 ended by a fault in flight, 2 wrong usage, 3 bad "
    "input.\n";

struct Arguments {
  bool check_only = false;
  std::string file;
};

/// Whether the arguments make sense.
bool parse(int count, char** words, Arguments& arguments) {
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--check-config") {
      arguments.check_only = true;
    } else if (!arguments.file.empty() || word.empty() || word[0] == '-') {
      std::fprintf(stderr, "ridgeline-display: %s is not expected\n", word.c_str());
      return false;
    } else {
      arguments.file = word;
    }
  }
  if (arguments.file.empty()) std::fprintf(stderr, "ridgeline-display: no configuration given\n");
  return !arguments.file.empty();
}

Exit run(int count, char** words) {
  if (count == 2 && std::strcmp(words[1], "--help") == 0) {
    std::fputs(usage, stdout);
    return Exit::done;
  }
  if (count == 2 && std::strcmp(words[1], "--version") == 0) {
    std::puts("ridgeline-display " RL_VERSION);
    return Exit::done;
  }
  Arguments arguments;
  if (!parse(count, words, arguments)) return Exit::wrong_usage;
  auto config = ridgeline::load_config(arguments.file);
  if (!config) {
    std::fprintf(stderr, "ridgeline-display: %s\n", config.problem().message.c_str());
    return Exit::bad_input;
  }
  if (arguments.check_only) return Exit::done;
  // Made once, on the heap: it is larger than a stack should have to hold.
  const auto program = std::make_unique<ridgeline::FlightProgram>(config.value());
  return program->run();
}

}  // namespace

int main(int count, char** words) {
  ridgeline::FlightProgram::hold_signals();
  return static_cast<int>(run(count, words));
}
