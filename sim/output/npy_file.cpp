#include "sim/output/npy_file.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/assert.hpp"
#include "sim/output/atomic_file.hpp"

namespace ridgeline::sim {
namespace {

constexpr std::size_t alignment_bytes = 64;
constexpr std::size_t prefix_bytes = 10;  // magic, version, header length

/// Magic, version, length and the padded description, ending in a line feed.
std::string npy_header(int rows, int columns) {
  std::string description = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                            std::to_string(rows) + ", " + std::to_string(columns) + "), }";
  const std::size_t bare_bytes = prefix_bytes + description.size() + 1;
  const std::size_t whole_bytes =
      (bare_bytes + alignment_bytes - 1) / alignment_bytes * alignment_bytes;
  description.append(whole_bytes - bare_bytes, ' ');
  description += '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\0';
  header += static_cast<char>(description.size() & 0xff);
  header += static_cast<char>(description.size() >> 8);
  return header + description;
}

}  // namespace

Outcome write_npy(const std::string& path, int rows, int columns, std::span<const float> values) {
  RL_ASSERT(rows >= 0 && columns >= 0);
  RL_ASSERT(values.size() == static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  static_assert(std::endian::native == std::endian::little, "'<f4' is written from host floats");
  const std::string header = npy_header(rows, columns);
  std::vector<std::byte> file(header.size() + values.size_bytes());
  std::memcpy(file.data(), header.data(), header.size());
  if (!values.empty()) std::memcpy(file.data() + header.size(), values.data(), values.size_bytes());
  return write_file(path, file);
}

}  // namespace ridgeline::sim
