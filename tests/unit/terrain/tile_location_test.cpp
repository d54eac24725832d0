#include "core/terrain/tile_location.hpp"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

constexpr PostGrid cell(double south_deg, double west_deg) {
  return {south_deg, west_deg, 1.0 / 1200, 1.0 / 1200, 1201, 1201};
}

TEST(TileLocation, usual_names_are_understood) {
  const auto place = [](const char* name) {
    const Result<TileLocation> location = location_from_name(name);
    return location.ok() ? location.value() : TileLocation{999, 999};
  };
  EXPECT_EQ(place("N46E008.hgt"), (TileLocation{46, 8}));
  EXPECT_EQ(place("n46e008.HGT"), (TileLocation{46, 8}));
  EXPECT_EQ(place("S20W180.hgt"), (TileLocation{-20, -180}));
  EXPECT_EQ(place("n46_e008.dt1"), (TileLocation{46, 8}));
  EXPECT_EQ(place("n00_e006_3arc_v2.dt1"), (TileLocation{0, 6}));
  EXPECT_EQ(place("N05W000.hgt"), (TileLocation{5, 0}));
  EXPECT_EQ(place("S00E010"), (TileLocation{0, 10}));
  EXPECT_EQ(place("N46E008.SRTMGL1.hgt"), (TileLocation{46, 8}));
  EXPECT_EQ(place("S90E179.hgt"), (TileLocation{-90, 179}));
}

TEST(TileLocation, other_names_are_refused) {
  for (const char* name :
       {"", "N46", "N46E08.hgt", "E008N46.hgt", "X46E008.hgt", "N4xE008.hgt", "N46X008.hgt",
        "N46E0080.hgt", "N46E008a.hgt", "N90E008.hgt", "S91E008.hgt", "N46E180.hgt", "N46W181.hgt",
        "N46__E008.hgt", " N46E008.hgt", "N-6E008.hgt", "N46_E00", "n46.dt1"}) {
    EXPECT_EQ(location_from_name(name).fault(), Fault::tile_name_unknown) << name;
  }
}

TEST(Overlap, touching_counts_and_apart_does_not) {
  const PostGrid grid = cell(46, 8);
  EXPECT_TRUE(overlaps({46.2, 8.2, 46.3, 8.3}, grid));
  EXPECT_TRUE(overlaps({40, 0, 50, 20}, grid));
  EXPECT_TRUE(overlaps({45, 7, 46, 8}, grid));
  EXPECT_TRUE(overlaps({47, 9, 48, 10}, grid));
  EXPECT_FALSE(overlaps({47.001, 8, 48, 9}, grid));
  EXPECT_FALSE(overlaps({45, 8, 45.999, 9}, grid));
  EXPECT_FALSE(overlaps({46, 9.001, 47, 10}, grid));
  EXPECT_FALSE(overlaps({46, 6, 47, 7.999}, grid));
}

TEST(Overlap, box_across_the_antimeridian_meets_both_sides) {
  for (const GeoBox& box : {GeoBox{-20, 179.5, -19, -179.5}, GeoBox{-20, 179.5, -19, 180.5},
                            GeoBox{-20, -180.5, -19, -179.5}}) {
    EXPECT_TRUE(overlaps(box, cell(-20, -180)));
    EXPECT_TRUE(overlaps(box, cell(-20, 179)));
    EXPECT_FALSE(overlaps(box, cell(-20, 178)));
    EXPECT_FALSE(overlaps(box, cell(-20, -179)));
    EXPECT_FALSE(overlaps(box, cell(-20, 0)));
  }
  EXPECT_TRUE(overlaps({-20, -179.5, -19, -179.4}, cell(-20, -180)));
  EXPECT_TRUE(overlaps({-20, -180, -19, -179.9}, cell(-20, 179)));  // they share the meridian
}

TEST(Overlap, the_whole_circle_meets_every_longitude) {
  for (int west = -180; west < 180; ++west) {
    EXPECT_TRUE(overlaps({-90, -180, 90, 180}, cell(0, west))) << west;
  }
}

}  // namespace
}  // namespace ridgeline
