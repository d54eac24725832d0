#include "platform/mapped_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace ridgeline {
namespace {

using test::TemporaryFolder;

TEST(MappedFile, bytes_are_those_of_the_file) {
  const TemporaryFolder folder;
  std::vector<std::byte> bytes(10000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i % 251);
  test::write_bytes(folder.file("a"), bytes);
  const Result<MappedFile> file = MappedFile::open(folder.file("a").c_str());
  ASSERT_TRUE(file.ok());
  ASSERT_EQ(file.value().bytes().size(), bytes.size());
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), file.value().bytes().begin()));
}

TEST(MappedFile, moving_moves_the_bytes) {
  const TemporaryFolder folder;
  const std::vector<std::byte> one(1, std::byte{7});
  const std::vector<std::byte> two(2, std::byte{9});
  test::write_bytes(folder.file("one"), one);
  test::write_bytes(folder.file("two"), two);
  Result<MappedFile> first = MappedFile::open(folder.file("one").c_str());
  Result<MappedFile> second = MappedFile::open(folder.file("two").c_str());
  ASSERT_TRUE(first.ok() && second.ok());
  MappedFile moved = std::move(first).value();
  EXPECT_TRUE(first.value().bytes().empty());
  ASSERT_EQ(moved.bytes().size(), 1U);
  EXPECT_EQ(moved.bytes()[0], std::byte{7});
  moved = std::move(second).value();
  EXPECT_TRUE(second.value().bytes().empty());
  ASSERT_EQ(moved.bytes().size(), 2U);
  EXPECT_EQ(moved.bytes()[1], std::byte{9});
}

TEST(MappedFile, empty_file_has_no_bytes) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("empty"), {});
  const Result<MappedFile> file = MappedFile::open(folder.file("empty").c_str());
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE(file.value().bytes().empty());
}

TEST(MappedFile, what_is_no_file_is_refused_with_the_reason) {
  const TemporaryFolder folder;
  EXPECT_EQ(MappedFile::open(folder.file("missing").c_str()).fault(), Fault::file_unreadable);
  EXPECT_EQ(errno, ENOENT);
  EXPECT_EQ(MappedFile::open(folder.path().c_str()).fault(), Fault::file_unreadable);
  EXPECT_EQ(errno, EISDIR);
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_EQ(MappedFile::open(folder.file("pipe").c_str()).fault(), Fault::file_unreadable);
}

}  // namespace
}  // namespace ridgeline
