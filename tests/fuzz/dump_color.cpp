// The picture of a dumped frame, as the oracle reads it. An input is the bytes of a PNG file.
#include <string>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/dump.hpp"
#include "tests/oracle/input_error.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

/// Pictures of a size that only costs time.
bool is_large(std::string_view bytes) {
  constexpr std::size_t sides_at = 16;
  if (bytes.size() < sides_at + 8) return false;
  fuzz::InputBytes sides(reinterpret_cast<const std::uint8_t*>(bytes.data()) + sides_at, 8);
  const std::uint32_t width = sides.u32(), height = sides.u32();
  return (width > 64 || height > 64) && width <= 8192 && height <= 8192;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(fuzz::InputBytes(data, size).text());
  if (is_large(bytes)) return -1;
  oracle::Frame frame;
  try {
    oracle::take_color("color.png", bytes, frame);
    must(frame.color_width >= 1 && frame.color_height >= 1, "a picture has a size");
    const std::uint32_t crc = frame.color_crc32;
    oracle::take_color("color.png", bytes, frame);
    must(frame.color_crc32 == crc, "a picture is the same each time");
  } catch (const oracle::InputError& error) {
    const std::string_view message = error.what();
    must(message.starts_with("color.png: ") && message.size() > 11, "what is wrong is told");
    must(frame.color_width == 0 && frame.color_crc32 == 0, "what is refused leaves nothing");
  }
  return 0;
}
