#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "sim/output/atomic_file.hpp"
#include "sim/output/formatted.hpp"
#include "sim/output/image_file.hpp"
#include "sim/output/npy_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline::sim {
namespace {

using test::bytes_of;
using test::ScratchFolder;

std::size_t files_in(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    count += entry.exists() ? 1U : 0U;
  return count;
}

TEST(WriteFile, replaces_the_whole_file_and_leaves_no_neighbour) {
  const ScratchFolder folder("write_file");
  const std::string path = folder.file("text");
  ASSERT_TRUE(write_file(path, std::string_view("a long first version")).ok());
  ASSERT_TRUE(write_file(path, std::string_view("short")).ok());
  const std::vector<unsigned char> bytes = bytes_of(path);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "short");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(WriteFile, fault_names_the_file_and_keeps_the_old_contents) {
  const ScratchFolder folder("write_fault");
  const Outcome missing = write_file(folder.file("no/such/folder/file"), std::string_view("x"));
  EXPECT_EQ(missing.fault, Fault::file_unwritable);
  EXPECT_NE(missing.message.find("no/such/folder/file"), std::string::npos);
  EXPECT_EQ(missing.message.find('\n'), std::string::npos);
  // A folder stands where the file should go: the rename fails, the folder stays, no neighbour
  // does.
  std::filesystem::create_directories(folder.file("taken/inside"));
  EXPECT_EQ(write_file(folder.file("taken"), std::string_view("x")).fault, Fault::file_unwritable);
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("taken/inside")));
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(MakeFolder, makes_parents_and_accepts_an_existing_folder) {
  const ScratchFolder folder("make_folder");
  EXPECT_TRUE(make_folder(folder.file("a/b/c")).ok());
  EXPECT_TRUE(make_folder(folder.file("a/b/c")).ok());
  ASSERT_TRUE(write_file(folder.file("plain"), std::string_view("x")).ok());
  const Outcome blocked = make_folder(folder.file("plain/below"));
  EXPECT_EQ(blocked.fault, Fault::file_unwritable);
  EXPECT_NE(blocked.message.find("plain/below"), std::string::npos);
}

TEST(WritePng, libpng_reads_back_every_pixel) {
  const ScratchFolder folder("png");
  constexpr int width = 37;
  constexpr int height = 21;
  std::vector<std::uint8_t> rgb(3 * width * height);
  for (std::size_t k = 0; k < rgb.size(); ++k) rgb[k] = static_cast<std::uint8_t>(k * 7 + k / 256);
  ASSERT_TRUE(write_png(folder.file("picture.png"), width, height, rgb).ok());

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, folder.file("picture.png").c_str()), 0);
  EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  ASSERT_EQ(image.width, static_cast<png_uint_32>(width));
  ASSERT_EQ(image.height, static_cast<png_uint_32>(height));
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(read, rgb);
}

TEST(WritePng, same_pixels_give_the_same_bytes) {
  const ScratchFolder folder("png_twice");
  const std::vector<std::uint8_t> rgb(3 * 64 * 64, 90);
  ASSERT_TRUE(write_png(folder.file("a.png"), 64, 64, rgb).ok());
  ASSERT_TRUE(write_png(folder.file("b.png"), 64, 64, rgb).ok());
  EXPECT_EQ(bytes_of(folder.file("a.png")), bytes_of(folder.file("b.png")));
}

TEST(WritePng, fault_when_the_folder_is_missing) {
  const std::vector<std::uint8_t> rgb(3, 1);
  const ScratchFolder folder("png_fault");
  const Outcome outcome = write_png(folder.file("none/p.png"), 1, 1, rgb);
  EXPECT_EQ(outcome.fault, Fault::file_unwritable);
  EXPECT_NE(outcome.message.find("none/p.png"), std::string::npos);
}

TEST(Crc32, is_the_one_of_png_and_zlib) {
  // The check value of this polynomial in every catalogue of CRCs: the digits 1 to 9.
  const std::array<std::uint8_t, 9> digits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32_of(digits), 0xCBF43926U);
  EXPECT_EQ(crc32_of({}), 0U);
}

/// A second reading of the format description, independent of the writer.
struct Npy {
  std::string description;
  std::size_t data_at = 0;
  std::vector<float> values;
};

Npy parsed_npy(const std::vector<unsigned char>& bytes) {
  Npy npy;
  const std::array<unsigned char, 8> magic = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0};
  if (bytes.size() < 10 || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0) return npy;
  const std::size_t length = bytes[8] + 256U * bytes[9];
  npy.data_at = 10 + length;
  if (npy.data_at > bytes.size()) return npy;
  npy.description.assign(bytes.begin() + 10,
                         bytes.begin() + static_cast<std::ptrdiff_t>(npy.data_at));
  for (std::size_t at = npy.data_at; at + 4 <= bytes.size(); at += 4) {
    const std::uint32_t bits = bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
                               static_cast<std::uint32_t>(bytes[at + 3]) << 24;
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    npy.values.push_back(value);
  }
  return npy;
}

TEST(Formatted, holds_every_letter_of_any_length) {
  EXPECT_EQ(formatted("nothing to fill in"), "nothing to fill in");
  EXPECT_EQ(formatted("%.2f %s|%5d", 1.005, "a", -7), "1.00 a|   -7");
  EXPECT_EQ(formatted("%s", ""), "");
  const std::string words(5'000, 'w');
  EXPECT_EQ(formatted("<%s>", words.c_str()), '<' + words + '>');
}

TEST(WriteNpy, holds_shape_order_and_every_bit) {
  const ScratchFolder folder("npy");
  const std::vector<float> values = {0.0F,
                                     -0.0F,
                                     1.5F,
                                     std::numeric_limits<float>::infinity(),
                                     std::numeric_limits<float>::quiet_NaN(),
                                     123456.7F};
  ASSERT_TRUE(write_npy(folder.file("range.npy"), 2, 3, values).ok());
  const std::vector<unsigned char> bytes = bytes_of(folder.file("range.npy"));
  const Npy npy = parsed_npy(bytes);
  EXPECT_EQ(npy.data_at % 64, 0U);
  EXPECT_EQ(npy.description.substr(0, npy.description.find_last_not_of(" \n") + 1),
            "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }");
  ASSERT_FALSE(npy.description.empty());
  EXPECT_EQ(npy.description.back(), '\n');
  ASSERT_EQ(npy.values.size(), values.size());
  EXPECT_EQ(std::memcmp(npy.values.data(), values.data(), values.size() * sizeof(float)), 0);
}

TEST(WriteNpy, data_stay_aligned_for_every_length_of_the_shape) {
  const ScratchFolder folder("npy_sizes");
  for (const int columns : {1, 9, 10, 99, 1000, 12345, 100000}) {
    const std::vector<float> values(static_cast<std::size_t>(columns), 1.0F);
    ASSERT_TRUE(write_npy(folder.file("a.npy"), 1, columns, values).ok());
    const Npy npy = parsed_npy(bytes_of(folder.file("a.npy")));
    EXPECT_EQ(npy.data_at % 64, 0U) << columns;
    EXPECT_EQ(npy.values.size(), values.size());
  }
}

}  // namespace
}  // namespace ridgeline::sim
