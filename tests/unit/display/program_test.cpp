// The flight program from outside, as far as no bus is needed.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace ridgeline {
namespace {

struct Ended {
  int status = -1;
  std::string told;  ///< both outputs
};

Ended display(const std::string& arguments) {
  Ended ended;
  FILE* pipe = ::popen(("'" DISPLAY_PROGRAM "' " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return ended;
  std::array<char, 512> text{};
  while (std::fgets(text.data(), text.size(), pipe) != nullptr) ended.told += text.data();
  const int raw = ::pclose(pipe);
  ended.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
  return ended;
}

TEST(DisplayProgram, a_good_configuration_is_checked_in_silence) {
  const Ended ended = display("--check-config '" CONFIG_FOLDER "/bench.toml'");
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.told, "");
}

TEST(DisplayProgram, a_bad_one_is_refused_in_one_line_with_file_and_line) {
  const test::ScratchFolder folder("display_program");
  const std::string file = folder.file("bad.toml");
  std::ofstream(file) << "[picture]\nwidth_px = 7\n";
  for (const char* option : {"--check-config ", ""}) {
    const Ended ended = display(option + file);
    EXPECT_EQ(ended.status, 3);
    EXPECT_EQ(ended.told.find(file + ":1: picture.height_px: is missing\n"),
              std::string("ridgeline-display: ").size())
        << ended.told;
    EXPECT_EQ(ended.told.find('\n'), ended.told.size() - 1);
  }
}

TEST(DisplayProgram, wrong_usage_ends_with_2) {
  for (const char* arguments : {"", "--no-such-option", "a.toml b.toml", "--check-config"}) {
    EXPECT_EQ(display(arguments).status, 2) << arguments;
  }
  EXPECT_EQ(display("--help").status, 0);
  EXPECT_EQ(display("--version").status, 0);
}

/// What becomes of the program when the signal comes while it still reads its configuration, a
/// pipe that tells when: the raw status of its end.
int ended_after(int signal, const std::string& pipe) {
  const pid_t program = ::fork();
  if (program == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    ::execl(DISPLAY_PROGRAM, DISPLAY_PROGRAM, pipe.c_str(), nullptr);
    ::_exit(127);
  }
  const int writer = ::open(pipe.c_str(), O_WRONLY);  // waits until the program reads
  ::kill(program, signal);
  ::close(writer);  // an empty configuration, which is refused
  int raw = -1;
  ::waitpid(program, &raw, 0);
  return raw;
}

/// Found on 2026-11-25: before boot had set its mask, a question (SIGUSR1) ended the program.
TEST(DisplayProgram, a_signal_before_boot_does_not_end_it) {
  const test::ScratchFolder folder("display_program");
  const std::string pipe = folder.file("pipe.toml");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const int signal : {SIGUSR1, SIGTERM, SIGINT}) {
    for (int time = 0; time < 10; ++time) {
      const int raw = ended_after(signal, pipe);
      ASSERT_TRUE(WIFEXITED(raw)) << "ended by signal " << WTERMSIG(raw);
      ASSERT_EQ(WEXITSTATUS(raw), 3);
    }
  }
  const int raw = ended_after(SIGHUP, pipe);
  EXPECT_TRUE(WIFSIGNALED(raw) && WTERMSIG(raw) == SIGHUP) << "the signal comes in time to be seen";
}

TEST(DisplayProgram, no_bus_is_refused_by_name) {
  const test::ScratchFolder folder("display_program");
  const auto bytes = test::bytes_of(CONFIG_FOLDER "/bench.toml");
  std::string text(bytes.begin(), bytes.end());
  text.replace(text.find("\"vcan0\""), 7, "\"no-such-bus\"");
  std::ofstream(folder.file("no_bus.toml")) << text;
  const Ended ended = display(folder.file("no_bus.toml"));
  EXPECT_EQ(ended.status, 3);
  EXPECT_EQ(ended.told.rfind("ridgeline-display: bus 'no-such-bus': ", 0), 0u) << ended.told;
}

}  // namespace
}  // namespace ridgeline
