#include "tests/rig/service.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/rig/installation.hpp"
#include "tests/rig/link.hpp"

namespace ridgeline::rig {
namespace {

namespace fs = std::filesystem;

constexpr const char* name = "ridgeline-display.service";
constexpr const char* program = "/usr/bin/ridgeline-display";

void add_to_unit(const std::string& unit, const std::string& lines) {
  const fs::path folder = "/run/systemd/system/" + unit + ".d";
  fs::create_directories(folder);
  std::ofstream(folder / "rig.conf") << lines;
}

}  // namespace

std::string output_of(const std::string& command) {
  std::string output;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 512> text{};
  while (std::fgets(text.data(), text.size(), pipe) != nullptr) output += text.data();
  ::pclose(pipe);
  if (output.ends_with('\n')) output.pop_back();
  return output;
}

Service::Service() {
  const auto over = fs::copy_options::overwrite_existing;
  fs::copy_file(DISPLAY_PROGRAM, program, over);
  fs::copy_file(UNIT_FILE, unit_file, over);
  fs::create_directories(fs::path(configuration).parent_path());
  // How long a start may take is the machine's business here, which may be busy. In emulation
  // frames take seconds as well, for which the watchdog waits.
  add_to_unit(name, std::string("[Service]\nTimeoutStartSec=900\n") +
                        (is_emulated() ? "WatchdogSec=60\n" : ""));
  // systemd forgets how a unit ended that nothing refers to.
  add_to_unit("rig.target", std::string("[Unit]\nPropagatesReloadTo=") + name + "\n");
  EXPECT_TRUE(shell("systemctl daemon-reload"));
  cursor_ = output_of("journalctl -n 1 -o cat --show-cursor | sed -n 's/^-- cursor: //p'");
}

Service::~Service() {
  control("stop");
  control("reset-failed");
  fs::remove(configuration);
}

void Service::configure(const std::string& file) {
  fs::remove(configuration);
  fs::copy_file(file, configuration);
}

bool Service::control(const std::string& verb) {
  return shell("systemctl " + verb + ' ' + name + " 2>/dev/null");
}

std::string Service::property(const std::string& name_of_it) {
  return output_of("systemctl show -P " + name_of_it + ' ' + name);
}

int Service::main_process() {
  return std::atoi(property("MainPID").c_str());
}

int Service::times_told(const std::string& text, const std::string& options) const {
  const std::string since = cursor_.empty() ? "" : " --after-cursor='" + cursor_ + "'";
  return std::atoi(output_of(std::string("journalctl -q -o cat -u ") + name + since + ' ' +
                             options + " | grep -cF \"" + text + "\"")
                       .c_str());
}

}  // namespace ridgeline::rig
