#include "tests/fine_tiles/fine_tile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "platform/terrain_folder.hpp"
#include "sim/output/image_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/fine_tiles/mosaics.hpp"

namespace ridgeline::fine {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

/// A tile as it lies on the disk.
struct Tile {
  int side = 0;
  std::vector<std::byte> bytes;

  /// The post in a row from the south and a column from the west.
  [[nodiscard]] int post_m(int row, int column) const {
    const std::size_t at = 2 * static_cast<std::size_t>((side - 1 - row) * side + column);
    const int value = std::to_integer<int>(bytes[at]) << 8 | std::to_integer<int>(bytes[at + 1]);
    return value < 0x8000 ? value : value - 0x10000;
  }
};

Tile tile_in(const TemporaryFolder& folder, int south_deg, int west_deg) {
  Tile tile;
  tile.bytes = test::read_bytes(folder.path() + "/" + sim::tile_name(south_deg, west_deg));
  tile.side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(tile.bytes.size()) / 2)));
  return tile;
}

Tile one_tile(const SourceMosaic& mosaic, int factor, std::uint64_t seed = 1,
              const MirroredCell& cell = {}) {
  const TemporaryFolder folder;
  const std::string path = folder.file("N46E008.hgt");
  EXPECT_TRUE(write_fine_tile(path, mosaic, cell, factor, seed).ok());
  return tile_in(folder, 46, 8);
}

class FineTileFactor : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(factors, FineTileFactor, testing::Values(3, 9));

TEST_P(FineTileFactor, neighbours_agree_on_every_edge_also_where_the_mosaic_is_mirrored) {
  const TemporaryFolder folder;
  const SourceMosaic mosaic = small_mosaic(2, 3, true);
  const Place place{-3, 177, 5, 7};  // across the equator and the antimeridian
  ASSERT_TRUE(write_fine_block(folder.path(), mosaic, place, GetParam(), 5).ok());
  const auto tile = [&](int row, int column) {
    const int west_deg = place.west_deg + column;
    return tile_in(folder, place.south_deg + row, west_deg > 179 ? west_deg - 360 : west_deg);
  };
  const int last = small_intervals * GetParam();
  for (int row = 0; row < place.rows; ++row) {
    for (int column = 0; column < place.columns; ++column) {
      const Tile here = tile(row, column);
      ASSERT_EQ(here.side, last + 1);
      if (column + 1 < place.columns) {
        const Tile east = tile(row, column + 1);
        for (int k = 0; k <= last; ++k) ASSERT_EQ(here.post_m(k, last), east.post_m(k, 0));
      }
      if (row + 1 < place.rows) {
        const Tile north = tile(row + 1, column);
        for (int k = 0; k <= last; ++k) ASSERT_EQ(here.post_m(last, k), north.post_m(0, k));
      }
    }
  }
}

TEST_P(FineTileFactor, source_posts_are_kept_and_voids_are_not_filled) {
  const SourceMosaic mosaic = small_mosaic(1, 2, true);
  const Tile fine = one_tile(mosaic, GetParam());
  for (int row = 0; row <= small_intervals; ++row) {
    for (int column = 0; column <= small_intervals; ++column) {
      const int source_m = mosaic.post_m(row, column);
      ASSERT_EQ(fine.post_m(row * GetParam(), column * GetParam()), source_m);
      if (source_m != void_post) continue;
      for (const int aside : {-1, 1}) {
        ASSERT_EQ(fine.post_m(row * GetParam() + aside, column * GetParam()), void_post);
        ASSERT_EQ(fine.post_m(row * GetParam(), column * GetParam() + aside), void_post);
        ASSERT_EQ(fine.post_m(row * GetParam() + aside, column * GetParam() - aside), void_post);
      }
    }
  }
}

TEST_P(FineTileFactor, a_mirrored_cell_is_the_mirror_image) {
  const SourceMosaic mosaic = small_mosaic(2, 2);
  const Tile plain = one_tile(mosaic, GetParam(), 3, {1, 0, false, false});
  const Tile mirrored = one_tile(mosaic, GetParam(), 3, {1, 0, true, true});
  const int last = plain.side - 1;
  for (int row = 0; row <= last; ++row) {
    for (int column = 0; column <= last; ++column) {
      ASSERT_EQ(plain.post_m(row, column), mirrored.post_m(last - row, last - column));
    }
  }
}

TEST_P(FineTileFactor, flat_ground_stays_flat) {
  const auto lake = [](double, double) { return 92.0; };
  const Tile fine = one_tile(mosaic_of_function(lake, 0, 0, 1, 1, 4), GetParam());
  for (int row = 0; row < fine.side; ++row) {
    for (int column = 0; column < fine.side; ++column) ASSERT_EQ(fine.post_m(row, column), 92);
  }
}

TEST(FineTile, posts_of_a_slope_have_detail_within_its_share_of_the_relief) {
  constexpr int intervals = 20;
  constexpr int rise_m = 100;  // from post to post, to the north-east
  const auto slope = [](double latitude_deg, double longitude_deg) {
    return std::round((latitude_deg + longitude_deg) * intervals) * rise_m;
  };
  const Tile fine = one_tile(mosaic_of_function(slope, 0, 0, 1, 1, intervals), 3);
  const double most_m = 0.15 * 2 * rise_m + 0.5;  // the half range of 3 x 3 posts is 2 rises
  double largest_m = 0;
  double sum_m = 0;
  int count = 0;
  for (int row = 6; row <= 54; ++row) {  // away from the mirrored edges, where it is no plane
    for (int column = 6; column <= 54; ++column) {
      const double detail_m = fine.post_m(row, column) - (row + column) * rise_m / 3.0;
      largest_m = std::max(largest_m, std::fabs(detail_m));
      sum_m += detail_m;
      ++count;
    }
  }
  EXPECT_LE(largest_m, most_m);
  EXPECT_GT(largest_m, 0.9 * most_m);
  EXPECT_NEAR(sum_m / count, 0, 0.05 * most_m);
}

TEST(FineTile, a_tile_of_factor_9_holds_that_of_factor_3) {
  const SourceMosaic mosaic = small_mosaic(1, 1, true);
  const Tile coarse = one_tile(mosaic, 3, 7);
  const Tile fine = one_tile(mosaic, 9, 7);
  for (int row = 0; row < coarse.side; ++row) {
    for (int column = 0; column < coarse.side; ++column) {
      ASSERT_EQ(fine.post_m(3 * row, 3 * column), coarse.post_m(row, column));
    }
  }
}

TEST(FineTile, bits_are_the_same_everywhere_and_depend_on_the_seed) {
  const SourceMosaic mosaic = small_mosaic(1, 1);
  const auto checksum = [&](int factor, std::uint64_t seed) {
    const std::vector<std::byte> bytes = one_tile(mosaic, factor, seed).bytes;
    return sim::crc32_of({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  };
  EXPECT_EQ(checksum(3, 1), 1257741901U);
  EXPECT_EQ(checksum(9, 1), 1688698299U);
  EXPECT_NE(checksum(3, 2), checksum(3, 1));
}

TEST(FineTile, heights_stay_those_that_a_tile_may_have) {
  const auto extreme = [](double latitude_deg, double longitude_deg) {
    const long k = std::lround(8 * latitude_deg) + std::lround(8 * longitude_deg);
    return k % 2 == 0 ? 8999.0 : -11'999.0;
  };
  const Tile fine = one_tile(mosaic_of_function(extreme, 0, 0, 1, 1, 8), 9);
  for (int row = 0; row < fine.side; ++row) {
    for (int column = 0; column < fine.side; ++column) {
      ASSERT_GE(fine.post_m(row, column), -12'000);
      ASSERT_LE(fine.post_m(row, column), 9000);
    }
  }
}

TEST(FineTile, a_3_arc_second_source_gives_a_1_arc_second_tile_that_opens) {
  const TemporaryFolder folder;
  const auto hills = [](double latitude_deg, double longitude_deg) {
    const double y = latitude_deg * 40 - std::floor(latitude_deg * 40) - 0.5;
    const double x = longitude_deg * 40 - std::floor(longitude_deg * 40) - 0.5;
    return 2000 * (0.5 - x * x - y * y);
  };
  const SourceMosaic mosaic = mosaic_of_function(hills, 0, 0, 1, 1, source_intervals);
  ASSERT_TRUE(write_fine_block(folder.path(), mosaic, {-13, -72, 1, 1}, 3, 1).ok());
  FileResult<TerrainFolder> terrain = TerrainFolder::open(folder.path());
  ASSERT_TRUE(terrain.ok()) << terrain.problem().message;
  EXPECT_TRUE(terrain.value().refused().empty());
  terrain.value().select({-90, -180, 90, 180});
  ASSERT_EQ(terrain.value().tiles().size(), 1U);
  const HeightTile& tile = terrain.value().tiles()[0];
  EXPECT_EQ(tile.grid, (PostGrid{-13, -72, 1.0 / 3600, 1.0 / 3600, 3601, 3601}));
  std::vector<float> row_m(3601);
  read_posts(tile, 3 * 411, 0, row_m);
  for (int column = 0; column <= source_intervals; ++column) {
    ASSERT_EQ(row_m[static_cast<std::size_t>(3 * column)], mosaic.post_m(411, column));
  }
}

TEST(FineTile, the_folder_says_that_its_tiles_are_generated) {
  const TemporaryFolder folder;
  SourceMosaic mosaic = small_mosaic(1, 1);
  mosaic.made_from = "the 3\" tiles N46E008.hgt";
  ASSERT_TRUE(write_fine_block(folder.path(), mosaic, {10, 20, 1, 2}, 3, 77).ok());
  const std::vector<std::byte> bytes = test::read_bytes(folder.path() + "/GENERATED.txt");
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_THAT(text, testing::StartsWith("GENERATED terrain"));
  EXPECT_THAT(text, HasSubstr("N46E008.hgt"));
  EXPECT_THAT(text, HasSubstr("cut into 3"));
  EXPECT_THAT(text, HasSubstr("Seed 77"));
  EXPECT_THAT(text, HasSubstr("N10E021.hgt: source cell, row 0 from the south, column 0 from the "
                              "west, mirrored east to west\n"));
}

TEST(FineTile, a_folder_that_cannot_be_written_is_named_and_left_alone) {
  const TemporaryFolder folder;
  const SourceMosaic mosaic = small_mosaic(1, 1);
  const std::string path = folder.path() + "/none/N46E008.hgt";
  const sim::Outcome written = write_fine_tile(path, mosaic, {}, 3, 1);
  EXPECT_EQ(written.fault, Fault::file_unwritable);
  EXPECT_THAT(written.message, testing::StartsWith(path + ": "));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FineTile, places_outside_the_world_are_refused) {
  EXPECT_EQ(wrong_with({-90, -180, 1, 1}), "");
  EXPECT_EQ(wrong_with({89, 179, 1, 64}), "");
  EXPECT_NE(wrong_with({89, 0, 2, 1}), "");
  EXPECT_NE(wrong_with({-91, 0, 1, 1}), "");
  EXPECT_NE(wrong_with({0, 180, 1, 1}), "");
  EXPECT_NE(wrong_with({0, 0, 0, 1}), "");
  EXPECT_NE(wrong_with({0, 0, 8, 9}), "");
  EXPECT_NE(wrong_with({0, 0, 65536, 65536}), "");
}

}  // namespace
}  // namespace ridgeline::fine
