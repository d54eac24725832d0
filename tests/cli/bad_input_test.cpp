// Every kind of bad input: one line that names the file and the fault, and the contract's status.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "tests/cli/program.hpp"
#include "tests/support/geotiff_writer.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

std::vector<std::string> pose_over(const std::string& folder,
                                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"pose",      "-45.5", "-72.5",  "700",   "0",       "-5",  "270",
                               "--terrain", folder,  "--size", "64x48", "--range", "6000"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<float> ranges_of(const std::string& path) {
  const auto bytes = read_bytes(path);
  std::vector<float> values(64 * 48);
  const std::size_t size = values.size() * sizeof(float);
  EXPECT_GT(bytes.size(), size);
  std::memcpy(values.data(), bytes.data() + bytes.size() - size, size);
  return values;
}

TEST(BadTerrain, a_folder_that_is_not_there) {
  expect_one_line(ridgeline(pose_over("/nowhere/at/all")), 3, {"/nowhere/at/all: folder cannot"});
}

TEST(BadTerrain, a_folder_without_tiles) {
  const TemporaryFolder folder;
  write_text(folder.file("readme.txt"), "no tile");
  expect_one_line(ridgeline(pose_over(folder.path())), 3, {folder.path(), "holds no terrain tile"});
}

TEST(BadTerrain, nothing_but_a_truncated_tile) {
  const TemporaryFolder folder;
  write_text(folder.file("S46W073.hgt"), std::string(1000, 'x'));
  expect_one_line(ridgeline(pose_over(folder.path())), 3, {"S46W073.hgt: file", "1000 bytes"});
}

TEST(BadTerrain, nothing_but_a_tile_with_a_damaged_record) {
  const TemporaryFolder folder;
  auto bytes = dted_bytes(1, -46, -73, [](int, int) { return 100; });
  bytes[3428 + 100 * 2414 + 500] ^= std::byte{4};
  write_bytes(folder.file("s46_w073.dt1"), bytes);
  expect_one_line(ridgeline(pose_over(folder.path())), 3,
                  {"s46_w073.dt1: record checksum does not match"});
}

TEST(BadTerrain, nothing_but_a_projected_raster) {
  const TemporaryFolder folder;
  GeotiffRecipe recipe;
  recipe.system = "EPSG:32632";
  recipe.corner_and_steps = {400'000, 30, 0, 5'200'000, 0, -30};
  write_geotiff(folder.file("utm.tif"), recipe);
  expect_one_line(ridgeline(pose_over(folder.path())), 3, {"utm.tif: raster is not geographic"});
}

TEST(BadTerrain, a_wrong_sized_tile_beside_a_good_one_is_unknown_ground) {
  const FlatScene scene;  // the eye is in the good tile, close to its western neighbour
  write_text(scene.file("tiles/S46W074.hgt"), std::string(3'000'000, '\1'));
  const std::string dump = scene.file("dump");
  const Ended ended =
      ridgeline({"pose", "-45.5", "-72.98", "700", "0", "-10", "270", "--terrain", scene.tiles(),
                 "--size", "64x48", "--range", "6000", "--dump", dump});
  expect_one_line(ended, 0, {"S46W074.hgt: file size", "3000000 bytes"});
  EXPECT_NE(ended.out.find("degraded"), std::string::npos) << ended.out;
  EXPECT_NE(text_of(dump + "/000000.json").find("\"tile_refused\""), std::string::npos);
  const std::vector<float> range = ranges_of(dump + "/000000_range.npy");
  // Row 36 looks 20 degrees down, at 1750 m: beyond the tile's edge at 1560 m. Row 47: 1150 m.
  EXPECT_TRUE(std::isnan(range[30 * 64 + 32])) << range[30 * 64 + 32];
  EXPECT_NEAR(static_cast<double>(range[47 * 64 + 32]), 1150, 200);
}

TEST(BadTerrain, a_damaged_record_beside_a_good_tile_is_told_as_well) {
  const FlatScene scene;
  auto bytes = dted_bytes(1, -46, -74, [](int, int) { return 100; });
  bytes[3428 + 7 * 2414 + 50] ^= std::byte{1};
  write_bytes(scene.file("tiles/s46_w074.dt1"), bytes);
  const Ended ended = ridgeline({"pose", "-45.5", "-72.98", "700", "0", "-10", "270", "--terrain",
                                 scene.tiles(), "--size", "64x48", "--range", "6000"});
  expect_one_line(ended, 0, {"s46_w074.dt1: record checksum does not match"});
}

TEST(BadGeoid, missing_or_corrupt) {
  const FlatScene scene;
  expect_one_line(ridgeline(scene.pose({"--geoid", "/nowhere/egm.pgm"})), 3,
                  {"/nowhere/egm.pgm: geoid file cannot be read"});
  write_text(scene.file("bad.pgm"), "P5\n# not a geoid\n7 7\n255\nxx");
  expect_one_line(ridgeline(scene.pose({"--geoid", scene.file("bad.pgm")})), 3,
                  {"bad.pgm: geoid file is corrupt"});
}

TEST(BadLog, missing_empty_or_without_frames) {
  const FlatScene scene;
  const auto replay = [&](const std::string& log) {
    return ridgeline(
        {"replay", log, "--terrain", scene.tiles(), "--size", "64x48", "--range", "6000"});
  };
  expect_one_line(replay("/nowhere/flight.log"), 3, {"/nowhere/flight.log: file cannot be read"});
  write_text(scene.file("empty.log"), "");
  expect_one_line(replay(scene.file("empty.log")), 3, {"empty.log: log holds no CAN frame"});
  write_text(scene.file("comments.log"), "# nothing\n# happened\n");
  expect_one_line(replay(scene.file("comments.log")), 3, {"comments.log: log holds no CAN frame"});
  write_text(scene.file("binary.log"), std::string("\0\1\2\3\377\n\0", 7));
  const Ended binary = replay(scene.file("binary.log"));
  EXPECT_EQ(binary.status, 3);
  EXPECT_TRUE(binary.says("binary.log: log holds no CAN frame")) << binary.err;
}

TEST(BadLog, bad_lines_are_counted_and_the_rest_is_flown) {
  const FlatScene scene;
  std::string log = text_of(scene.log());
  log.insert(log.find("(1700000001"), "this is no frame\n(1700000001.0) can0 13F#ZZ\n");
  write_text(scene.log(), log);
  const Ended ended = ridgeline(scene.replay({"--report", scene.file("report.json")}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("2 bad lines"), std::string::npos) << ended.out;
  EXPECT_NE(text_of(scene.file("report.json")).find("\"bad_lines\": 2"), std::string::npos);
}

TEST(BadLog, a_stretch_that_holds_no_frame) {
  const FlatScene scene;
  expect_one_line(ridgeline(scene.replay({"--from", "100"})), 3, {"flight.log", "--from"});
}

TEST(BadTrack, missing_or_without_fixes) {
  const TemporaryFolder folder;
  const std::string log = folder.file("out.log");
  expect_one_line(ridgeline({"import", "igc", "/nowhere/t.igc", log}), 3,
                  {"/nowhere/t.igc: file cannot be read"});
  write_text(folder.file("t.igc"), "AXXX001\r\nHFDTE010120\r\n");
  expect_one_line(ridgeline({"import", "igc", folder.file("t.igc"), log}), 3,
                  {"t.igc: track holds no usable position fix"});
  EXPECT_FALSE(std::filesystem::exists(log));
}

TEST(BadDump, missing_incomplete_or_tampered) {
  const FlatScene scene;
  const auto verify = [&](const std::string& dump) {
    return ridgeline({"verify", dump, "--terrain", scene.tiles(), "--pixels", "200"});
  };
  EXPECT_EQ(verify("/nowhere/dump").status, 3);
  EXPECT_TRUE(verify("/nowhere/dump").says("/nowhere/dump"));
  const std::string dump = scene.file("dump");
  ASSERT_EQ(ridgeline(scene.pose({"--dump", dump})).status, 0);
  EXPECT_EQ(verify(dump).status, 0);
  const std::string file = dump + "/000000_range.npy";
  const auto good = read_bytes(file);
  auto bad = good;
  for (std::size_t i = bad.size() - 4 * 64 * 8; i < bad.size(); i += 4) {
    bad[i + 2] ^= std::byte{0x60};  // ranges of the lowest rows, changed by a share
  }
  write_bytes(file, bad);
  const Ended tampered = verify(dump);
  EXPECT_EQ(tampered.status, 1) << tampered.out << tampered.err;
  write_bytes(file, std::span(good).first(good.size() / 2));
  expect_one_line(verify(dump), 3, {"000000_range.npy"});
  std::filesystem::remove(file);
  expect_one_line(verify(dump), 3, {"000000_range.npy"});
}

TEST(BadOutput, a_report_of_verify_is_whole_or_not_there) {
  const FlatScene scene;
  const std::string dump = scene.file("dump"), report = scene.file("report.json");
  ASSERT_EQ(ridgeline(scene.pose({"--dump", dump})).status, 0);
  const std::vector<std::string> verify{"verify",   dump,  "--terrain", scene.tiles(),
                                        "--pixels", "all", "--json"};
  const auto with = [&](const std::string& file) {
    std::vector<std::string> words = verify;
    words.push_back(file);
    return ridgeline(words);
  };
  const Ended ended = with(report);
  EXPECT_EQ(ended.status, 0) << ended.err;
  const std::string text = text_of(report);
  EXPECT_NE(text.find("\"pixels\": \"all\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"each_frame\""), std::string::npos);
  EXPECT_EQ(text.substr(text.size() - 2), "}\n");
  expect_one_line(with("/nowhere/report.json"), 3, {"/nowhere/report.json"});
}

TEST(BadOutput, a_dump_folder_that_cannot_be_made) {
  const FlatScene scene;
  expect_one_line(ridgeline(scene.pose({"--dump", scene.log() + "/dump"})), 3, {"flight.log/dump"});
  expect_one_line(ridgeline({"make-demo", scene.log() + "/demo"}), 3, {"flight.log/demo"});
}

}  // namespace
}  // namespace ridgeline::test
