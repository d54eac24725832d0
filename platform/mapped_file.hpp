#pragma once
#include <cstddef>
#include <span>

#include "core/base/result.hpp"

namespace ridgeline {

/// A file mapped read-only. Move-only; unmaps itself.
/// Domain: a file cut short while it is mapped raises SIGBUS when its lost part is read, as every
///         mapping does: terrain is installed while the program does not run.
class MappedFile {
 public:
  MappedFile() = default;
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  /// Maps the whole of a regular file; an empty file maps to no bytes.
  /// Domain: anything that cannot be opened or is no regular file (a folder, a pipe) is
  ///         Fault::file_unreadable, and errno says why.
  /// Cost:   a few system calls, no heap: allowed after boot. Pages are read when touched.
  static Result<MappedFile> open(const char* path);

  /// The bytes of the file; valid while this object lives and is not moved from.
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  /// Lets the pages read so far go; they come back from the file when they are read again.
  void forget_pages() const;

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  void unmap();

  std::span<const std::byte> bytes_;
};

}  // namespace ridgeline
