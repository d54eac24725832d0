#include "sim/output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace ridgeline::sim {
namespace {

bool write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Outcome write_file(const std::string& path, std::span<const std::byte> bytes) {
  // The process id keeps two programs that write the same file from sharing one neighbour.
  const std::string neighbour = path + ".part" + std::to_string(::getpid());
  const int file = ::open(neighbour.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return failed(Fault::file_unwritable, path, std::strerror(errno));
  bool good = write_all(file, bytes) && ::fsync(file) == 0;
  int reason = errno;
  if (::close(file) != 0 && good) {
    good = false;
    reason = errno;
  }
  if (good && std::rename(neighbour.c_str(), path.c_str()) != 0) {
    good = false;
    reason = errno;
  }
  if (good) return {};
  ::unlink(neighbour.c_str());
  return failed(Fault::file_unwritable, path, std::strerror(reason));
}

Outcome write_file(const std::string& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

Outcome make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return failed(Fault::file_unwritable, path, error.message());
  return {};
}

}  // namespace ridgeline::sim
