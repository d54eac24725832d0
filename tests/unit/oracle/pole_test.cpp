#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>

#include "tests/oracle/coverage.hpp"
#include "tests/oracle/tracer.hpp"
#include "tests/oracle/verify.hpp"
#include "tests/unit/oracle/scenes.hpp"

/// Rays near and across the poles, and over the thinning columns of DTED's latitude zones, against
/// the contract's surface sampled densely along the ray.
namespace ridgeline::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How many times fewer columns than rows a degree has. Source: MIL-PRF-89020B, its five zones.
int thinning(int south_deg) {
  const int low = south_deg >= 0 ? south_deg : -south_deg - 1;
  if (low >= 80) return 6;
  if (low >= 75) return 4;
  if (low >= 70) return 3;
  return low >= 50 ? 2 : 1;
}

/// One degree of a zone's lattice.
Tile zone_tile(int south_deg, int west_deg, int cells, const scenes::Surface& surface) {
  Tile tile;
  tile.name = "zone";
  tile.south_deg = south_deg;
  tile.west_deg = west_deg;
  const int columns = cells / thinning(south_deg);
  tile.lat_step_deg = 1.0 / cells;
  tile.lon_step_deg = 1.0 / columns;
  tile.rows = cells + 1;
  tile.columns = columns + 1;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= columns; ++column) {
      tile.posts.push_back(
          static_cast<float>(surface(south_deg + static_cast<double>(row) / cells,
                                     west_deg + static_cast<double>(column) / columns)));
    }
  }
  return tile;
}

/// Whole rings of tiles from `from_deg` to `to_deg`, without the cell at `hole_west_deg`.
Terrain rings(int from_deg, int to_deg, int cells, const scenes::Surface& surface,
              int hole_west_deg = 999, Geoid geoid = Geoid()) {
  std::vector<Tile> tiles;
  for (int south = from_deg; south < to_deg; ++south) {
    for (int west = -180; west < 180; ++west) {
      if (west != hole_west_deg) tiles.push_back(zone_tile(south, west, cells, surface));
    }
  }
  return {std::move(tiles), std::move(geoid)};
}

/// Height over the surface by the shortest way from its definition; NaN over unknown ground.
double height_over_m(const Terrain& terrain, const Geodetic& g) {
  for (const TerrainTile& entry : terrain.tiles()) {
    const Tile& tile = entry.tile;
    const double x = (g.lon_deg - tile.west_deg) / tile.lon_step_deg;
    const double y = (g.lat_deg - tile.south_deg) / tile.lat_step_deg;
    if (x < 0 || y < 0 || x > tile.columns - 1 || y > tile.rows - 1) continue;
    const int c = std::min(static_cast<int>(x), tile.columns - 2);
    const int r = std::min(static_cast<int>(y), tile.rows - 2);
    const auto post = [&](int dr, int dc) { return static_cast<double>(tile.at(r + dr, c + dc)); };
    const double u = x - c;
    const double v = y - r;
    return g.height_m - terrain.geoid().at(g.lat_deg, g.lon_deg) -
           ((post(0, 0) * (1 - u) + post(0, 1) * u) * (1 - v) +
            (post(1, 0) * (1 - u) + post(1, 1) * u) * v);
  }
  return std::nan("");
}

/// The first hit by marching; unknown ground is transparent.
double marched_hit_m(const Terrain& terrain, const Vec3& eye, const Vec3& ray, double range_m,
                     double step_m) {
  const auto is_over = [&](double t) {
    return !(height_over_m(terrain, geodetic_from_ecef(eye + t * ray)) <= 0);
  };
  for (double t = step_m; t <= range_m; t += step_m) {
    if (is_over(t)) continue;
    double low = t - step_m;
    double high = t;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      (is_over(middle) ? low : high) = middle;
    }
    return high;
  }
  return infinity;
}

Vec3 ray_at(const Geodetic& eye, double heading, double pitch) {
  return camera_axes(level_frame(eye.lat_deg, eye.lon_deg), 0, pitch, heading).forward;
}

/// Rays from round a pole at ground in their reach, some exactly along meridians and through it.
struct PoleRays {
  double side;  ///< +1 north, -1 south
  std::mt19937 random{5};

  double unit() { return std::uniform_real_distribution<double>(0, 1)(random); }

  /// Eye and ray number `i`.
  std::pair<Geodetic, Vec3> next(int i) {
    const double lon = i % 3 == 0 ? std::floor(360 * unit()) - 180 : 360 * unit() - 180;
    const double off_deg = i % 7 == 0 ? 0 : std::pow(10.0, -5 + 4.6 * unit());
    const Geodetic eye{side * (90 - off_deg), lon, 1600 + 800 * unit()};
    const double to_pole = side > 0 ? 0 : 180;
    const double heading = i % 3 == 2 ? 360 * unit() : to_pole;
    return {eye, ray_at(eye, heading, i % 11 == 0 ? -90 : -1 - 12 * unit() * unit())};
  }
};

void expect_sampled_truth(const Terrain& terrain, double side, int rays, int least_hits) {
  PoleRays source{side};
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const auto [eye, ray] = source.next(i);
    const Tracer tracer(terrain, eye, 40000);
    if (height_over_m(terrain, geodetic_from_ecef(tracer.eye())) <= 0) continue;
    const double marched = marched_hit_m(terrain, tracer.eye(), ray, 40000, 10);
    const FirstHit traced = tracer.first_hit(ray);
    ASSERT_FALSE(traced.may_be_unknown) << i;
    ++hits;
    if (traced.distance_m < marched - 1e-2) {
      // Marching may step over a ridge, never the other way round.
      const Geodetic g = geodetic_from_ecef(tracer.eye() + traced.distance_m * ray);
      ASSERT_LT(std::abs(height_over_m(terrain, g)), 1e-3) << i;
    } else if (marched < infinity) {
      ASSERT_NEAR(traced.distance_m, marched, 1e-2) << i;
    } else {
      --hits;
      ASSERT_TRUE(traced.is_sky()) << i;
    }
    const FirstHit slow = Tracer(terrain, eye, 40000, Walk::every_cell).first_hit(ray);
    if (traced.is_sky()) {
      ASSERT_TRUE(slow.is_sky()) << i;
    } else {
      ASSERT_NEAR(slow.distance_m, traced.distance_m, 1e-5) << i;
    }
  }
  EXPECT_GT(hits, least_hits);
}

TEST(Pole, a_level_cap_is_level_all_the_way_round) {
  const auto level = [](double, double) { return 300.0; };
  expect_sampled_truth(rings(89, 90, 60, level), 1, 120, 60);
  expect_sampled_truth(rings(-90, -89, 60, level), -1, 120, 60);
}

TEST(Pole, a_cone_has_its_tip_there) {
  // A degree of latitude is some 111.7 km there.
  const auto cone = [](double lat, double) { return 1400 - 11000 * (90 - std::abs(lat)); };
  const Terrain north = rings(89, 90, 60, cone);
  expect_sampled_truth(north, 1, 120, 30);
  expect_sampled_truth(rings(-90, -89, 60, cone), -1, 120, 30);
  // From 20 km in front of it at 900 m, level, the cone stands where it is as high as the ray.
  const Geodetic eye{90 - 0.18, 33, 900};
  const double hit = Tracer(north, eye, 40000).first_hit(ray_at(eye, 0, 0)).distance_m;
  const double angle_deg = 0.18 - hit / 111694.0;
  EXPECT_NEAR(900 + hit * hit / (2 * 6399594.0), 1400 - 11000 * angle_deg, 0.5);
}

TEST(Pole, a_plane_across_it_is_met_on_its_far_side) {
  // Heights that grow along one horizontal axis: no feature of it knows of the pole.
  const auto plane = [](double lat, double lon) {
    return 900 + 60000 * (90 - std::abs(lat)) / 10 * std::cos(lon * degree_rad);
  };
  const Terrain north = rings(89, 90, 60, plane);
  expect_sampled_truth(north, 1, 150, 80);
  expect_sampled_truth(rings(-90, -89, 60, plane), -1, 150, 80);
  // Level flight towards longitude 0 from the far side: up the plane, over the pole.
  const Geodetic eye{90 - 0.05, 180, 1500};
  const double hit = Tracer(north, eye, 40000).first_hit(ray_at(eye, 0, 0)).distance_m;
  const double beyond_deg = hit / 111694.0 - 0.05;
  EXPECT_GT(beyond_deg, 0.05);
  EXPECT_NEAR(900 + 6000 * beyond_deg, 1500 + hit * hit / (2 * 6399594.0), 2);
}

TEST(Pole, posts_that_disagree_about_the_pole_are_believed_each_in_its_cell) {
  const scenes::Surface hills = scenes::rugged(1500, 17);
  expect_sampled_truth(rings(89, 90, 60, hills), 1, 200, 100);
  expect_sampled_truth(rings(-90, -89, 60, hills), -1, 200, 100);
}

// 2026-11-23: found by the random attack.
TEST(Pole, a_tile_round_the_whole_earth_meets_itself_with_the_taller_posts) {
  Tile tile;
  tile.south_deg = 10;
  tile.west_deg = -180;
  tile.lat_step_deg = 1;
  tile.lon_step_deg = 10;
  tile.rows = 3;
  tile.columns = 37;
  tile.posts.resize(tile.index(tile.rows, 0));
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; ++column) tile.set(row, column, 5);
  }
  tile.set(1, 0, 50);
  tile.set(1, 36, 80);
  tile.set(2, 0, void_post);
  std::vector<Tile> tiles;
  tiles.push_back(std::move(tile));
  const Terrain terrain(std::move(tiles), Geoid());
  const Tile& held = terrain.tiles()[0].tile;
  EXPECT_EQ(held.at(1, 0), 80);
  EXPECT_EQ(held.at(1, 36), 80);
  EXPECT_EQ(held.at(2, 0), 5);
  EXPECT_EQ(held.at(0, 18), 5);
}

TEST(Pole, a_geoid_goes_round_it) {
  std::vector<float> nodes;
  for (int i = 0; i < 13 * 24; ++i) nodes.push_back(static_cast<float>(i * 37 % 101 - 50));
  const Geoid geoid = Geoid::from_nodes(-90, 0, 15, 15, 13, 24, nodes);
  const auto level = [](double, double) { return 300.0; };
  expect_sampled_truth(rings(89, 90, 60, level, 999, geoid), 1, 100, 50);
  expect_sampled_truth(rings(-90, -89, 60, level, 999, geoid), -1, 100, 50);
}

TEST(Pole, a_ray_down_the_axis_ends_on_the_pole) {
  const Terrain terrain = rings(89, 90, 60, [](double, double) { return 250.0; });
  for (const double lon : {0.0, -180.0, 77.7, 179.0}) {
    const Geodetic eye{90, lon, 3000};
    EXPECT_NEAR(Tracer(terrain, eye, 9000).first_hit({0, 0, -1}).distance_m, 2750, 1e-5);
    const Vec3 nearly = normalised({1e-9, 0, -1});
    EXPECT_NEAR(Tracer(terrain, eye, 9000).first_hit(nearly).distance_m, 2750, 1e-5);
  }
}

TEST(Pole, a_missing_cell_across_it_is_unknown_and_nothing_else_is) {
  const Terrain terrain = rings(
      89, 90, 60, [](double, double) { return 0.0; }, 40);
  const Geodetic eye{89.95, -139.5, 1500};  // the hole lies straight across the pole
  const Tracer tracer(terrain, eye, 60000);
  const FirstHit into = tracer.first_hit(ray_at(eye, 0, -9));
  EXPECT_TRUE(into.is_sky());
  EXPECT_TRUE(into.must_be_unknown);
  EXPECT_FALSE(tracer.first_hit(ray_at(eye, 0, -25)).may_be_unknown);  // hits on this side
  for (const double heading : {-20.0, -2.0, 2.0, 20.0}) {
    const FirstHit beside = tracer.first_hit(ray_at(eye, heading, -9));
    EXPECT_FALSE(beside.is_sky()) << heading;
    EXPECT_FALSE(beside.may_be_unknown) << heading;
  }
}

TEST(Pole, stated_sea_reaches_it) {
  std::vector<Tile> tiles;
  for (int west = -180; west < 180; ++west) {
    tiles.push_back(sea_tile({89, west}, {1200, 1200}));
    tiles.push_back(sea_tile({88, west}, {1200, 1200}));
  }
  expect_sampled_truth({std::move(tiles), Geoid()}, 1, 100, 50);
}

TEST(Pole, a_frame_of_exact_rays_across_it_holds) {
  const scenes::TemporaryFolder folder;
  std::vector<DegreeCell> sea;
  for (const int south : {88, 89}) {
    for (int west = -180; west < 180; ++west) sea.push_back({south, west});
  }
  scenes::write_hgt(folder.path(), 89, 0, scenes::rugged(900, 4));
  const std::filesystem::path list = folder.path() / "coverage.txt";
  std::ofstream out(list);
  for (const DegreeCell& cell : sea) {
    out << "sea N" << cell.south_deg << (cell.west_deg < 0 ? 'W' : 'E') << std::setw(3)
        << std::setfill('0') << std::abs(cell.west_deg) << '\n';
  }
  out.close();
  scenes::Shot shot;
  shot.eye = {89.95, -179.6, 1300};  // the tile lies straight across
  shot.pitch_deg = -4;
  shot.focal_px = 30;
  const Terrain terrain = Terrain::load(folder.path(), Geoid(), {}, sea);
  const Frame frame = scenes::drawn(terrain, shot);
  const scenes::TemporaryFolder dump;
  scenes::write_frame(dump.path(), frame);
  VerifyOptions options;
  options.dump_folder = dump.path();
  options.terrain_folder = folder.path();
  options.coverage_file = list;
  options.pixels_per_frame = 200;
  std::ostringstream text;
  const VerifySummary summary = run_verify(options, text);
  print_summary(summary, text);
  EXPECT_EQ(summary.violations() + summary.undecided, 0U) << text.str();
  EXPECT_EQ(summary.sea_cells, 719);
  EXPECT_EQ(
      std::count_if(frame.range.begin(), frame.range.end(), [](float z) { return std::isnan(z); }),
      0);
}

TEST(Zones, tiles_of_thinning_columns_meet_without_a_gap) {
  const scenes::Surface hills = scenes::rugged(1500, 23);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const int edge : {50, 70, 75, 80, -50, -70, -75, -80}) {
    std::vector<Tile> tiles;
    for (const int south : {edge - 1, edge}) {
      for (const int west : {179, -180, 12, 13}) {
        tiles.push_back(zone_tile(south, west, 120, hills));
      }
    }
    const Terrain terrain(std::move(tiles), Geoid());
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
      const double seam = i % 2 == 0 ? 13 : 180;
      const double lon = std::remainder(seam + 0.3 * (unit(random) - 0.5), 360.0);
      const Geodetic eye{edge + 0.2 * (unit(random) - 0.5), lon, 1600 + 600 * unit(random)};
      const Tracer tracer(terrain, eye, 12000);
      const Vec3 ray = ray_at(eye, 360 * unit(random), -2 - 15 * unit(random));
      const double marched = marched_hit_m(terrain, tracer.eye(), ray, 12000, 5);
      const FirstHit traced = tracer.first_hit(ray);
      ASSERT_FALSE(traced.may_be_unknown) << edge << ' ' << i;
      if (traced.is_sky() && marched == infinity) continue;
      ++hits;
      if (traced.distance_m < marched - 1e-2) {
        const Geodetic g = geodetic_from_ecef(tracer.eye() + traced.distance_m * ray);
        ASSERT_LT(std::abs(height_over_m(terrain, g)), 1e-3) << edge << ' ' << i;
      } else {
        ASSERT_NEAR(traced.distance_m, marched, 1e-3) << edge << ' ' << i;
      }
    }
    EXPECT_GT(hits, 20) << edge;
  }
}

TEST(Zones, only_posts_that_coincide_are_shared) {
  // 9" beside 12" steps at 75 degrees north: every fourth post of the one is a third of the other.
  const Terrain terrain({zone_tile(74, 12, 1200, [](double, double) { return 100.0; }),
                         zone_tile(75, 12, 1200, [](double, double) { return 400.0; })},
                        Geoid());
  const Tile& south = terrain.tiles()[0].tile;
  const Tile& north = terrain.tiles()[1].tile;
  ASSERT_EQ(south.columns, 401);
  ASSERT_EQ(north.columns, 301);
  for (int column = 0; column <= 400; ++column) {
    EXPECT_EQ(south.at(1200, column), column % 4 == 0 ? 400 : 100) << column;
  }
  for (int column = 0; column <= 300; ++column) EXPECT_EQ(north.at(0, column), 400);
}

}  // namespace
}  // namespace ridgeline::oracle
