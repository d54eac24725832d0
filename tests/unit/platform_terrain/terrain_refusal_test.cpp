#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "platform/terrain_folder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr GeoBox whole_earth{-90, -180, 90, 180};

int ramp_m(int row, int column) {
  return row + column;
}

class Refusal : public testing::Test {
 protected:
  // Opens the folder, chooses everything twice, and gives back the only refusal there is.
  FileProblem only_refusal() {
    FileResult<TerrainFolder> opened = TerrainFolder::open(folder_.path());
    EXPECT_TRUE(opened.ok());
    TerrainFolder terrain = std::move(opened).value();
    terrain.select(whole_earth);
    terrain.select(whole_earth);
    EXPECT_TRUE(terrain.tiles().empty());
    EXPECT_FALSE(terrain.any_usable());
    EXPECT_EQ(terrain.refused().size(), 1U);
    return terrain.refused().empty() ? FileProblem{} : terrain.refused()[0];
  }

  void expect_refused(const std::string& name, Fault fault, const std::string& detail) {
    const FileProblem problem = only_refusal();
    const std::string path = folder_.file(name);
    EXPECT_EQ(problem.file, path);
    EXPECT_EQ(fault_id(problem.fault), fault_id(fault));
    EXPECT_THAT(problem.message,
                AllOf(StartsWith(path + ": " + std::string(fault_text(fault))), HasSubstr(detail)));
    EXPECT_EQ(problem.message.find('\n'), std::string::npos);
  }

  void write_zeros(const std::string& name, std::size_t size_bytes) {
    test::write_bytes(folder_.file(name), std::vector<std::byte>(size_bytes));
  }

  void write_damaged_dted(const std::string& name, std::size_t at, std::byte flip) {
    std::vector<std::byte> bytes = test::dted_bytes(0, 46, 8, ramp_m);
    bytes[at] ^= flip;
    test::write_bytes(folder_.file(name), bytes);
  }

  TemporaryFolder folder_;
};

TEST_F(Refusal, empty_hgt) {
  write_zeros("N46E008.hgt", 0);
  expect_refused("N46E008.hgt", Fault::tile_truncated, "0 bytes");
}

TEST_F(Refusal, truncated_hgt) {
  write_zeros("N46E008.hgt", 2 * 1201 * 1201 - 100);
  expect_refused("N46E008.hgt", Fault::tile_truncated, "2884702 bytes");
}

TEST_F(Refusal, mis_sized_hgt) {
  write_zeros("N46E008.hgt", 2 * 1801 * 1801);
  expect_refused("N46E008.hgt", Fault::tile_size_mismatch, "6487202 bytes");
}

TEST_F(Refusal, hgt_whose_name_is_no_place) {
  write_zeros("alps.hgt", 2 * 1201 * 1201);
  expect_refused("alps.hgt", Fault::tile_name_unknown, "N46E008.hgt");
}

TEST_F(Refusal, folder_named_like_a_tile) {
  std::filesystem::create_directory(folder_.file("N46E008.hgt"));
  expect_refused("N46E008.hgt", Fault::tile_unreadable, "is a folder");
}

TEST_F(Refusal, dangling_link) {
  std::filesystem::create_symlink("nowhere", folder_.file("N46E008.hgt"));
  expect_refused("N46E008.hgt", Fault::tile_unreadable, "No such file");
}

TEST_F(Refusal, truncated_dted) {
  std::vector<std::byte> bytes = test::dted_bytes(0, 46, 8, ramp_m);
  bytes.resize(bytes.size() - 1);
  test::write_bytes(folder_.file("n46_e008.dt0"), bytes);
  expect_refused("n46_e008.dt0", Fault::tile_truncated, "34161 bytes");
}

TEST_F(Refusal, empty_dted) {
  write_zeros("n46_e008.dt1", 0);
  expect_refused("n46_e008.dt1", Fault::tile_truncated, "0 bytes");
}

TEST_F(Refusal, dted_with_a_damaged_header) {
  write_damaged_dted("n46_e008.dt0", 0, std::byte{0x20});
  expect_refused("n46_e008.dt0", Fault::tile_header_corrupt, "");
}

TEST_F(Refusal, dted_with_one_flipped_bit_in_a_post) {
  write_damaged_dted("n46_e008.dt0", 20000, std::byte{0x04});
  expect_refused("n46_e008.dt0", Fault::tile_checksum_mismatch, "");
}

TEST_F(Refusal, dted_with_a_damaged_record_sentinel) {
  write_damaged_dted("n46_e008.dt0", 3428, std::byte{0x01});
  expect_refused("n46_e008.dt0", Fault::tile_record_corrupt, "");
}

TEST_F(Refusal, dted_whose_name_names_another_cell) {
  test::write_dted(folder_.file("n46_e009.dt0"), 0, 46, -8, ramp_m);
  expect_refused("n46_e009.dt0", Fault::tile_location_mismatch, "the header says N46W008");
}

TEST_F(Refusal, hgt_that_is_cut_after_the_search) {
  write_zeros("N46E008.hgt", 2 * 1201 * 1201);
  FileResult<TerrainFolder> terrain = TerrainFolder::open(folder_.path());
  ASSERT_TRUE(terrain.ok());
  EXPECT_TRUE(terrain.value().any_usable());
  std::filesystem::resize_file(folder_.file("N46E008.hgt"), 1000);
  terrain.value().select(whole_earth);
  EXPECT_FALSE(terrain.value().any_usable());
  ASSERT_EQ(terrain.value().refused().size(), 1U);
  EXPECT_EQ(terrain.value().refused()[0].fault, Fault::tile_truncated);
}

TEST_F(Refusal, tile_that_changes_after_the_search) {
  test::write_dted(folder_.file("a.dt0"), 0, 46, 8, ramp_m);
  FileResult<TerrainFolder> terrain = TerrainFolder::open(folder_.path());
  ASSERT_TRUE(terrain.ok());
  test::write_dted(folder_.file("a.dt0"), 0, 47, 8, ramp_m);
  terrain.value().select(whole_earth);
  ASSERT_EQ(terrain.value().refused().size(), 1U);
  EXPECT_EQ(terrain.value().refused()[0].fault, Fault::tile_header_corrupt);
  EXPECT_THAT(terrain.value().refused()[0].message, HasSubstr("changed since"));
}

TEST_F(Refusal, good_tiles_stay_beside_a_bad_one) {
  write_damaged_dted("n46_e008.dt0", 20000, std::byte{0x04});
  test::write_dted(folder_.file("n46_e009.dt0"), 0, 46, 9, ramp_m);
  FileResult<TerrainFolder> terrain = TerrainFolder::open(folder_.path());
  ASSERT_TRUE(terrain.ok());
  EXPECT_EQ(terrain.value().usable_count(), 2U);
  terrain.value().select(whole_earth);
  ASSERT_EQ(terrain.value().tiles().size(), 1U);
  EXPECT_EQ(terrain.value().tiles()[0].grid.west_deg, 9.0);
  EXPECT_EQ(terrain.value().usable_count(), 1U);
  EXPECT_EQ(terrain.value().refused().size(), 1U);
}

TEST(TerrainFolderOpen, missing_folder_is_named) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/missing";
  const FileResult<TerrainFolder> terrain = TerrainFolder::open(path);
  ASSERT_FALSE(terrain.ok());
  EXPECT_EQ(terrain.problem().fault, Fault::folder_unreadable);
  EXPECT_EQ(terrain.problem().message,
            path + ": folder cannot be read (No such file or directory)");
}

TEST(TerrainFolderOpen, file_in_place_of_the_folder_is_named) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("N46E008.hgt"), {});
  const FileResult<TerrainFolder> terrain = TerrainFolder::open(folder.file("N46E008.hgt"));
  ASSERT_FALSE(terrain.ok());
  EXPECT_EQ(terrain.problem().fault, Fault::folder_unreadable);
  EXPECT_THAT(terrain.problem().message, HasSubstr("Not a directory"));
}

TEST(TerrainFolderOpen, folder_without_tiles_is_named) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("readme.txt"), {});
  const FileResult<TerrainFolder> terrain = TerrainFolder::open(folder.path());
  ASSERT_FALSE(terrain.ok());
  EXPECT_EQ(terrain.problem().fault, Fault::folder_without_tiles);
  EXPECT_EQ(terrain.problem().message, folder.path() + ": folder holds no terrain tile");
}

}  // namespace
}  // namespace ridgeline
