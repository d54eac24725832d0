#include "sim/output/image_file.hpp"

#include <png.h>
#include <zlib.h>

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/assert.hpp"
#include "sim/output/atomic_file.hpp"

namespace ridgeline::sim {

Outcome write_png(const std::string& path, int width, int height,
                  std::span<const std::uint8_t> rgb) {
  RL_ASSERT(width > 0 && height > 0);
  RL_ASSERT(rgb.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  // Replays write hundreds of frames: the fast setting halves their time for a few per cent more
  // bytes.
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size_bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> file(size_bytes);
  if (png_image_write_to_memory(&image, file.data(), &size_bytes, 0, rgb.data(), 0, nullptr) == 0) {
    return failed(Fault::file_unwritable, path, image.message);
  }
  return write_file(path, std::span<const std::byte>(file.data(), size_bytes));
}

std::uint32_t crc32_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(::crc32_z(0, nullptr, 0), bytes.data(), bytes.size()));
}

}  // namespace ridgeline::sim
