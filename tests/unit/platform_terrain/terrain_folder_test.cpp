#include "platform/terrain_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"
#include "tests/unit/platform_terrain/allocation_count.hpp"

namespace ridgeline {
namespace {

using test::TemporaryFolder;

constexpr GeoBox whole_earth{-90, -180, 90, 180};
constexpr std::size_t hgt_3_arc_seconds_bytes = 2 * 1201 * 1201;

test::PostHeight flat(int height_m) {
  return [=](int, int) { return height_m; };
}

void write_small(const TemporaryFolder& folder, const std::string& name, int south_deg,
                 int west_deg, int height_m = 100) {
  test::write_dted(folder.file(name), 0, south_deg, west_deg, flat(height_m));
}

void write_flat_hgt(const TemporaryFolder& folder, const std::string& name) {
  const std::vector<std::byte> sea(hgt_3_arc_seconds_bytes);
  test::write_bytes(folder.file(name), sea);
}

TerrainFolder opened(const TemporaryFolder& folder, TileReader* extra = nullptr) {
  FileResult<TerrainFolder> result = TerrainFolder::open(folder.path(), extra);
  RL_ASSERT(result.ok());
  return std::move(result).value();
}

using Place = std::pair<double, double>;

std::vector<Place> places(const TerrainFolder& folder) {
  std::vector<Place> list;
  for (const HeightTile& tile : folder.tiles()) {
    list.emplace_back(tile.grid.south_deg, tile.grid.west_deg);
  }
  return list;
}

float first_post_m(const HeightTile& tile) {
  float height_m = 0;
  read_posts(tile, 0, 0, {&height_m, 1});
  return height_m;
}

TEST(TerrainFolder, tiles_come_and_go_with_the_box) {
  const TemporaryFolder folder;
  write_flat_hgt(folder, "N46E008.hgt");
  write_small(folder, "n46_e009.dt0", 46, 9);
  write_small(folder, "n48_e008.dt0", 48, 8);
  TerrainFolder terrain = opened(folder);
  EXPECT_TRUE(terrain.tiles().empty());
  EXPECT_EQ(terrain.mapped_bytes(), 0U);

  EXPECT_TRUE(terrain.select({46.2, 8.8, 46.4, 9.2}));
  EXPECT_EQ(places(terrain), (std::vector<Place>{{46, 8}, {46, 9}}));
  EXPECT_EQ(terrain.mapped_bytes(), hgt_3_arc_seconds_bytes + 34162);
  EXPECT_FALSE(terrain.select({46.2, 8.8, 46.4, 9.2}));

  EXPECT_TRUE(terrain.select({48.2, 8.2, 48.4, 8.4}));
  EXPECT_EQ(places(terrain), (std::vector<Place>{{48, 8}}));

  EXPECT_TRUE(terrain.select({10, 10, 11, 11}));
  EXPECT_TRUE(terrain.tiles().empty());
  EXPECT_EQ(terrain.mapped_bytes(), 0U);
  EXPECT_TRUE(terrain.refused().empty());
}

TEST(TerrainFolder, heights_are_those_of_the_files) {
  const TemporaryFolder folder;
  write_small(folder, "n46_e009.dt0", 46, 9, 1234);
  test::write_hgt(folder.file("N46E008.hgt"), 1201, flat(-7));
  TerrainFolder terrain = opened(folder);
  terrain.select(whole_earth);
  ASSERT_EQ(terrain.tiles().size(), 2U);
  EXPECT_EQ(first_post_m(terrain.tiles()[0]), -7.0F);
  EXPECT_EQ(first_post_m(terrain.tiles()[1]), 1234.0F);
}

TEST(TerrainFolder, third_of_an_arc_second_tile_is_mapped) {
  const TemporaryFolder folder;
  const std::string path = folder.file("N46E008.hgt");
  constexpr std::size_t size_bytes = std::size_t{2} * 10801 * 10801;
  test::write_bytes(path, std::vector<std::byte>{std::byte{0x01}, std::byte{0x02}});
  std::filesystem::resize_file(path, size_bytes);  // sparse: zeros that take no room
  TerrainFolder terrain = opened(folder);
  terrain.select(whole_earth);
  ASSERT_EQ(terrain.tiles().size(), 1U);
  EXPECT_EQ(terrain.mapped_bytes(), size_bytes);
  const HeightTile& tile = terrain.tiles()[0];
  EXPECT_EQ(tile.grid.columns, 10801);
  float north_west_m = 0;
  read_posts(tile, 10800, 0, {&north_west_m, 1});
  EXPECT_EQ(north_west_m, 258.0F);
  EXPECT_EQ(first_post_m(tile), 0.0F);
}

TEST(TerrainFolder, moving_the_folder_keeps_its_tiles) {
  const TemporaryFolder folder;
  write_small(folder, "n46_e009.dt0", 46, 9, 1234);
  TerrainFolder first = opened(folder);
  first.select(whole_earth);
  const TerrainFolder second = std::move(first);
  ASSERT_EQ(second.tiles().size(), 1U);
  EXPECT_EQ(first_post_m(second.tiles()[0]), 1234.0F);
}

TEST(TerrainFolder, order_is_south_then_west_then_name) {
  const TemporaryFolder folder;
  write_small(folder, "z.dt0", -1, 5);
  write_small(folder, "a.dt0", 46, 8, 1);
  write_small(folder, "b.dt0", 46, 8, 2);
  write_small(folder, "c.dt0", 46, -8);
  write_small(folder, "d.dt0", -1, 4);
  TerrainFolder terrain = opened(folder);
  terrain.select(whole_earth);
  EXPECT_EQ(places(terrain), (std::vector<Place>{{-1, 4}, {-1, 5}, {46, -8}, {46, 8}, {46, 8}}));
  EXPECT_EQ(first_post_m(terrain.tiles()[3]), 1.0F);
  EXPECT_EQ(first_post_m(terrain.tiles()[4]), 2.0F);
}

TEST(TerrainFolder, usual_names_are_found_and_others_passed_over) {
  const TemporaryFolder folder;
  write_flat_hgt(folder, "n01e001.HGT");
  write_flat_hgt(folder, "N02E001.SRTMGL1.hgt");
  write_small(folder, "no_place_in_its_name.DT0", 3, 1);
  write_small(folder, "e004/n04.dt0", 4, 1);
  write_small(folder, "deep/deeper/n05_e001.dt0", 5, 1);
  write_flat_hgt(folder, "._N06E001.hgt");
  write_flat_hgt(folder, "N07E001.hgt.zip");
  write_flat_hgt(folder, "readme.txt");
  TerrainFolder terrain = opened(folder);
  terrain.select(whole_earth);
  EXPECT_EQ(places(terrain), (std::vector<Place>{{1, 1}, {2, 1}, {3, 1}, {4, 1}}));
  EXPECT_TRUE(terrain.refused().empty());
}

TEST(TerrainFolder, box_across_the_antimeridian_maps_both_sides) {
  const TemporaryFolder folder;
  write_small(folder, "s20_w180.dt0", -20, -180);
  write_small(folder, "s20_e179.dt0", -20, 179);
  write_small(folder, "s20_e178.dt0", -20, 178);
  TerrainFolder terrain = opened(folder);
  terrain.select({-19.6, 179.8, -19.4, -179.8});
  EXPECT_EQ(places(terrain), (std::vector<Place>{{-20, -180}, {-20, 179}}));
}

TEST(TerrainFolder, selecting_takes_no_heap_not_even_to_refuse) {
  const TemporaryFolder folder;
  write_flat_hgt(folder, "N46E008.hgt");
  write_small(folder, "n46_e009.dt0", 46, 9);
  write_small(folder, "n46_e010.dt0", 46, 10);
  std::vector<std::byte> damaged = test::read_bytes(folder.file("n46_e010.dt0"));
  damaged[5000] ^= std::byte{1};
  test::write_bytes(folder.file("n46_e010.dt0"), damaged);
  write_small(folder, "n46_e011.dt0", 46, 11);
  TerrainFolder terrain = opened(folder);
  std::filesystem::remove(folder.file("n46_e011.dt0"));

  const std::size_t before = test::allocation_count();
  terrain.select({46, 8, 46.5, 8.5});
  terrain.select(whole_earth);
  terrain.select({10, 10, 11, 11});
  terrain.select(whole_earth);
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(terrain.tiles().size(), 2U);
  EXPECT_EQ(terrain.refused().size(), 2U);
}

// A reader of a format of its own: every `.fake` file is two by two posts at 10 N 20 E.
class FakeReader final : public TileReader {
 public:
  [[nodiscard]] bool accepts(const std::string& path) const override {
    return path.ends_with(".fake");
  }
  FileResult<PostGrid> describe(const std::string& path) override {
    if (path.ends_with("bad.fake")) return file_problem(path, Fault::tile_projected, "UTM");
    return grid;
  }
  FileResult<DecodedTile> load(const std::string& path) override {
    ++load_count;
    if (path.ends_with("torn.fake")) return file_problem(path, Fault::tile_record_corrupt, "torn");
    return DecodedTile{grid, {1, 2, 3, std::nanf("")}};
  }

  PostGrid grid{10, 20, 0.5, 0.5, 2, 2};
  int load_count = 0;
};

TEST(TerrainFolder, extra_reader_adds_a_format) {
  const TemporaryFolder folder;
  for (const char* name : {"good.fake", "bad.fake", "torn.fake"}) {
    test::write_bytes(folder.file(name), {});
  }
  FakeReader reader;
  TerrainFolder terrain = opened(folder, &reader);
  ASSERT_EQ(terrain.refused().size(), 1U);
  EXPECT_EQ(terrain.refused()[0].fault, Fault::tile_projected);
  terrain.select({10, 20, 10.1, 20.1});
  ASSERT_EQ(terrain.tiles().size(), 1U);
  EXPECT_EQ(terrain.tiles()[0].layout, TileLayout::float32_rows);
  EXPECT_EQ(first_post_m(terrain.tiles()[0]), 1.0F);
  EXPECT_EQ(terrain.decoded_bytes(), 16U);
  EXPECT_EQ(terrain.mapped_bytes(), 0U);
  ASSERT_EQ(terrain.refused().size(), 2U);
  EXPECT_EQ(terrain.refused()[1].fault, Fault::tile_record_corrupt);
  terrain.select({0, 0, 1, 1});
  EXPECT_EQ(terrain.decoded_bytes(), 0U);
  terrain.select({10, 20, 10.1, 20.1});
  EXPECT_EQ(reader.load_count, 3);  // twice the good one, once the torn one
  EXPECT_EQ(terrain.usable_count(), 1U);
}

}  // namespace
}  // namespace ridgeline
