#include "platform/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace ridgeline {

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  if (this != &other) {
    unmap();
    bytes_ = std::exchange(other.bytes_, {});
  }
  return *this;
}

MappedFile::~MappedFile() {
  unmap();
}

void MappedFile::unmap() {
  if (bytes_.empty()) return;
  // munmap wants the non-const pointer that mmap gave; nothing is written through it.
  ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  bytes_ = {};
}

void MappedFile::forget_pages() const {
  if (bytes_.empty()) return;
  ::madvise(const_cast<std::byte*>(bytes_.data()), bytes_.size(), MADV_DONTNEED);
}

Result<MappedFile> MappedFile::open(const char* path) {
  // O_NONBLOCK: opening a pipe that nobody writes to must not hang the program.
  const int descriptor = ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return Fault::file_unreadable;
  struct stat status = {};
  int error = ::fstat(descriptor, &status) == 0 ? 0 : errno;
  if (error == 0 && !S_ISREG(status.st_mode)) error = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
  void* start = nullptr;
  const std::size_t size_bytes = error == 0 ? static_cast<std::size_t>(status.st_size) : 0;
  if (size_bytes > 0) {
    start = ::mmap(nullptr, size_bytes, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (start == MAP_FAILED) error = errno;
  }
  ::close(descriptor);  // the mapping keeps the file
  if (error != 0) {
    errno = error;
    return Fault::file_unreadable;
  }
  return MappedFile({static_cast<const std::byte*>(start), size_bytes});
}

}  // namespace ridgeline
