#include "tests/screen/weston.hpp"

#include <fcntl.h>
#include <png.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ridgeline::test {
namespace {

constexpr int not_installed = 127;

/// In the child: nothing of this process's session reaches the compositor or its clients.
[[noreturn]] void become(const std::string& folder, const std::string& log,
                         const std::vector<std::string>& words) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // not to outlive a test that crashes
  const int quiet = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(quiet, 1);
  ::dup2(quiet, 2);
  ::setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  ::setenv("HOME", folder.c_str(), 1);
  ::setenv("WAYLAND_DISPLAY", "socket", 1);
  ::unsetenv("DISPLAY");
  if (::chdir(folder.c_str()) != 0) ::_exit(1);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(not_installed);
}

pid_t started(const std::string& folder, const std::string& log,
              const std::vector<std::string>& words) {
  const pid_t process = ::fork();
  if (process == 0) become(folder, log, words);
  return process;
}

std::vector<std::uint32_t> read_rows(const std::string& path, int& width_px, int& height_px) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
  image.format = PNG_FORMAT_BGRA;
  std::vector<std::uint32_t> rows(PNG_IMAGE_SIZE(image) / 4);
  if (png_image_finish_read(&image, nullptr, rows.data(), 0, nullptr) == 0) return {};
  width_px = static_cast<int>(image.width);
  height_px = static_cast<int>(image.height);
  return rows;
}

}  // namespace

Weston::Weston() : socket_(folder_.path() + "/socket") {
  ::chmod(folder_.path().c_str(), 0700);
  // Its own way to read a screen is for clients it trusts; --debug makes it trust all.
  process_ =
      started(folder_.path(), folder_.path() + "/log",
              {"weston", "--backend=headless-backend.so", "--use-pixman", "--no-config",
               "--idle-time=0", "--debug", "--socket=socket", "--shell=desktop-shell.so",
               "--width=" + std::to_string(width_px), "--height=" + std::to_string(height_px)});
  for (int wait = 0; wait < 1'000; ++wait) {
    if (answers()) return;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = -1;
      problem_ = WIFEXITED(status) && WEXITSTATUS(status) == not_installed
                     ? "weston is not installed (config/install-deps)"
                     : "weston does not start";
      return;
    }
    ::usleep(10'000);
  }
  problem_ = "weston starts, and opens no socket within ten seconds";
}

Weston::~Weston() {
  if (process_ < 0) return;
  ::kill(process_, SIGTERM);  // it ends the clients it has started
  for (int wait = 0; wait < 300; ++wait) {
    if (::waitpid(process_, nullptr, WNOHANG) == process_) return;
    ::usleep(10'000);
  }
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool Weston::answers() const {
  struct stat found {};
  return ::stat(socket_.c_str(), &found) == 0 && S_ISSOCK(found.st_mode);
}

SeenPixels Weston::screenshot() const {
  const std::filesystem::path shots = folder_.path() + "/shots";
  std::error_code ignored;
  std::filesystem::remove_all(shots, ignored);
  std::filesystem::create_directory(shots, ignored);
  const pid_t client =
      started(shots.string(), folder_.path() + "/shot log",
              {"env", "XDG_RUNTIME_DIR=" + folder_.path(), "weston-screenshooter"});
  ::waitpid(client, nullptr, 0);
  SeenPixels seen;
  for (const auto& entry : std::filesystem::directory_iterator(shots, ignored)) {
    seen.rows = read_rows(entry.path().string(), seen.width_px, seen.height_px);
  }
  return seen;
}

}  // namespace ridgeline::test
