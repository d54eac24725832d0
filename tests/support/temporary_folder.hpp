#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace ridgeline::test {

/// A new empty folder under the system's temporary folder; removed with all it holds.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::string& path() const { return path_; }
  /// The path of `name` inside the folder; sub-folders in it are made.
  [[nodiscard]] std::string file(const std::string& name) const;

 private:
  std::string path_;
};

/// Writes the file anew, or aborts the test program.
void write_bytes(const std::string& path, std::span<const std::byte> bytes);

/// The bytes of a file, or aborts the test program.
std::vector<std::byte> read_bytes(const std::string& path);

}  // namespace ridgeline::test
