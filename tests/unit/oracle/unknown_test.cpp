#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/tracer.hpp"
#include "tests/unit/oracle/scenes.hpp"

/// When unknown ground must and may show: contract.md section 1.
namespace ridgeline::oracle {
namespace {

constexpr double cell_deg = 1.0 / 1200;

/// A plain at 500 m with one void post at (46.5, 8.5), and a pit of 100 m some cells east of it.
Terrain plain_with_pit(int cells_to_pit) {
  const double pit = 8.5 + cells_to_pit * cell_deg;
  return Terrain({scenes::tile(46, 8, 1200, 1200,
                               [=](double lat, double lon) {
                                 if (std::hypot(lat - 46.5, lon - 8.5) < 1e-6) return std::nan("");
                                 return std::hypot(lat - 46.5, lon - pit) < 1e-6 ? 100.0 : 500.0;
                               })},
                 Geoid());
}

/// A ray straight down over the void's cells that ends at a height.
FirstHit down_to(const Terrain& terrain, double lat, double lon, double end_m,
                 double from_m = 9500) {
  const Geodetic eye{lat, lon, from_m};
  return Tracer(terrain, eye, from_m - end_m).first_hit(level_frame(lat, lon).down);
}

TEST(Unknown, a_void_is_transparent_and_must_show_below_the_lowest_post_around) {
  const Terrain terrain = plain_with_pit(0x7FFFFF);
  const double beside = 0.4 * cell_deg;
  const FirstHit through = down_to(terrain, 46.5 + beside, 8.5 + beside, -100);
  EXPECT_TRUE(through.is_sky());
  EXPECT_TRUE(through.must_be_unknown);
  EXPECT_TRUE(through.may_be_unknown);
  const FirstHit above = down_to(terrain, 46.5 + beside, 8.5 + beside, 501);
  EXPECT_FALSE(above.must_be_unknown);
  EXPECT_TRUE(above.may_be_unknown);
  EXPECT_TRUE(down_to(terrain, 46.5 + beside, 8.5 + beside, 499).must_be_unknown);
  EXPECT_FALSE(down_to(terrain, 46.5 + beside, 8.5 + beside, 9001).may_be_unknown);
  EXPECT_TRUE(down_to(terrain, 46.5 + beside, 8.5 + beside, 8999).may_be_unknown);
  const FirstHit next_cell = down_to(terrain, 46.5 + 3 * cell_deg, 8.5, -100);
  EXPECT_NEAR(next_cell.distance_m, 9000, 1e-6);
  EXPECT_FALSE(next_cell.may_be_unknown);
}

TEST(Unknown, a_void_behind_the_first_hit_does_not_count) {
  const Terrain terrain = plain_with_pit(0x7FFFFF);
  const Geodetic eye{46.45, 8.5, 1000};
  const CameraAxes axes = camera_axes(level_frame(46.45, 8.5), 0, -6.0, 0);
  const FirstHit hit = Tracer(terrain, eye, 30000).first_hit(axes.forward);
  EXPECT_LT(hit.distance_m, 5000);
  EXPECT_FALSE(hit.may_be_unknown);
}

/// An eye on the border of the data looks round: what lies behind it is not before it, on whichever
/// side of the line rounding puts the beginning of a ray.
TEST(Unknown, a_ray_does_not_pass_over_the_cell_that_it_leaves_where_it_begins) {
  int seen = 0;
  for (int south_deg = -59; south_deg < 59; south_deg += 7) {
    const Terrain terrain(
        {scenes::tile(south_deg, 179, 120, 120, [](double, double) { return 100.0; })}, Geoid());
    for (const double column : {17.0, 40.3, 100.7}) {
      const Geodetic eye{south_deg + 1.0, 179 + column / 120, 300};
      const Tracer tracer(terrain, eye, 20000);
      const LevelFrame level = level_frame(eye.lat_deg, eye.lon_deg);
      for (double heading_deg = 5; heading_deg < 360; heading_deg += 13.7) {
        const bool out = std::cos(heading_deg * degree_rad) > 0;
        const FirstHit hit = tracer.first_hit(camera_axes(level, 0, -3, heading_deg).forward);
        ASSERT_EQ(hit.may_be_unknown, out) << south_deg << ' ' << column << ' ' << heading_deg;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 1000);
  // A centimetre beyond the border it does pass over unknown ground.
  const Terrain terrain({scenes::tile(46, 8, 120, 120, [](double, double) { return 100.0; })},
                        Geoid());
  const Geodetic eye{47.0 + 1e-7, 8.3, 300};
  const CameraAxes south = camera_axes(level_frame(eye.lat_deg, eye.lon_deg), 0, -3, 180);
  EXPECT_TRUE(Tracer(terrain, eye, 20000).first_hit(south.forward).may_be_unknown);
}

TEST(Unknown, the_threshold_is_that_of_the_alignment_that_asks_least) {
  const double beside = 0.4 * cell_deg;
  for (const int near : {20, 64, 126}) {
    const Terrain terrain = plain_with_pit(near);
    EXPECT_FALSE(down_to(terrain, 46.5 + beside, 8.5 + beside, 101).must_be_unknown) << near;
    EXPECT_TRUE(down_to(terrain, 46.5 + beside, 8.5 + beside, 99).must_be_unknown) << near;
  }
  // Beyond 127 cells, and the summary's own blocks of 16, no alignment reaches the pit.
  EXPECT_TRUE(down_to(plain_with_pit(180), 46.5 + beside, 8.5 + beside, 499).must_be_unknown);
}

TEST(Unknown, far_from_known_posts_the_lowest_of_the_whole_terrain_counts) {
  const auto half = [](double lat, double lon) {
    if (lat > 46.2) return std::nan("");
    return lon < 8.1 && lat < 46.01 ? -20.0 : 700.0;
  };
  const Terrain terrain({scenes::tile(46, 8, 1200, 1200, half)}, Geoid());
  EXPECT_FALSE(down_to(terrain, 46.8, 8.8, -19).must_be_unknown);
  EXPECT_TRUE(down_to(terrain, 46.8, 8.8, -21).must_be_unknown);
  EXPECT_TRUE(down_to(terrain, 46.203, 8.8, 650).must_be_unknown);
}

TEST(Unknown, no_tile_is_unknown_ground_as_well) {
  const Terrain terrain({scenes::tile(46, 8, 1200, 1200,
                                      [](double, double lon) { return lon < 8.1 ? 30.0 : 600.0; })},
                        Geoid());
  const FirstHit far = down_to(terrain, 47.9, 8.5, 31);
  EXPECT_FALSE(far.must_be_unknown);
  EXPECT_TRUE(far.may_be_unknown);
  EXPECT_TRUE(down_to(terrain, 47.9, 8.5, 29).must_be_unknown);
  // Just over the edge the posts of the tile are in every alignment's blocks.
  EXPECT_TRUE(down_to(terrain, 47.0 + 5 * cell_deg, 8.5, 599).must_be_unknown);
  EXPECT_FALSE(down_to(terrain, 47.0 + 5 * cell_deg, 8.5, 601).must_be_unknown);
}

TEST(Unknown, a_ray_that_dips_below_the_threshold_between_its_ends_is_seen) {
  const Terrain terrain({scenes::tile(46, 8, 1200, 1200, [](double, double) { return 500.0; })},
                        Geoid());
  // Far from the tile; the ray comes down by 5 m over 8 km and rises as much over the next 8.
  const Geodetic eye{48.5, 8.5, 503};
  const double pitch_deg = -8000 / semi_major_m / degree_rad;
  const CameraAxes axes = camera_axes(level_frame(48.5, 8.5), 0, pitch_deg, 0);
  const auto meets = [&](double height_m) {
    return Tracer(terrain, {eye.lat_deg, eye.lon_deg, height_m}, 16000).first_hit(axes.forward);
  };
  EXPECT_TRUE(meets(504).must_be_unknown);
  EXPECT_FALSE(meets(506).must_be_unknown);
  EXPECT_TRUE(meets(9004).may_be_unknown);
  EXPECT_FALSE(meets(9006).may_be_unknown);
}

TEST(Unknown, a_post_that_one_of_two_tiles_knows_is_known) {
  const auto without_its_edge = [](double, double lon) {
    return lon > 9 - 1e-9 ? std::nan("") : 500.0;
  };
  const Terrain terrain({scenes::tile(46, 8, 1200, 1200, without_its_edge),
                         scenes::tile(46, 9, 1200, 1200, [](double, double) { return 500.0; })},
                        Geoid());
  const FirstHit hit = down_to(terrain, 46.5, 9 - 0.5 * cell_deg, 0);
  EXPECT_NEAR(hit.distance_m, 9000, 1e-6);
  EXPECT_FALSE(hit.may_be_unknown);
}

}  // namespace
}  // namespace ridgeline::oracle
