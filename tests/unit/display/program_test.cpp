// The flight program from outside, as far as no bus is needed.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
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
