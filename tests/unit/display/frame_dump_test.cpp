#include "platform/display/frame_dump.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ridgeline {
namespace {

TEST(FrameDump, the_checksum_is_that_of_the_standard) {
  const std::string text = "123456789";
  EXPECT_EQ(crc32_of_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}),
            0xcbf43926u);
}

TEST(FrameDump, libpng_reads_the_picture_back) {
  constexpr int width = 211, height = 173;  // more than one stored block
  std::vector<std::uint8_t> rgb(3 * width * height);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(i * i / 7);
  const std::string file = png_of(width, height, rgb);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()), 0) << image.message;
  EXPECT_EQ(image.width, static_cast<png_uint_32>(width));
  EXPECT_EQ(image.height, static_cast<png_uint_32>(height));
  EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0) << image.message;
  EXPECT_EQ(read, rgb);
}

}  // namespace
}  // namespace ridgeline
